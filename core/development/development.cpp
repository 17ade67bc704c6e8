#include "metamorph/development.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "core/body/parallel_for.h"
#include "core/development/developer.h"
#include "core/development/link_check.h"
#include "metamorph/threads.h"

namespace metamorph::core {
namespace {

/// Networks of embryos that have one each.
struct SingleNetworks {
  std::span<const Network> networks;
  std::size_t size() const { return networks.size(); }
  Controls operator[](std::size_t n) const { return {{&networks[n], 1}, {}}; }
};

/// Networks of embryos that may have one after the other.
struct Lives {
  std::span<const std::vector<Network>> networks;
  std::span<const int> switches;
  std::size_t size() const { return networks.size(); }
  Controls operator[](std::size_t n) const {
    return {networks[n], networks[n].size() > 1 ? switches : std::span<const int>()};
  }
};

[[maybe_unused]] bool fits(const Controls& controls, const DevelopmentRules& rules) {
  return controls.networks.size() == controls.switches.size() + 1 &&
         std::is_sorted(controls.switches.begin(), controls.switches.end()) &&
         std::all_of(controls.networks.begin(), controls.networks.end(),
                     [&](const Network& network) { return check(network, rules).empty(); });
}

/// Calls develop(developer, n) for every embryo n, each thread with a developer of its own.
template <class All, class Develop>
void for_each_embryo([[maybe_unused]] const All& all, const DevelopmentRules& rules,
                     [[maybe_unused]] std::span<const int> stages, int threads,
                     const Develop& develop) {
  assert(std::is_sorted(stages.begin(), stages.end()));
  assert(stages.empty() || (stages.front() >= 0 && stages.back() <= rules.steps));
  parallel_for<Schedule::dynamic>(
      all.size(), thread_count(threads), [&] { return Developer<float>(rules); },
      [&](Developer<float>& developer, std::size_t n) {
        assert(fits(all[n], rules));
        develop(developer, n);
      });
}

template <class All>
std::vector<std::vector<Embryo>> develop_all(const All& all, const DevelopmentRules& rules,
                                             std::span<const int> stages, int threads) {
  std::vector<std::vector<Embryo>> result(all.size());
  for_each_embryo(all, rules, stages, threads,
                  [&](auto& developer, std::size_t n) { result[n] = developer(all[n], stages); });
  return result;
}

template <class All>
std::vector<LinkCheck> check_all(const All& all, const DevelopmentRules& rules,
                                 std::span<const int> stages, int threads) {
  std::vector<LinkCheck> checks(all.size());
  for_each_embryo(all, rules, stages, threads,
                  [&](auto& developer, std::size_t n) { developer(all[n], stages, &checks[n]); });
  return checks;
}

}  // namespace

std::vector<std::vector<Embryo>> develop(std::span<const Network> networks,
                                         const DevelopmentRules& rules, std::span<const int> stages,
                                         int threads) {
  return develop_all(SingleNetworks{networks}, rules, stages, threads);
}

std::vector<std::vector<Embryo>> develop(std::span<const std::vector<Network>> lives,
                                         std::span<const int> switches,
                                         const DevelopmentRules& rules, std::span<const int> stages,
                                         int threads) {
  return develop_all(Lives{lives, switches}, rules, stages, threads);
}

std::vector<LinkCheck> check_links(std::span<const Network> networks, const DevelopmentRules& rules,
                                   std::span<const int> stages, int threads) {
  return check_all(SingleNetworks{networks}, rules, stages, threads);
}

std::vector<LinkCheck> check_links(std::span<const std::vector<Network>> lives,
                                   std::span<const int> switches, const DevelopmentRules& rules,
                                   std::span<const int> stages, int threads) {
  return check_all(Lives{lives, switches}, rules, stages, threads);
}

}  // namespace metamorph::core
