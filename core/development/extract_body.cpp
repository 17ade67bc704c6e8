#include "metamorph/extraction.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include "core/body/edge_uses.h"

namespace metamorph::core {
namespace {

constexpr Index none = -1;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// A side of a Delaunay face: what lies beyond it, and whether a link runs along it.
struct Side {
  Index beyond = none;  ///< face, or none: the outside
  bool linked = false;
};
using Sides = std::array<Side, 3>;

/// The sides of every face. Links ascend like the sorted edges, so one merge marks them.
std::vector<Sides> sides_of(const Embryo& embryo) {
  assert(std::is_sorted(embryo.links.begin(), embryo.links.end()));
  std::vector<Sides> sides(embryo.faces.size());
  const std::vector<EdgeUse> uses = sorted_edge_uses(embryo.faces);
  auto link = embryo.links.begin();
  for (std::size_t u = 0, next = 0; u < uses.size(); u = next) {
    next = end_of_edge(uses, u);
    assert(next - u <= 2);
    const std::array<Index, 2> edge = {uses[u].low, uses[u].high};
    while (link != embryo.links.end() && *link < edge) ++link;
    const bool linked = link != embryo.links.end() && *link == edge;
    const bool hull = next - u == 1;
    for (std::size_t v = u; v < next; ++v) {
      const Index beyond = hull ? none : uses[v == u ? u + 1 : u].triangle;
      sides[at(uses[v].triangle)][at(uses[v].side)] = {beyond, linked};
    }
  }
  return sides;
}

/// For every face whether it can be reached from outside without crossing a link.
std::vector<std::uint8_t> reached_from_outside(const std::vector<Sides>& sides) {
  std::vector<std::uint8_t> reached(sides.size(), 0);
  std::vector<std::size_t> open;
  const auto reach = [&](std::size_t face) {
    if (reached[face]) return;
    reached[face] = 1;
    open.push_back(face);
  };
  for (std::size_t face = 0; face < sides.size(); ++face) {
    for (const Side& side : sides[face]) {
      if (side.beyond == none && !side.linked) reach(face);
    }
  }
  while (!open.empty()) {
    const std::size_t face = open.back();
    open.pop_back();
    for (const Side& side : sides[face]) {
      if (side.beyond != none && !side.linked) reach(at(side.beyond));
    }
  }
  return reached;
}

/// An edge-connected set of faces and its cells.
struct Part {
  std::vector<Index> faces;
  std::vector<Index> cells;  ///< ascending
};

/// True if `a` is kept rather than `b`: more cells, or as many and the lower ones. Two parts share
/// at most one cell (what two shared cells enclose is filled), so their lists differ.
bool better(const Part& a, const Part& b) {
  if (a.cells.size() != b.cells.size()) return a.cells.size() > b.cells.size();
  return a.cells < b.cells;
}

/// The edge-connected set of unreached faces around `seed`; marks them as taken.
Part part_around(std::size_t seed, const Embryo& embryo, const std::vector<Sides>& sides,
                 std::vector<std::uint8_t>& taken) {
  Part part;
  part.faces = {static_cast<Index>(seed)};
  taken[seed] = 1;
  std::vector<std::uint8_t> has_cell(embryo.x.size(), 0);
  for (std::size_t next = 0; next < part.faces.size(); ++next) {
    const std::size_t face = at(part.faces[next]);
    for (const Index cell : embryo.faces[face]) has_cell[at(cell)] = 1;
    for (const Side& side : sides[face]) {
      if (side.beyond == none || taken[at(side.beyond)]) continue;
      taken[at(side.beyond)] = 1;
      part.faces.push_back(side.beyond);
    }
  }
  for (std::size_t cell = 0; cell < has_cell.size(); ++cell) {
    if (has_cell[cell]) part.cells.push_back(static_cast<Index>(cell));
  }
  return part;
}

Part largest_part(const Embryo& embryo) {
  const std::vector<Sides> sides = sides_of(embryo);
  std::vector<std::uint8_t> taken = reached_from_outside(sides);
  Part best;
  for (std::size_t face = 0; face < sides.size(); ++face) {
    if (taken[face]) continue;
    Part part = part_around(face, embryo, sides, taken);
    if (better(part, best)) best = std::move(part);
  }
  return best;
}

/// Starts a triangle at its lowest node, orientation kept.
std::array<Index, 3> from_lowest(const std::array<Index, 3>& t) {
  if (t[0] < t[1] && t[0] < t[2]) return t;
  if (t[1] < t[2]) return {t[1], t[2], t[0]};
  return {t[2], t[0], t[1]};
}

/// Triangles ascending, each started at its lowest node: no trace of the order of the faces.
/// Buckets by first node hold three or so, where insertion is the fastest sort.
std::vector<std::array<Index, 3>> ordered(const std::vector<std::array<Index, 3>>& triangles,
                                          std::size_t nodes) {
  std::vector<std::size_t> next(nodes + 1, 0);
  for (const auto& triangle : triangles) ++next[at(triangle[0]) + 1];
  for (std::size_t n = 1; n < next.size(); ++n) next[n] += next[n - 1];
  std::vector<std::size_t> first = next;
  std::vector<std::array<Index, 3>> result(triangles.size());
  for (const auto& triangle : triangles) {
    std::size_t place = next[at(triangle[0])]++;
    for (; place > first[at(triangle[0])] && triangle < result[place - 1]; --place) {
      result[place] = result[place - 1];
    }
    result[place] = triangle;
  }
  return result;
}

}  // namespace

Extraction extract_body(const Embryo& embryo, int min_cells) {
  if (embryo.status == Status::bad_development) return {embryo.status, {}};
  if (embryo.cell_count() == 0) return {Status::empty, {}};
  const Part part = largest_part(embryo);
  if (part.cells.empty() || static_cast<Index>(part.cells.size()) < min_cells) {
    return {Status::no_body, {}};
  }

  Extraction result;
  Body& body = result.body;
  std::vector<Index> node_of(embryo.x.size(), none);
  for (const Index cell : part.cells) {
    node_of[at(cell)] = body.node_count();
    body.x.push_back(embryo.x[at(cell)]);
    body.y.push_back(embryo.y[at(cell)]);
    body.period.push_back(embryo.period[at(cell)]);
    body.phase.push_back(embryo.phase[at(cell)]);
  }
  body.cell = part.cells;
  std::vector<std::array<Index, 3>> triangles;
  triangles.reserve(part.faces.size());
  for (const Index face : part.faces) {
    const auto& t = embryo.faces[at(face)];
    triangles.push_back(from_lowest({node_of[at(t[0])], node_of[at(t[1])], node_of[at(t[2])]}));
  }
  body.triangles = ordered(triangles, part.cells.size());
  set_rest_from_nodes(body);
  return result;
}

}  // namespace metamorph::core
