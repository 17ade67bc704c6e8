#include "core/body/symmetry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "kernels/elementary.h"

namespace metamorph::core {
namespace {

constexpr double reach2 = 0.25;     ///< squared distance of partners, d^2
constexpr double vanishing = 1e-9;  ///< share of the largest possible below which a harmonic is 0
constexpr std::size_t most_axes = 4;

/// A point as seen from the mean of the nodes.
struct Point {
  double x = 0, y = 0;
};
Point times(Point a, Point b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
double squared(Point p) { return p.x * p.x + p.y * p.y; }

/// (cos(pi t), sin(pi t)) for any t.
Point unit_point(double t) {
  Point p;
  kernels::sin_cos_pi(t - 2 * std::floor(0.5 * t + 0.5), p.y, p.x);
  return p;
}

/// The t in [-1, 1] for which unit_point(t) has the direction of p, from functions that have the
/// same bits everywhere.
double half_turns(Point p) {
  const double size = std::sqrt(squared(p));
  const Point upper{p.x / size, std::fabs(p.y) / size};
  const auto ahead = [&](double t) {  // sine of the angle from unit_point(t) to it
    const Point m = unit_point(t);
    return m.x * upper.y - m.y * upper.x;
  };
  double t = 0.5;
  for (double part = 0.25; part > 0.05; part /= 2) t += ahead(t) > 0 ? part : -part;
  // An error e of the angle, now at most pi/16, becomes e^3 / 6.
  for (int i = 0; i < 3; ++i) t += ahead(t) / std::numbers::pi;
  return p.y < 0 ? -t : t;
}

std::vector<Point> centred_nodes(const Body& body) {
  Point mean;
  const auto count = static_cast<double>(body.x.size());
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    mean.x += (body.x[i] - body.x[0]) / count;
    mean.y += (body.y[i] - body.y[0]) / count;
  }
  std::vector<Point> nodes(body.x.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i] = {body.x[i] - body.x[0] - mean.x, body.y[i] - body.y[0] - mean.y};
  }
  return nodes;
}

/// The sums over the nodes of r^2 exp(i k phi) for k = 1, 2, ...; those that vanish are 0.
using Harmonics = std::array<Point, 6>;

Harmonics harmonics_of(const std::vector<Point>& nodes) {
  Harmonics sums{};
  double possible = 0;
  for (const Point& node : nodes) {
    const double r2 = squared(node);
    if (r2 == 0) continue;
    possible += r2;
    const double r = std::sqrt(r2);
    Point power{r2, 0};
    for (Point& sum : sums) {
      power = times(power, {node.x / r, node.y / r});
      sum.x += power.x;
      sum.y += power.y;
    }
  }
  for (Point& sum : sums) {
    if (squared(sum) <= vanishing * vanishing * possible * possible) sum = {};
  }
  return sums;
}

/// How far the harmonics c_k are from those of a body that is symmetric about the axis at an angle
/// a: then c_k = exp(2 i k a) conj(c_k).
double misfit(const Harmonics& sums, Point axis) {
  double squares = 0;
  Point turned{1, 0};
  for (const Point& sum : sums) {
    turned = times(turned, axis);
    const Point image = times(turned, {sum.x, -sum.y});
    squares += squared({sum.x - image.x, sum.y - image.y});
  }
  return squares;
}

/// Axes at angles a as exp(2 i a), by which the mirror image of z is exp(2 i a) conj(z): of those
/// that one harmonic allows, k a being its argument but for multiples of pi, and the one through
/// the node farthest out, the few that fit all harmonics best.
std::vector<Point> likely_axes(const std::vector<Point>& nodes) {
  const Point farthest = *std::max_element(
      nodes.begin(), nodes.end(), [](Point a, Point b) { return squared(a) < squared(b); });
  const Harmonics sums = harmonics_of(nodes);
  std::vector<std::pair<double, Point>> found;  // with their misfit
  const auto add = [&](Point axis) { found.emplace_back(misfit(sums, axis), axis); };
  if (const double r2 = squared(farthest); r2 > 0) {
    const Point square = times(farthest, farthest);
    add({square.x / r2, square.y / r2});
  }
  for (std::size_t k = 1; k <= sums.size(); ++k) {
    if (squared(sums[k - 1]) == 0) continue;
    const double argument = half_turns(sums[k - 1]);
    for (std::size_t j = 0; j < k; ++j) {
      add(unit_point(2 * (argument + static_cast<double>(j)) / static_cast<double>(k)));
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Point> axes;
  for (std::size_t i = 0; i < std::min(found.size(), most_axes); ++i) {
    axes.push_back(found[i].second);
  }
  return axes;
}

/// Nodes by squares of side 1, twice the distance of partners: whatever lies that near lies in one
/// of the two by two squares that meet nearest to a point. Nodes farther out than `most` squares
/// share the last one.
class Squares {
 public:
  explicit Squares(const std::vector<Point>& nodes) {
    Point top;
    for (const Point& node : nodes) {
      least_ = {std::min(least_.x, node.x), std::min(least_.y, node.y)};
      top = {std::max(top.x, node.x), std::max(top.y, node.y)};
    }
    columns_ = 1 + column(top.x, most);
    rows_ = 1 + row(top.y, most);
    first_.assign(columns_ * rows_ + 1, 0);
    nodes_.resize(nodes.size());
    const auto square = [&](const Point& node) {
      return row(node.y, rows_ - 1) * columns_ + column(node.x, columns_ - 1);
    };
    for (const Point& node : nodes) ++first_[square(node) + 1];
    for (std::size_t s = 1; s < first_.size(); ++s) first_[s] += first_[s - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Point& node : nodes) nodes_[next[square(node)]++] = node;
  }

  /// Whether a node lies within the distance of partners.
  bool near(Point p) const {
    constexpr double half = 0.5;
    const std::size_t c0 = column(p.x - half, columns_ - 1), c1 = column(p.x + half, columns_ - 1);
    const std::size_t r0 = row(p.y - half, rows_ - 1), r1 = row(p.y + half, rows_ - 1);
    for (std::size_t r = r0; r <= r1; ++r) {
      // Squares of one row follow one another.
      const std::size_t end = first_[r * columns_ + c1 + 1];
      for (std::size_t n = first_[r * columns_ + c0]; n < end; ++n) {
        if (squared({nodes_[n].x - p.x, nodes_[n].y - p.y}) <= reach2) return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t most = 127;

  static std::size_t place(double offset, std::size_t last) {
    return static_cast<std::size_t>(std::clamp(offset, 0.0, static_cast<double>(last)));
  }
  std::size_t column(double x, std::size_t last) const { return place(x - least_.x, last); }
  std::size_t row(double y, std::size_t last) const { return place(y - least_.y, last); }

  Point least_;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> first_;  ///< [squares + 1]
  std::vector<Point> nodes_;
};

}  // namespace

double symmetry_of(const Body& body) {
  const std::vector<Point> nodes = centred_nodes(body);
  const Squares squares(nodes);
  std::size_t fewest = nodes.size();  // nodes without a partner
  for (const Point& axis : likely_axes(nodes)) {
    std::size_t alone = 0;
    for (std::size_t i = 0; i < nodes.size() && alone < fewest; ++i) {
      if (!squares.near(times(axis, {nodes[i].x, -nodes[i].y}))) ++alone;
    }
    fewest = alone;
    if (fewest == 0) break;
  }
  return 1 - static_cast<double>(fewest) / static_cast<double>(nodes.size());
}

}  // namespace metamorph::core
