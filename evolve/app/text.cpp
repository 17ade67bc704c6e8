#include "evolve/app/text.h"

#include <fmt/format.h>

#include "metamorph/stability.h"

namespace metamorph::evolve {

std::string duration_text(double seconds) {
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string near_limit_text() {
  return fmt::format(
      "with a step above {:.0f} % (water), {:.0f} % (land) or {:.0f} % (settling) of its limit",
      100 * core::water_margin, 100 * core::land_margin, 100 * core::settling_margin);
}

std::string saved_text(const EvaluationWork& work) {
  std::string text;
  const auto add = [&](std::int64_t all, std::int64_t done, const char* what) {
    if (all == 0) return;
    text += fmt::format("{}{} of {} {} ({:.1f} %)", text.empty() ? "" : ", ", all - done, all, what,
                        100.0 * static_cast<double>(all - done) / static_cast<double>(all));
  };
  add(work.individuals, work.developed, "developments");
  add(work.bodies, work.simulated, "simulations");
  return text;
}

std::string failure_text(const core::Outcome& outcome, const core::Body& body) {
  const auto failed = [&](const std::string& how) {
    return fmt::format("failed at step {}: {}", outcome.failed_step, how);
  };
  const auto triangle = [&]() -> std::string {
    if (outcome.failed_index < 0) return "a triangle";
    const auto& [a, b, c] = body.triangles.at(static_cast<std::size_t>(outcome.failed_index));
    return fmt::format("triangle [{}, {}, {}]", a, b, c);
  };
  switch (outcome.status) {
    case core::Status::ok:
    case core::Status::not_settled:
    case core::Status::empty:
    case core::Status::no_body:
    case core::Status::bad_input:
    case core::Status::bad_geometry:
    case core::Status::bad_topology:
    case core::Status::bad_development:
      break;
    case core::Status::step_too_large:
      return fmt::format(
          "the largest step allowed is {:.3g}{}", outcome.failed_value,
          outcome.failed_index < 0
              ? ""
              : fmt::format(", a quarter of the period of node {}", outcome.failed_index));
    case core::Status::inverted:
      return failed(triangle() + " turned inside out");
    case core::Status::collapsed:
      return failed(fmt::format("{} squeezed to {:.3g} of its area at rest", triangle(),
                                outcome.failed_value));
    case core::Status::crossed: {
      const auto& [a, b] = body.springs.at(static_cast<std::size_t>(outcome.failed_index));
      return failed(fmt::format("node {:.0f} crossed edge [{}, {}]", outcome.failed_value, a, b));
    }
    case core::Status::speed:
      return failed(fmt::format("node {} moved at {:.3g} d per time unit", outcome.failed_index,
                                outcome.failed_value));
    case core::Status::non_finite:
      return failed(fmt::format("node {} is no number", outcome.failed_index));
  }
  return "";
}

std::string work_text(double most_steps, double spring_steps, int threads) {
  constexpr double seconds_per_spring_step = 1.5e-9;
  constexpr double worth_telling = 600;  // seconds
  const double seconds = spring_steps * seconds_per_spring_step / threads;
  if (seconds < worth_telling) return "";
  return fmt::format("{:.3g} steps per body, about {} on {} thread{}", most_steps,
                     duration_text(seconds), threads, threads == 1 ? "" : "s");
}

}  // namespace metamorph::evolve
