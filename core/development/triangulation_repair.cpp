#include "core/development/triangulation_repair.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>

#include "kernels/in_circle.h"

namespace metamorph::core {
namespace {

constexpr Index ghost = GhostMesh::ghost;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
/// Two ends of an edge that is longer than any limit, and a corner behind which nobody asks.
constexpr Index far_end_a = -3, far_end_b = -2, nowhere = -1;

}  // namespace

TriangulationRepair::TriangulationRepair() {
  for (auto* records : {&points_, &target_}) {
    *records = {{0, 0}, {1e9, 0}, {not_a_number, not_a_number}};
  }
}

void TriangulationRepair::update(std::span<const double> x, std::span<const double> y,
                                 std::span<const Index> previous) {
  assert(x.size() == y.size() && x.size() == previous.size());
  changed_ = false;
  patched_ = true;
  inserted_.clear();
  mesh_.forget_changes();
  refreshed_ = 0;
  target_.resize(stand_ins + x.size());
  for (std::size_t i = 0; i < x.size(); ++i) target_[stand_ins + i] = {x[i], y[i]};
  // Points are taken out at their old positions, where the mesh is a triangulation.
  const bool prepared = !mesh_.empty() && prepare(previous);
  points_.swap(target_);
  if (!prepared || !repair(previous)) rebuild(x, y);
  refresh_touched();
}

void TriangulationRepair::rebuild(std::span<const double> x, std::span<const double> y) {
  Triangulation triangulation;
  triangulate(x, y, triangulation);
  mesh_.connect(triangulation.faces, static_cast<Index>(x.size()));
  refresh_all();
  changed_ = true;
  patched_ = false;
  ++rebuilds_;
}

std::vector<std::array<Index, 2>> TriangulationRepair::edges() {
  if (!mesh_.empty()) {
    std::vector<std::array<Index, 2>> edges;
    mesh_.list_edges(static_cast<Index>(points_.size()) - stand_ins, edges);
    return edges;
  }
  return std::move(anew().edges);
}

std::vector<std::array<Index, 3>> TriangulationRepair::faces() const {
  if (!mesh_.empty()) {
    std::vector<std::array<Index, 3>> faces;
    mesh_.list_faces(faces);
    return faces;
  }
  return std::move(anew().faces);
}

Triangulation TriangulationRepair::anew() const {
  std::vector<double> x, y;
  for (std::size_t i = stand_ins; i < points_.size(); ++i) {
    x.push_back(points_[i].x);
    y.push_back(points_[i].y);
  }
  Triangulation triangulation;
  triangulate(x, y, triangulation);
  return triangulation;
}

/// Fits the mesh to the points that are left, and makes sure that their motion folds no face.
bool TriangulationRepair::prepare(std::span<const Index> previous) {
  if (!remove_dead(previous)) return false;
  refresh_touched();
  find_suspects();
  const bool folds = std::any_of(suspects_.begin(), suspects_.end(),
                                 [this](int edge) { return folding_side(edge).corner() < 3; });
  if (!folds) return true;
  if (!remove_folding()) return false;
  refresh_touched();
  find_suspects();
  return true;
}

bool TriangulationRepair::repair(std::span<const Index> previous) {
  if (!settle()) return false;
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
  // Only edges opposite the new point can be illegal: it is corner c of each that is tested here.
  while (!doubtful_.empty()) {
    const Side side = doubtful_.back();
    doubtful_.pop_back();
    if (!is_illegal(side)) continue;
    const int left = side.face(), right = mesh_.twin(side).face();
    if (!flip(side)) return false;
    doubtful_.push_back({left, 0});
    doubtful_.push_back({right, 0});
  }
  return true;
}

/// A real face somewhere near a point: the nearest of a few.
int TriangulationRepair::face_near(Point target) const {
  constexpr int few = 8;
  const int stride = mesh_.face_count() / few + 1;
  int nearest = mesh_.face_count() - 1;
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < mesh_.face_count(); f += stride) {
    const Index v = mesh_.vertex(f, 0);
    if (v == ghost) continue;
    const Point p = point(v);
    const double square = (p.x - target.x) * (p.x - target.x) + (p.y - target.y) * (p.y - target.y);
    nearest = square < least ? f : nearest;
    least = std::min(least, square);
  }
  const int corner = mesh_.ghost_corner(nearest);
  return corner < 0 ? nearest : mesh_.across(nearest, corner);
}

/// Walks to the face that contains a point, or to a ghost face from whose hull edge the point is
/// seen. -1 if it lies on a straight line with an edge on the way's end, or if there is no end.
int TriangulationRepair::face_around(Point target) const {
  int f = face_near(target);
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

/// Brings the corners of an edge up to date. Those that are the ghost's make it one that
/// certify_edges() leaves out. Written so that nothing branches.
void TriangulationRepair::refresh_edge(int edge) {
  const auto [a, b, c, d] = mesh_.around(mesh_.side_of(edge));
  const bool spoke = (a == ghost) | (b == ghost), hull = (c == ghost) | (d == ghost);
  const auto e = static_cast<std::size_t>(edge);
  corners_[0][e] = 2 * (spoke ? far_end_a : a);
  corners_[1][e] = 2 * (spoke ? far_end_b : b);
  corners_[2][e] = 2 * c;
  corners_[3][e] = 2 * ((spoke | hull) ? nowhere : d);
}

void TriangulationRepair::refresh_touched() {
  const std::size_t padded = static_cast<std::size_t>(mesh_.edge_count()) + 16;
  if (square_.size() < padded) {
    square_.resize(2 * padded);
    for (auto& corner : corners_) corner.resize(2 * padded);
  }
  for (; refreshed_ < mesh_.touched().size(); ++refreshed_) {
    const int edge = mesh_.touched()[refreshed_];
    if (edge < mesh_.edge_count()) refresh_edge(edge);
  }
}

void TriangulationRepair::refresh_all() {
  refresh_touched();
  for (int edge = 0; edge < mesh_.edge_count(); ++edge) refresh_edge(edge);
}

/// Finds the edges that, at the targets, may be illegal or beside a face that is folded.
void TriangulationRepair::find_suspects() {
  suspects_.resize(square_.size());
  // The last pack's idle lanes may still name points that are gone.
  constexpr auto width = static_cast<std::size_t>(kernels::Lanes<double>::width);
  for (auto e = static_cast<std::size_t>(mesh_.edge_count()); e % width != 0; ++e) {
    for (auto& corner : corners_) corner[e] = 2 * nowhere;
  }
  const kernels::QuadrilateralView view = {corners_[0].data(), corners_[1].data(),
                                           corners_[2].data(), corners_[3].data()};
  const int found = kernels::certify_edges(&target_[stand_ins].x, view, mesh_.edge_count(),
                                           suspects_.data(), square_.data());
  suspects_.resize(static_cast<std::size_t>(found));
  // Every face has an inner edge, unless it is the only one.
  constexpr int edges_of_one_face = 6;
  if (mesh_.edge_count() == edges_of_one_face) {
    for (int edge = 0; edge < edges_of_one_face; ++edge) suspects_.push_back(edge);
  }
}

/// Flips until no edge is illegal and the hull is convex. False if that takes suspiciously long or
/// if the hull does not wind once.
bool TriangulationRepair::settle() {
  doubtful_.clear();
  for (const std::int32_t edge : suspects_) {
    if (is_illegal(mesh_.side_of(edge))) doubtful_.push_back(mesh_.side_of(edge));
  }
  const bool winds_once = hull_winds_once();
  if (doubtful_.empty()) return winds_once;
  return settle_doubtful() && hull_winds_once();
}

/// Flips until no edge is illegal, where only those in doubtful_ can be. False if that takes
/// suspiciously long.
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
/// simple polygon with every inner point surrounded once. Adds its dents to doubtful_.
bool TriangulationRepair::hull_winds_once() {
  if (hull_face_ >= mesh_.face_count() || mesh_.ghost_corner(hull_face_) < 0) {
    hull_face_ = 0;
    while (mesh_.ghost_corner(hull_face_) < 0) ++hull_face_;
  }
  const int start = hull_face_;
  const auto upward = [](Point from, Point to) {
    return to.y > from.y || (to.y == from.y && to.x > from.x);
  };
  int windings = 0;
  bool turns_back = false;
  int f = start;
  do {
    const int corner = mesh_.ghost_corner(f);
    const Side spoke = {f, GhostMesh::before(corner)};
    const int after = mesh_.twin(spoke).face();
    const Point p = point(mesh_.vertex(f, GhostMesh::before(corner)));
    const Point q = point(mesh_.vertex(f, GhostMesh::next(corner)));
    const Point r = point(mesh_.vertex(after, GhostMesh::next(mesh_.ghost_corner(after))));
    const int turn = orientation(p, q, r);
    const bool in = upward(p, q), out = upward(q, r);
    if (turn < 0) doubtful_.push_back(spoke);
    turns_back = turns_back || turn < 0 || (turn == 0 && in != out);
    windings += !in && out;
    f = after;
  } while (f != start);
  return windings == 1 && !turns_back;
}

}  // namespace metamorph::core
