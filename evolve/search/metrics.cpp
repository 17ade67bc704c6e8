#include "metamorph/metrics.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace metamorph::evolve {

MapWorth map_worth(std::span<const double> qualities, int niches, double offset) {
  MapWorth worth;
  worth.filled = static_cast<int>(qualities.size());
  worth.coverage = static_cast<double>(worth.filled) / niches;
  if (qualities.empty()) return worth;
  double sum = 0;
  worth.best = qualities.front();
  for (const double quality : qualities) {
    worth.qd_score += quality - offset;
    sum += quality;
    worth.best = std::max(worth.best, quality);
  }
  worth.mean = sum / static_cast<double>(qualities.size());
  return worth;
}

namespace {

using Points = std::vector<std::vector<double>>;  // relative to the reference, above it

/// Of two coordinates; `sorted` by the second, the highest first.
double swept(const Points& sorted) {
  double area = 0, reached = 0;
  for (const std::vector<double>& point : sorted) {
    if (point[0] <= reached) continue;
    area += (point[0] - reached) * point[1];
    reached = point[0];
  }
  return area;
}

bool covers(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (a[c] < b[c]) return false;
  }
  return true;
}

/// What none of the others covers; of equal ones one stays.
Points uncovered(const Points& points) {
  Points result;
  for (const std::vector<double>& point : points) {
    if (std::any_of(result.begin(), result.end(),
                    [&](const std::vector<double>& other) { return covers(other, point); })) {
      continue;
    }
    std::erase_if(result, [&](const std::vector<double>& other) { return covers(point, other); });
    result.push_back(point);
  }
  return result;
}

/// The union as the sum of what each point adds to those behind it (While, Bradstreet, Barone
/// 2012): its box less what they cover of it. As those behind are at least as high, the last
/// coordinate is the same in all of these boxes.
double volume(Points points) {
  if (points.empty()) return 0;
  const std::size_t coordinates = points.front().size();
  std::sort(points.begin(), points.end(),
            [](const std::vector<double>& a, const std::vector<double>& b) {
              return a.back() != b.back() ? a.back() > b.back() : a > b;
            });
  if (coordinates == 1) return points.front()[0];
  if (coordinates == 2) return swept(points);
  std::reverse(points.begin(), points.end());
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double base = 1;
    for (std::size_t c = 0; c + 1 < coordinates; ++c) base *= points[i][c];
    Points inside;
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      std::vector<double>& part = inside.emplace_back();
      for (std::size_t c = 0; c + 1 < coordinates; ++c) {
        part.push_back(std::min(points[i][c], points[j][c]));
      }
    }
    sum += points[i].back() * (base - volume(uncovered(inside)));
  }
  return sum;
}

}  // namespace

double hypervolume(const Points& points, std::span<const double> reference) {
  Points above;
  for (const std::vector<double>& point : points) {
    std::vector<double> relative;
    for (std::size_t c = 0; c < reference.size(); ++c) {
      if (point[c] > reference[c]) relative.push_back(point[c] - reference[c]);
    }
    if (relative.size() == reference.size()) above.push_back(std::move(relative));
  }
  return volume(uncovered(above));
}

}  // namespace metamorph::evolve
