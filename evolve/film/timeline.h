#pragma once

#include <string>
#include <vector>

#include "evolve/life/life.h"

namespace metamorph::evolve {

/// What of a life is filmed.
enum class FilmKind { life, development, motion };

/// A part of a film.
struct Shot {
  enum class Kind {
    development,  ///< from one development step to another
    cut,          ///< the body is cut out of the embryo and comes to rest where it starts to move
    motion,
  };
  Kind kind = Kind::motion;
  int from = 0, to = 0;  ///< development steps; of cut and motion: the stage
  int motion = -1;       ///< position in Life::motions; -1: none
  double length = 0;     ///< time units that pass in it
  double seconds = 0;    ///< of the film
};

/// A moment of a shot; `part` goes from 0 to 1.
struct Moment {
  Shot shot;
  double part = 0;
};

/// The shots of a life in order. `trial`, if not empty, is the only motion. A motion without a body
/// is cut short. Times in seconds are not set yet.
std::vector<Shot> shots_of(const Life& life, FilmKind kind, const std::string& trial);

/// Time units that pass in the shots, and how many cuts there are, which last a second or, in a
/// film of a given length, a twentieth of it if that is less.
double length_of(const std::vector<Shot>& shots);
int cuts_of(const std::vector<Shot>& shots);

/// Sets the seconds of shots: `speed` in time units per second, `cut` seconds each.
void set_seconds(std::vector<Shot>& shots, double speed, double cut);

double seconds_of(const std::vector<Shot>& shots);

/// What is shown at a second of the film; after the end its last moment.
Moment moment_at(const std::vector<Shot>& shots, double second);

}  // namespace metamorph::evolve
