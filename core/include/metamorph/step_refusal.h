#pragma once

#include <optional>

#include "metamorph/body.h"
#include "metamorph/scene.h"
#include "metamorph/status.h"

namespace metamorph::core {

/// Why a step of a scene cannot be taken with a body, however stiff it is.
struct StepRefusal {
  Status status = Status::step_too_large;
  double largest = 0;  ///< step allowed, time units; 0 with bad_input
  Index node = -1;     ///< whose period decides, if one does
};

/// step_too_large: the step of the run is more than a quarter of the shortest period, which it
/// would not resolve, or longer than the run (of a run that has a length). bad_input: a step is
/// not a finite number > 0, or so small that the steps cannot be counted. Nothing if the steps can
/// be taken, stable or not; steps left to the program (automatic_step) always can.
std::optional<StepRefusal> refused_step(const Body& body, const Scene& scene);

}  // namespace metamorph::core
