#pragma once

// Hand-made embryos for tests: cells at given points, faces and links by brute force from the
// definitions of MODEL section 2.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "metamorph/development.h"
#include "metamorph/random.h"

namespace metamorph::tests {

using Point = std::pair<double, double>;

/// Moves every point by up to `amount` in x and y: no four cells on a circle, no three on a line.
inline std::vector<Point> jittered(std::vector<Point> points, double amount = 1e-3) {
  evolve::RandomStream random(evolve::Purpose::test, 4711, 0, 0);
  for (auto& [x, y] : points) {
    x += amount * random.triangular();
    y += amount * random.triangular();
  }
  return points;
}

/// Delaunay faces by definition: counter-clockwise triples with no other point inside their
/// circumcircle. In O(n^4); throws unless the points are in general position (a side would have
/// more than two faces).
inline std::vector<std::array<core::Index, 3>> delaunay_faces(const std::vector<Point>& points) {
  const int n = static_cast<int>(points.size());
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  std::vector<std::array<core::Index, 3>> faces;
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      for (int c = b + 1; c < n; ++c) {
        const auto [ax, ay] = at(a);
        const double bx = at(b).first - ax, by = at(b).second - ay;
        const double cx = at(c).first - ax, cy = at(c).second - ay;
        const double twice_area = bx * cy - by * cx;
        if (twice_area == 0) continue;
        const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
        const double ux = (cy * b2 - by * c2) / (2 * twice_area);
        const double uy = (bx * c2 - cx * b2) / (2 * twice_area);
        bool is_empty = true;
        for (int d = 0; is_empty && d < n; ++d) {
          if (d == a || d == b || d == c) continue;
          const double dx = at(d).first - ax - ux, dy = at(d).second - ay - uy;
          is_empty = dx * dx + dy * dy > ux * ux + uy * uy;
        }
        if (!is_empty) continue;
        if (twice_area > 0) {
          faces.push_back({a, b, c});
        } else {
          faces.push_back({a, c, b});
        }
      }
    }
  }
  std::map<std::array<core::Index, 2>, int> uses;
  for (const auto& face : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(face[k], face[(k + 1) % 3]);
      if (++uses[{low, high}] > 2) throw std::logic_error("four points on a circle");
    }
  }
  return faces;
}

/// The links of MODEL section 2: Delaunay edges up to 1.5 d, and longer ones, ascending, that join
/// two components.
inline std::vector<std::array<core::Index, 2>> model_links(
    const std::vector<Point>& points, const std::vector<std::array<core::Index, 2>>& edges) {
  std::vector<int> part(points.size());
  std::iota(part.begin(), part.end(), 0);
  std::vector<std::tuple<double, core::Index, core::Index>> by_length;
  for (const auto& [a, b] : edges) {
    const auto& [ax, ay] = points[static_cast<std::size_t>(a)];
    const auto& [bx, by] = points[static_cast<std::size_t>(b)];
    by_length.emplace_back(std::hypot(bx - ax, by - ay), a, b);
  }
  std::sort(by_length.begin(), by_length.end());
  std::vector<std::array<core::Index, 2>> links;
  for (const auto& [length, a, b] : by_length) {
    const int from = part[static_cast<std::size_t>(a)], to = part[static_cast<std::size_t>(b)];
    if (length > 1.5 && from == to) continue;
    links.push_back({a, b});
    std::replace(part.begin(), part.end(), from, to);
  }
  std::sort(links.begin(), links.end());
  return links;
}

/// An embryo with given faces and links; periods and phases differ from cell to cell.
inline core::Embryo embryo_of(const std::vector<Point>& points,
                              std::vector<std::array<core::Index, 3>> faces,
                              std::vector<std::array<core::Index, 2>> links) {
  core::Embryo embryo;
  for (const auto& [x, y] : points) {
    const int i = embryo.cell_count();
    embryo.id.push_back(i);
    embryo.mother.push_back(i - 1);
    embryo.birth_step.push_back(30 * i);
    embryo.x.push_back(x);
    embryo.y.push_back(y);
    embryo.orientation.push_back(0.01 * i);
    embryo.period.push_back(30 + 0.25 * i);
    embryo.phase.push_back(0.01 * i - 1);
  }
  embryo.created = embryo.cell_count();
  embryo.faces = std::move(faces);
  embryo.links = std::move(links);
  return embryo;
}

/// The embryo with cells at these points: in general position, or all on the x axis ascending.
inline core::Embryo embryo_at(const std::vector<Point>& points) {
  const auto faces = delaunay_faces(points);
  auto edges = core::edges_of(faces);
  if (faces.empty()) {
    for (int i = 1; i < static_cast<int>(points.size()); ++i) edges.push_back({i - 1, i});
  }
  return embryo_of(points, faces, model_links(points, edges));
}

}  // namespace metamorph::tests
