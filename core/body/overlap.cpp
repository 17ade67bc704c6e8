#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/body/area.h"
#include "metamorph/shape.h"

namespace metamorph::core {
namespace {

constexpr double line_distance = 0.125;  ///< d
constexpr double most_lines = 4096;      ///< then they lie farther apart

/// A body as seen from its centroid.
struct Centred {
  std::vector<double> x, y;  ///< [nodes]
  std::vector<std::array<Index, 2>> outline;
  double bottom = 0, top = 0;

  explicit Centred(const Body& body) : x(body.x), y(body.y), outline(outline_of(body.triangles)) {
    const auto [cx, cy] = area_of(body).centroid;
    for (double& value : x) value -= cx;
    for (double& value : y) value -= cy;
    const auto [least, most] = std::minmax_element(y.begin(), y.end());
    bottom = *least;
    top = *most;
  }
};

/// Horizontal lines at y = first, first + distance, ...
struct Lines {
  double first, distance;
  std::size_t count;
  double height(std::size_t line) const { return first + static_cast<double>(line) * distance; }
};

/// Where each line crosses an outline, ascending: it enters and leaves the body by turns, whatever
/// holes and pinches there are.
struct Crossings {
  std::vector<std::size_t> first;  ///< [lines + 1]
  std::vector<double> x;

  Crossings(const Centred& body, const Lines& lines) : first(lines.count + 1, 0) {
    visit(body, lines, [&](std::size_t line, double) { ++first[line + 1]; });
    for (std::size_t l = 1; l < first.size(); ++l) first[l] += first[l - 1];
    x.resize(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    visit(body, lines, [&](std::size_t line, double value) {
      // There are few on a line: insertion is the fastest sort.
      std::size_t place = next[line]++;
      for (; place > first[line] && x[place - 1] > value; --place) x[place] = x[place - 1];
      x[place] = value;
    });
  }

 private:
  /// A line crosses an edge if one end lies below it and the other does not.
  template <class Visit>
  static void visit(const Centred& body, const Lines& lines, Visit&& crossing) {
    for (const auto& edge : body.outline) {
      auto a = static_cast<std::size_t>(edge[0]), b = static_cast<std::size_t>(edge[1]);
      if (body.y[b] < body.y[a]) std::swap(a, b);
      const double slope = (body.x[b] - body.x[a]) / (body.y[b] - body.y[a]);
      const double start = (body.y[a] - lines.first) / lines.distance - 1;
      auto line = static_cast<std::size_t>(std::clamp(start, 0.0, most_lines));
      for (; line < lines.count && lines.height(line) < body.y[b]; ++line) {
        const double up = lines.height(line) - body.y[a];
        if (up >= 0) crossing(line, body.x[a] + up * slope);
      }
    }
  }
};

/// The length that lies in a body, in another, and in both, of one line after the other.
struct Lengths {
  double a = 0, b = 0, both = 0;

  void add(const Crossings& first, const Crossings& second, std::size_t line) {
    std::size_t i = first.first[line], j = second.first[line];
    const std::size_t end_i = first.first[line + 1], end_j = second.first[line + 1];
    for (std::size_t k = i; k < end_i; k += 2) a += first.x[k + 1] - first.x[k];
    for (std::size_t k = j; k < end_j; k += 2) b += second.x[k + 1] - second.x[k];
    while (i < end_i && j < end_j) {
      const double left = std::max(first.x[i], second.x[j]);
      const double right = std::min(first.x[i + 1], second.x[j + 1]);
      if (right > left) both += right - left;
      (first.x[i + 1] < second.x[j + 1] ? i : j) += 2;
    }
  }
};

}  // namespace

double overlap(const Body& a, const Body& b) {
  const Centred first(a), second(b);
  const double bottom = std::min(first.bottom, second.bottom);
  const double top = std::max(first.top, second.top);
  const double distance = std::max(line_distance, (top - bottom) / most_lines);
  // Half a distance above and below the centroid, and so on: turned by half a turn the same.
  const double below = std::ceil(-bottom / distance - 0.5), above = std::ceil(top / distance - 0.5);
  const Lines lines{(0.5 - below) * distance, distance, static_cast<std::size_t>(below + above)};
  const Crossings crossings_a(first, lines), crossings_b(second, lines);
  Lengths lengths;
  for (std::size_t line = 0; line < lines.count; ++line) {
    lengths.add(crossings_a, crossings_b, line);
  }
  const double either = lengths.a + lengths.b - lengths.both;
  return either > 0 ? std::min(1.0, lengths.both / either) : 1;
}

}  // namespace metamorph::core
