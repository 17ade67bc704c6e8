#include "evolve/view/motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "metamorph/automatic_step.h"

namespace metamorph::evolve {

std::vector<Snapshot> last_cycle(const core::Body& body, const core::Scene& scene,
                                 const core::LocomotionOptions& options, int count) {
  const core::Scene own = core::with_chosen_steps(body, scene, options.method);
  std::vector<double> periods = body.period;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  const double end = scene.run_steps * core::paper_step;
  const double cycle = std::min(*middle, end);
  std::vector<std::int64_t> steps;
  for (int k = 1; k <= count; ++k) {
    steps.push_back(std::llround((end - cycle + cycle * k / count) / own.step));
  }
  std::vector<Snapshot> snapshots;
  core::simulate_observed({&body, &own}, options, 1, [&](const core::Frame& frame) {
    if (!std::binary_search(steps.begin(), steps.end(), frame.step)) return;
    snapshots.push_back(
        {frame.time, {frame.x.begin(), frame.x.end()}, {frame.y.begin(), frame.y.end()}});
  });
  return snapshots;
}

}  // namespace metamorph::evolve
