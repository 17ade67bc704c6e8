#include "core/development/delaunay.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>
#include <utility>

#include "core/body/predicates.h"

namespace metamorph::core {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

std::array<Index, 2> ascending(Index a, Index b) {
  return a < b ? std::array<Index, 2>{a, b} : std::array<Index, 2>{b, a};
}

std::array<Index, 3> lowest_first(std::array<Index, 3> face) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

Kernel::Point_2 exact(Point p) { return {p.x, p.y}; }

}  // namespace

int exact_orientation(Point a, Point b, Point c) {
  return static_cast<int>(CGAL::orientation(exact(a), exact(b), exact(c)));
}

int exact_in_circle(Point a, Point b, Point c, Point d) {
  static const Delaunay perturbation;
  return static_cast<int>(
      perturbation.side_of_oriented_circle(exact(a), exact(b), exact(c), exact(d), true));
}

void triangulate(std::span<const double> x, std::span<const double> y, Triangulation& result) {
  assert(x.size() == y.size());
  result.edges.clear();
  result.faces.clear();

  // Coincident points are set aside first: which of them a triangulation keeps would depend on the
  // order of insertion.
  std::vector<Index> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::pair(x[at(a)], y[at(a)]) < std::pair(x[at(b)], y[at(b)]) ||
           (x[at(a)] == x[at(b)] && y[at(a)] == y[at(b)] && a < b);
  });
  std::vector<std::pair<Kernel::Point_2, Index>> points;
  points.reserve(order.size());
  for (const Index i : order) {
    const Kernel::Point_2 point(x[at(i)], y[at(i)]);
    if (!points.empty() && points.back().first == point) {
      result.edges.push_back(ascending(points.back().second, i));
    } else {
      points.emplace_back(point, i);
    }
  }

  const Delaunay delaunay(points.begin(), points.end());
  for (auto edge = delaunay.finite_edges_begin(); edge != delaunay.finite_edges_end(); ++edge) {
    const auto& [face, opposite] = *edge;
    result.edges.push_back(ascending(face->vertex(Delaunay::cw(opposite))->info(),
                                     face->vertex(Delaunay::ccw(opposite))->info()));
  }
  if (delaunay.dimension() == 2) {
    for (const auto face : delaunay.finite_face_handles()) {
      result.faces.push_back(lowest_first(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()}));
    }
  }
  std::sort(result.edges.begin(), result.edges.end());
  std::sort(result.faces.begin(), result.faces.end());
}

}  // namespace metamorph::core
