#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "metamorph/outcome.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// The frequency at which a mean position (x, y), d, sampled every `interval` time units moves
/// most: of the maxima of the power of its velocity, between four cycles in the whole series and
/// one in four samples, the highest; 1 / time units. 0 if there is none, or none as fast as 1e-4 d
/// per time unit. x and y are of one length; shorter than 17 samples they have no frequency.
double dominant_frequency(std::span<const double> x, std::span<const double> y, double interval);

/// What is seen of the gait of an animat that is looked at between steps, every two time units from
/// the end of the ramp on (every step, if steps are longer).
class GaitWatch {
 public:
  /// Before a run of so many steps, of a body with so many nodes in its outline. Allocates for all
  /// of it.
  void begin(const Scene& scene, double step, std::int64_t steps, std::size_t outline_nodes);

  /// Whether it is to be looked at after step n of the run, the first being 1.
  bool is_due(std::int64_t n) const { return n == next_; }
  /// One look: the mean position, d ...
  void add(double mean_x, double mean_y);
  /// ... and for the node of the outline in each place whether it touches the ground.
  std::span<std::int32_t> touches() { return touches_; }  ///< [outline nodes] looks with a touch
  static constexpr double touching = 0.01;                ///< a node touches up to this height, d

  /// Sets stance and gait_frequency.
  void finish(Outcome& outcome) const;

 private:
  std::int64_t next_ = 0, stride_ = 1;  ///< steps
  double interval_ = 0;                 ///< time units
  std::vector<double> x_, y_;           ///< [looks]
  std::vector<std::int32_t> touches_;
};

}  // namespace metamorph::core
