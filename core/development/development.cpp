#include "metamorph/development.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "core/development/developer.h"
#include "core/development/link_check.h"
#include "metamorph/threads.h"

namespace metamorph::core {
namespace {

/// Calls develop(developer, n) for every network n, each thread with a developer of its own.
template <class Develop>
void for_each_network(std::span<const Network> networks, const DevelopmentRules& rules,
                      [[maybe_unused]] std::span<const int> stages, int threads,
                      const Develop& develop) {
  assert(std::is_sorted(stages.begin(), stages.end()));
  assert(std::all_of(networks.begin(), networks.end(),
                     [&](const Network& network) { return check(network, rules).empty(); }));
  assert(stages.empty() || (stages.front() >= 0 && stages.back() <= rules.steps));
  const auto count = static_cast<std::ptrdiff_t>(networks.size());
#pragma omp parallel num_threads(thread_count(threads))
  {
    Developer<float> developer(rules);
#pragma omp for schedule(dynamic)
    for (std::ptrdiff_t i = 0; i < count; ++i) develop(developer, static_cast<std::size_t>(i));
  }
}

}  // namespace

std::vector<std::vector<Embryo>> develop(std::span<const Network> networks,
                                         const DevelopmentRules& rules, std::span<const int> stages,
                                         int threads) {
  std::vector<std::vector<Embryo>> result(networks.size());
  for_each_network(networks, rules, stages, threads, [&](auto& developer, std::size_t n) {
    result[n] = developer(networks[n], stages);
  });
  return result;
}

std::vector<LinkCheck> check_links(std::span<const Network> networks, const DevelopmentRules& rules,
                                   std::span<const int> stages, int threads) {
  std::vector<LinkCheck> checks(networks.size());
  for_each_network(networks, rules, stages, threads, [&](auto& developer, std::size_t n) {
    developer(networks[n], stages, &checks[n]);
  });
  return checks;
}

}  // namespace metamorph::core
