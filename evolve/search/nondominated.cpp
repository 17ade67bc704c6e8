#include "evolve/search/nondominated.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace metamorph::evolve {
namespace {

/// `a` stands before `b` in the list.
enum class Relation { neither, a_dominates, b_dominates };
Relation compare(const std::vector<double>& a, const std::vector<double>& b) {
  bool a_better = false, b_better = false;
  for (std::size_t o = 0; o < a.size(); ++o) {
    a_better |= a[o] > b[o];
    b_better |= b[o] > a[o];
  }
  if (a_better && b_better) return Relation::neither;
  return b_better ? Relation::b_dominates : Relation::a_dominates;
}

}  // namespace

std::vector<int> front_numbers(std::span<const std::vector<double>> points) {
  std::vector<std::vector<std::size_t>> dominated(points.size());
  std::vector<int> dominators(points.size(), 0);
  for (std::size_t b = 0; b < points.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const Relation relation = compare(points[a], points[b]);
      if (relation == Relation::neither) continue;
      const bool first = relation == Relation::a_dominates;
      dominated[first ? a : b].push_back(first ? b : a);
      ++dominators[first ? b : a];
    }
  }
  std::vector<int> front(points.size(), 0);
  std::vector<std::size_t> present;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (dominators[p] == 0) present.push_back(p);
  }
  for (int number = 0; !present.empty(); ++number) {
    std::vector<std::size_t> next;
    for (const std::size_t p : present) {
      front[p] = number;
      for (const std::size_t other : dominated[p]) {
        if (--dominators[other] == 0) next.push_back(other);
      }
    }
    present = std::move(next);
  }
  return front;
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
