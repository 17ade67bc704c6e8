#include "evolve/app/text.h"

#include <fmt/format.h>

#include "core/stability.h"

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

}  // namespace metamorph::evolve
