#include "core/development.h"

#include <omp.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "core/developer_detail.h"

namespace metamorph::core {

std::vector<std::vector<Embryo>> develop(std::span<const Network> networks,
                                         const DevelopmentRules& rules, std::span<const int> stages,
                                         int threads, std::span<LinkCheck> checks) {
  assert(std::is_sorted(stages.begin(), stages.end()));
  assert(stages.empty() || (stages.front() >= 0 && stages.back() <= rules.steps));
  assert(checks.empty() || checks.size() == networks.size());
  std::vector<std::vector<Embryo>> result(networks.size());
  const int count = static_cast<int>(networks.size());
#pragma omp parallel num_threads(threads > 0 ? threads : omp_get_max_threads())
  {
    Developer<float> developer(rules);
#pragma omp for schedule(dynamic)
    for (int i = 0; i < count; ++i) {
      const auto n = static_cast<std::size_t>(i);
      result[n] = developer(networks[n], stages, checks.empty() ? nullptr : &checks[n]);
    }
  }
  return result;
}

}  // namespace metamorph::core
