#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "metamorph/development.h"

namespace metamorph::core {

/// A debugging aid: whether the links of a development are, at every renewal, those of a full
/// triangulation. Development keeps its triangulation and repairs it; this one is built from
/// nothing each time, which takes longer than all the rest of development.
struct LinkCheck {
  std::int64_t renewals = 0;  ///< compared
  std::int64_t links = 0;     ///< compared

  /// The first renewal at which they differ, if any.
  int step = -1;                              ///< of development; -1: no difference
  std::vector<std::array<Index, 2>> missing;  ///< the full triangulation alone has them
  std::vector<std::array<Index, 2>> surplus;  ///< development alone has them

  bool ok() const { return step < 0; }

  /// Compares the links (i < j, ascending) of one renewal.
  void compare(int at_step, std::span<const double> x, std::span<const double> y, double limit,
               std::span<const std::array<Index, 2>> chosen);
};

/// Develops every network as develop() does, and compares at every renewal of its
/// neighbours. One check for each network; the same for any thread count (0: all threads).
std::vector<LinkCheck> check_links(std::span<const Network> networks, const DevelopmentRules& rules,
                                   std::span<const int> stages, int threads);
std::vector<LinkCheck> check_links(std::span<const std::vector<Network>> lives,
                                   std::span<const int> switches, const DevelopmentRules& rules,
                                   std::span<const int> stages, int threads);

/// The difference in one line; empty if there is none.
std::string difference_text(const LinkCheck& check);

}  // namespace metamorph::core
