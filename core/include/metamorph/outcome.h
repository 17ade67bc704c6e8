#pragma once

#include <array>
#include <cstdint>

#include "metamorph/body.h"
#include "metamorph/status.h"

namespace metamorph::core {

/// What one animat did in one scene (MODEL section 4, "Outcome").
struct Outcome {
  Status status = Status::ok;
  std::array<double, 2>
      mean_position{};  ///< final mean node position: x from the start of actuation;
                        ///< y likewise in water, above the ground on land; d
  double distance = 0;  ///< by the scene's rule; 0 if the evaluation failed
  int cells = 0;        ///< nodes of the body
  int springs = 0;
  int triangles = 0;
  std::int64_t steps = 0;        ///< integrator steps taken, settling included
  double step = 0;               ///< time units per integrator step of the run
  double settle_step = 0;        ///< the same of settling; 0 where there is none
  bool near_step_limit = false;  ///< a step takes more of its limit than the margin (stability.h)
  double settle_time = 0;        ///< time units until quiet (or time-out)
  double min_area_ratio = 1;     ///< smallest S/S0 seen
  double max_speed = 0;          ///< largest node speed seen, d per time unit
  double height = 0;             ///< of the body as actuation begins: at rest on land, d
  double stance = 0;             ///< share of looks at which a node touches the ground, mean over
                                 ///< the nodes of the outline that ever touch it
  double gait_frequency = 0;     ///< at which the mean node position moves most, 1/time unit; 0:
                                 ///< none was found
  double longest_spring = 0;     ///< longest rest length, d
  double long_spring_share = 0;  ///< share of springs with rest length above 1.5 d

  // Of a failure: where it showed.
  std::int64_t failed_step = -1;  ///< integrator step at which it was detected
  int failed_index = -1;          ///< node, triangle or, if crossed, spring, by status
  double failed_value = 0;        ///< the offending speed or area ratio; the largest step
                                  ///< allowed; if crossed, the node beyond the outline edge
};

/// An outcome with what the body alone decides: counts and spring lengths.
Outcome describe(const Body& body);

}  // namespace metamorph::core
