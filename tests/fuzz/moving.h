#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "metamorph/automatic_step.h"
#include "metamorph/locomotion.h"
#include "metamorph/outcome_fields.h"
#include "tests/fuzz/contract.h"

namespace metamorph::fuzz {

/// Moves a sound body for a moment: in which scene and how says `choice`. What ends well has
/// numbers.
inline void move(const core::Body& body, std::uint64_t choice) {
  const auto chosen = [&choice](std::uint64_t of) {
    const std::uint64_t one = choice % of;
    choice /= of;
    return one;
  };
  core::Scene scene;
  switch (chosen(4)) {
    case 0:
      scene = core::water_scene();
      break;
    case 1:
      scene = core::land_scene();
      break;
    case 2:
      scene = core::land_right_scene();
      break;
    default:
      scene = core::slope_scene();
  }
  scene.run_steps = 60;
  scene.ramp_steps = 20;
  scene.settle_quiet_steps = 20;
  scene.settle_max_steps = 40;
  if (chosen(2) == 0) scene.step = scene.settle_step = core::automatic_step;
  const core::LocomotionOptions options{
      chosen(2) == 0 ? core::Precision::float32 : core::Precision::float64,
      chosen(4) != 0 ? core::Method::drift_kick_drift : core::Method::symplectic_euler, 1};

  // A stiff body may be given steps so short that it would take hours.
  constexpr double most_node_steps = 1e5;
  const core::Scene timed = core::with_chosen_steps(body, scene, options.method);
  const double steps = core::paper_step *
                       (scene.run_steps / timed.step + scene.settle_max_steps / timed.settle_step);
  if (!(steps * body.node_count() < most_node_steps)) return;

  const core::LocomotionTask task{&body, &scene};
  const core::Outcome outcome = core::simulate({&task, 1}, options).front();
  if (core::is_failure(outcome.status)) {
    require(outcome.distance == 0, "who fails goes nowhere");
    return;
  }
  core::visit_columns(outcome, [](const core::OutcomeColumn& column, const auto& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) {
      require(!column.applies || std::isfinite(value), "what ends well has numbers", column.name);
    }
  });
}

}  // namespace metamorph::fuzz
