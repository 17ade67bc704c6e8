#include "evolve/search/local_competition.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/body/parallel_for.h"

namespace metamorph::evolve {
namespace {

using Near = std::pair<double, std::size_t>;  // squared distance, index

double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0;
  for (std::size_t d = 0; d < a.size(); ++d) square += (a[d] - b[d]) * (a[d] - b[d]);
  return square;
}

/// Leaves the k nearest, the nearest first; returns their mean distance, or `alone` of nobody.
double keep_nearest(std::vector<Near>& near, int k, double alone) {
  const std::size_t kept = std::min(near.size(), static_cast<std::size_t>(k));
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(kept), near.end());
  near.resize(kept);
  if (near.empty()) return alone;
  double sum = 0;
  for (const auto& [square, index] : near) sum += std::sqrt(square);
  return sum / static_cast<double>(kept);
}

}  // namespace

std::vector<Neighbourhood> neighbourhoods(std::span<const Placed> all, std::size_t queries, int k,
                                          int threads) {
  std::vector<Neighbourhood> result(queries);
  core::parallel_for<core::Schedule::equal>(queries, threads, [&](std::size_t q) {
    std::vector<Near> near;
    near.reserve(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].id == all[q].id) continue;
      near.emplace_back(squared_distance(all[i].position, all[q].position), i);
    }
    result[q].novelty = keep_nearest(near, k, 0);
    for (const auto& [square, i] : near) result[q].worse += all[i].quality < all[q].quality ? 1 : 0;
  });
  return result;
}

std::vector<double> distances_to_fitter(std::span<const Placed> all, int k, int threads) {
  std::vector<double> result(all.size());
  core::parallel_for<core::Schedule::equal>(all.size(), threads, [&](std::size_t q) {
    std::vector<Near> near;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool fitter =
          all[i].quality > all[q].quality || (all[i].quality == all[q].quality && i < q);
      if (fitter) near.emplace_back(squared_distance(all[i].position, all[q].position), i);
    }
    result[q] = keep_nearest(near, k, std::numeric_limits<double>::infinity());
  });
  return result;
}

}  // namespace metamorph::evolve
