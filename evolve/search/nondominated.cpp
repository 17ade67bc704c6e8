#include "evolve/search/nondominated.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace metamorph::evolve {

// Efficient non-dominated sort (Zhang et al. 2015, ENS-BS): takes memory for the points alone,
// where a list of who dominates whom grows as their square.
std::vector<int> front_numbers(std::span<const std::vector<double>> points) {
  // By the first objective in which they differ, then by place: who dominates stands before.
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points[a] > points[b]; });
  std::vector<std::vector<std::size_t>> fronts;
  std::vector<int> number(points.size());
  for (const std::size_t p : order) {
    // Who is dominated in a front is so in all before it.
    const auto place = std::partition_point(
        fronts.begin(), fronts.end(), [&](const std::vector<std::size_t>& members) {
          return std::any_of(members.rbegin(), members.rend(), [&](std::size_t m) {
            return std::equal(points[m].begin(), points[m].end(), points[p].begin(),
                              std::greater_equal<>());
          });
        });
    number[p] = static_cast<int>(place - fronts.begin());
    if (place == fronts.end()) {
      fronts.push_back({p});
    } else {
      place->push_back(p);
    }
  }
  return number;
}

std::vector<double> crowding_distances(std::span<const std::vector<double>> points,
                                       std::span<const std::size_t> members) {
  std::vector<double> crowding(members.size(), 0.0);
  if (members.empty()) return crowding;
  std::vector<std::size_t> order(members.size());
  for (std::size_t o = 0; o < points[members.front()].size(); ++o) {
    const auto value = [&](std::size_t m) { return points[members[m]][o]; };
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
    const double range = value(order.back()) - value(order.front());
    if (!(range > 0)) continue;
    crowding[order.front()] = crowding[order.back()] = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < order.size(); ++i) {
      crowding[order[i]] += (value(order[i + 1]) - value(order[i - 1])) / range;
    }
  }
  return crowding;
}

Ranking rank(std::span<const std::vector<double>> points) {
  Ranking ranking;
  ranking.front = front_numbers(points);
  ranking.crowding.resize(points.size());
  ranking.order.resize(points.size());
  std::iota(ranking.order.begin(), ranking.order.end(), std::size_t{0});
  std::stable_sort(ranking.order.begin(), ranking.order.end(), [&](std::size_t a, std::size_t b) {
    return ranking.front[a] < ranking.front[b];
  });
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    while (end < points.size() &&
           ranking.front[ranking.order[end]] == ranking.front[ranking.order[begin]]) {
      ++end;
    }
    const auto members = std::span(ranking.order).subspan(begin, end - begin);
    const std::vector<double> crowding = crowding_distances(points, members);
    for (std::size_t m = 0; m < members.size(); ++m) ranking.crowding[members[m]] = crowding[m];
    std::stable_sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
      return ranking.crowding[a] > ranking.crowding[b];
    });
  }
  return ranking;
}

}  // namespace metamorph::evolve
