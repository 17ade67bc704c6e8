#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evolve/experiment/experiment.h"
#include "evolve/view/panel.h"
#include "metamorph/body.h"
#include "metamorph/development.h"
#include "metamorph/locomotion.h"
#include "metamorph/outcome.h"
#include "metamorph/scene.h"

namespace metamorph::evolve {

/// Where the nodes of a body were, at moments evenly spread from the start of actuation on. Of a
/// run that failed, those before the failure.
struct Track {
  double interval = 0;                    ///< time units between two frames
  std::vector<std::vector<double>> x, y;  ///< [frames][nodes] d

  int frame_count() const { return static_cast<int>(x.size()); }
};

/// How fast every node moves at a frame of a track, d per time unit.
std::vector<double> speeds_at(const Track& track, int frame);

/// One body that moves in one scene.
struct Motion {
  std::string name;  ///< of the trial; of a body by itself "body"
  int stage = -1;    ///< development step at which the body was taken; -1: of a body by itself
  core::Status status = core::Status::ok;  ///< another one: there is no body, nothing moved
  core::Body body;                         ///< as it is put into the scene
  BirthStages born;
  core::Scene scene;  ///< with the steps that were chosen
  core::Outcome outcome;
  Track track;
  /// What makes it credible: the other starts of its trial, or starts displaced by
  /// LifeOptions::displacement; and the plain float64 reference at a quarter of the step.
  std::vector<Track> copies;
  std::optional<Track> reference;
};

/// What can be seen of an animat: from the egg to its last stage, and how it moves in each.
struct Life {
  std::string heading;
  std::optional<Genome> genome;       ///< none: a body by itself
  int generation = 0;                 ///< whose starts are shown
  int end = 0;                        ///< development steps; 0: a body by itself
  std::vector<core::Embryo> embryos;  ///< at every development step from 0 to `end`
  std::vector<int> starts;            ///< the steps at which stages after the first begin
  std::vector<Motion> motions;        ///< in order of life
};

struct LifeOptions {
  double interval = core::paper_step;  ///< time units between frames, at least; as many whole
                                       ///< integrator steps as come nearest, at least one
  int copies = 0;                      ///< nearby starts, where a trial has no others of its own
  double displacement = 1e-3;          ///< d, of those
  bool reference = false;              ///< run the reference, too (slow)
  int threads = 0;                     ///< 0: all
};

/// The life of a genome by the rules of an experiment. A trial that displaces its starts shows
/// those of `generation`: as the main one the start that the recorded outcome is told by (the
/// middle one, see starts.h), the others as copies.
Life life_of(const Experiment& experiment, const Genome& genome, int generation,
             const LifeOptions& options);

/// A body by itself in a scene. Precondition: check(body) finds nothing.
Life life_of(const core::Body& body, const core::Scene& scene,
             const core::LocomotionOptions& locomotion, const LifeOptions& options);

}  // namespace metamorph::evolve
