#include "core/triangulation_repair.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "core/delaunay.h"
#include "kernels/in_circle.h"

namespace metamorph::core {
namespace {

constexpr Index ghost = GhostMesh::ghost;

}  // namespace

void TriangulationRepair::update(std::span<const double> x, std::span<const double> y,
                                 std::span<const Index> previous) {
  assert(x.size() == y.size() && x.size() == previous.size());
  changed_ = false;
  inserted_.clear();
  target_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) target_[i] = {x[i], y[i]};
  // Points are taken out at their old positions, where the mesh is a triangulation.
  const bool prepared = !mesh_.empty() && remove_dead(previous) && remove_folding();
  points_.swap(target_);
  if (!prepared || !repair(previous)) {
    rebuild(x, y);
  } else if (changed_) {
    mesh_.list_edges(static_cast<Index>(x.size()), edges_);
  }
}

void TriangulationRepair::rebuild(std::span<const double> x, std::span<const double> y) {
  Triangulation triangulation;
  triangulate(x, y, triangulation);
  mesh_.connect(triangulation.faces, static_cast<Index>(x.size()));
  edges_ = std::move(triangulation.edges);
  changed_ = true;
  ++rebuilds_;
}

std::vector<std::array<Index, 3>> TriangulationRepair::faces() const {
  if (!mesh_.empty()) {
    std::vector<std::array<Index, 3>> faces;
    mesh_.list_faces(faces);
    return faces;
  }
  std::vector<double> x, y;
  for (const Point& p : points_) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
  Triangulation triangulation;
  triangulate(x, y, triangulation);
  return std::move(triangulation.faces);
}

bool TriangulationRepair::repair(std::span<const Index> previous) {
  if (!settle_all() || !hull_winds_once()) return false;
  const auto first_new = std::find(previous.begin(), previous.end(), -1) - previous.begin();
  for (auto i = static_cast<Index>(first_new); i < static_cast<Index>(previous.size()); ++i) {
    inserted_.push_back(i);
  }
  return std::all_of(inserted_.begin(), inserted_.end(), [this](Index i) { return insert(i); });
}

/// Puts a point into the face around it, in a Delaunay triangulation. False if it lies on an edge.
bool TriangulationRepair::insert(Index vertex) {
  const int f = face_around(point(vertex));
  if (f < 0) return false;
  mesh_.split(f, vertex);
  changed_ = true;
  const int last = mesh_.face_count() - 1;
  doubtful_ = {{f, 2}, {last - 1, 2}, {last, 2}};
  return settle_doubtful();
}

/// Walks to the face that contains a point, or to a ghost face from whose hull edge the point is
/// seen. -1 if it lies on a straight line with an edge on the way's end, or if there is no end.
int TriangulationRepair::face_around(Point target) const {
  int f = mesh_.face_count() - 1;
  if (const int corner = mesh_.ghost_corner(f); corner >= 0) f = mesh_.across(f, corner);
  for (int steps = 0; steps < mesh_.face_count(); ++steps) {
    if (mesh_.ghost_corner(f) >= 0) return f;
    bool on_line = false;
    int beyond = -1;
    for (int i = 0; i < 3 && beyond < 0; ++i) {
      const int side = orientation(point(mesh_.vertex(f, GhostMesh::next(i))),
                                   point(mesh_.vertex(f, GhostMesh::before(i))), target);
      if (side < 0) beyond = mesh_.across(f, i);
      on_line = on_line || side == 0;
    }
    if (beyond < 0) return on_line ? -1 : f;
    f = beyond;
  }
  return -1;
}

/// An edge between real faces whose circles are not empty, or a corner of the hull that is dented.
bool TriangulationRepair::is_illegal(Side side) const {
  const auto [a, b, c, d] = mesh_.around(side);
  if (c == ghost || d == ghost) return false;  // an edge of the hull
  if (a == ghost) return orientation_of(c, b, d) < 0;
  if (b == ghost) return orientation_of(d, a, c) < 0;
  return in_circle(point(c), point(a), point(b), point(d)) > 0;
}

/// Flips until no edge is illegal. False if that takes suspiciously long.
bool TriangulationRepair::settle_all() {
  doubtful_.clear();
  collect_inner_edges();
  const kernels::QuadrilateralView view = {corners_[0].data(), corners_[1].data(),
                                           corners_[2].data(), corners_[3].data()};
  const auto* points = reinterpret_cast<const double(*)[2]>(points_.data());
  const int found = kernels::not_certainly_outside(points, view, static_cast<int>(sides_.size()),
                                                   suspects_.data());
  for (int s = 0; s < found; ++s) {
    const Side side = sides_[static_cast<std::size_t>(suspects_[static_cast<std::size_t>(s)])];
    if (is_illegal(side)) doubtful_.push_back(side);
  }
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const int corner = mesh_.ghost_corner(f);
    if (corner < 0) continue;
    const Side dent = {f, GhostMesh::next(corner)};
    if (is_illegal(dent)) doubtful_.push_back(dent);
  }
  return settle_doubtful();
}

/// Fills sides_ with each edge between two real faces, once, and corners_ with their corners.
void TriangulationRepair::collect_inner_edges() {
  const std::size_t most = 3 * static_cast<std::size_t>(mesh_.face_count()) + 16;
  sides_.resize(most);
  suspects_.resize(most);
  for (auto& corner : corners_) corner.resize(most);
  std::size_t count = 0;
  for (int f = 0; f < mesh_.face_count(); ++f) {
    for (int i = 0; i < 3; ++i) {
      // Written first and counted after: which of an edge's faces comes first is a toss-up.
      const Side side = {f, i};
      const auto [a, b, c, d] = mesh_.around(side);
      sides_[count] = side;
      corners_[0][count] = c;
      corners_[1][count] = a;
      corners_[2][count] = b;
      corners_[3][count] = d;
      count +=
          static_cast<std::size_t>((side.code < mesh_.twin(side).code) & ((a | b | c | d) >= 0));
    }
  }
  for (auto& corner : corners_)
    std::fill_n(corner.begin() + static_cast<std::ptrdiff_t>(count), 16, 0);
  sides_.resize(count);
}

/// The same, where only edges in doubtful_ can be illegal.
bool TriangulationRepair::settle_doubtful() {
  int flips_left = 100 + 10 * mesh_.face_count();
  while (!doubtful_.empty()) {
    const Side side = doubtful_.back();
    doubtful_.pop_back();
    if (!is_illegal(side)) continue;
    const int f = side.face(), g = mesh_.twin(side).face();
    if (--flips_left < 0 || !flip(side)) return false;
    for (const Side edge : {Side{f, 0}, Side{f, 2}, Side{g, 0}, Side{g, 1}}) {
      doubtful_.push_back(edge);
    }
  }
  return true;
}

/// Whether the hull turns left all the way around, and around once. Together with faces that are
/// all counter-clockwise this leaves nothing overlapping: the sum of the faces' angles is that of a
/// simple polygon with every inner point surrounded once.
bool TriangulationRepair::hull_winds_once() const {
  int start = 0;
  while (mesh_.ghost_corner(start) < 0) ++start;
  const auto upward = [](Point from, Point to) {
    return to.y > from.y || (to.y == from.y && to.x > from.x);
  };
  int windings = 0;
  int f = start;
  do {
    const int corner = mesh_.ghost_corner(f);
    const int after = mesh_.across(f, GhostMesh::before(corner));
    const Point p = point(mesh_.vertex(f, GhostMesh::before(corner)));
    const Point q = point(mesh_.vertex(f, GhostMesh::next(corner)));
    const Point r = point(mesh_.vertex(after, GhostMesh::next(mesh_.ghost_corner(after))));
    const int turn = orientation(p, q, r);
    if (turn < 0) return false;
    if (turn == 0 && upward(p, q) != upward(q, r)) return false;
    windings += !upward(p, q) && upward(q, r);
    f = after;
  } while (f != start);
  return windings == 1;
}

}  // namespace metamorph::core
