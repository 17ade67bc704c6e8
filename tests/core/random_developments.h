#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "metamorph/development.h"
#include "tests/core/network_builder.h"

namespace metamorph::core::testing {

inline bool same(const Embryo& a, const Embryo& b) {
  return a.step == b.step && a.status == b.status && a.id == b.id && a.mother == b.mother &&
         a.birth_step == b.birth_step && a.x == b.x && a.y == b.y &&
         a.orientation == b.orientation && a.period == b.period && a.phase == b.phase &&
         a.links == b.links && a.faces == b.faces && a.created == b.created && a.died == b.died;
}

inline bool same(const std::vector<Embryo>& a, const std::vector<Embryo>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Embryo& p, const Embryo& q) { return same(p, q); });
}

inline std::vector<Network> population(std::uint64_t seed, std::uint32_t count) {
  std::vector<Network> networks;
  for (std::uint32_t i = 0; i < count; ++i) networks.push_back(random_network(seed, i));
  return networks;
}

inline std::vector<std::vector<Embryo>> grow(const std::vector<Network>& networks,
                                             const std::vector<int>& stages, int threads = 1,
                                             const DevelopmentRules& rules = {}) {
  return develop(networks, rules, stages, threads);
}

}  // namespace metamorph::core::testing
