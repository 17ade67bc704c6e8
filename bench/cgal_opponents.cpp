#include "bench/cgal_opponents.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace metamorph::bench {
namespace {

using core::Index;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void list_edges(const Delaunay& delaunay, Edges& edges) {
  edges.clear();
  for (auto edge = delaunay.finite_edges_begin(); edge != delaunay.finite_edges_end(); ++edge) {
    const auto& [face, opposite] = *edge;
    const Index a = face->vertex(Delaunay::cw(opposite))->info();
    const Index b = face->vertex(Delaunay::ccw(opposite))->info();
    edges.push_back({std::min(a, b), std::max(a, b)});
  }
}

}  // namespace

void cgal_insert(std::span<const double> x, std::span<const double> y, Edges& edges) {
  std::vector<std::pair<Kernel::Point_2, Index>> points;
  points.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.emplace_back(Kernel::Point_2(x[i], y[i]), static_cast<Index>(i));
  }
  list_edges(Delaunay(points.begin(), points.end()), edges);
}

struct CgalMoves::Kept {
  Delaunay delaunay;
  std::vector<Delaunay::Vertex_handle> vertex, next;  ///< of each point
};

CgalMoves::CgalMoves() : kept_(std::make_unique<Kept>()) {}
CgalMoves::~CgalMoves() = default;

void CgalMoves::clear() {
  kept_->delaunay.clear();
  kept_->vertex.clear();
}

void CgalMoves::update(std::span<const double> x, std::span<const double> y,
                       std::span<const Index> previous) {
  auto& [delaunay, vertex, next] = *kept_;
  next.assign(x.size(), {});
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (previous[i] >= 0) std::swap(next[i], vertex[at(previous[i])]);
  }
  for (const auto& dead : vertex) {
    if (dead != Delaunay::Vertex_handle()) delaunay.remove(dead);
  }
  Delaunay::Face_handle near;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Kernel::Point_2 point(x[i], y[i]);
    if (next[i] == Delaunay::Vertex_handle()) {
      next[i] = delaunay.insert(point, near);
    } else {
      next[i] = delaunay.move_if_no_collision(next[i], point);
    }
    next[i]->info() = static_cast<Index>(i);
    near = next[i]->face();
  }
  vertex.swap(next);
}

void CgalMoves::list(Edges& edges) const { list_edges(kept_->delaunay, edges); }

}  // namespace metamorph::bench
