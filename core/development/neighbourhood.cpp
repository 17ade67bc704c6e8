#include <algorithm>
#include <cstddef>

#include "core/development/neighbourhood.h"
#include "kernels/in_circle.h"

namespace metamorph::core {

void Neighbourhood::renew(std::span<const double> x, std::span<const double> y,
                          std::span<const Index> previous, double link_limit) {
  triangulation_.update(x, y, previous);
  if (patchable_ && triangulation_.patched()) {
    table_.grow(static_cast<Index>(x.size()));
    if (!patch(link_limit * link_limit) || table_.lowest_count() <= 1) return;
  }
  fill(x, y, link_limit);
}

/// Brings the table to the short edges of the mesh. True if anything changed.
bool Neighbourhood::patch(double square_limit) {
  const GhostMesh& mesh = triangulation_.mesh();
  // First all that has gone: a number may have passed from one edge to another.
  for (const int edge : mesh.replaced()) unlink(edge);
  make_room(mesh.edge_count());
  for (const int edge : mesh.replaced()) {
    if (edge < mesh.edge_count()) link_if_short(edge, square_limit);
  }
  // Where the square is that of an edge before, linking again changes nothing.
  const int crossed = kernels::crossed_limit(triangulation_.squares(), square_limit,
                                             unlinked_.data(), mesh.edge_count(), crossed_.data());
  for (int n = 0; n < crossed; ++n) {
    const int edge = crossed_[static_cast<std::size_t>(n)];
    unlink(edge);
    link_if_short(edge, square_limit);
  }
  return crossed > 0 || !mesh.replaced().empty();
}

void Neighbourhood::make_room(int edges) {
  const std::size_t padded = static_cast<std::size_t>(edges) + kernels::Lanes<double>::width;
  if (unlinked_.size() >= padded) return;
  ends_.resize(2 * padded);
  unlinked_.resize(2 * padded, 1);
  crossed_.resize(2 * padded);
}

void Neighbourhood::unlink(int edge) {
  const auto e = static_cast<std::size_t>(edge);
  if (e >= unlinked_.size() || unlinked_[e] != 0) return;
  table_.unlink(ends_[e][0], ends_[e][1]);
  unlinked_[e] = 1;
}

void Neighbourhood::link_if_short(int edge, double square_limit) {
  const auto e = static_cast<std::size_t>(edge);
  if (unlinked_[e] == 0) return;
  const auto ends = triangulation_.mesh().around(triangulation_.mesh().side_of(edge));
  if (ends.a == GhostMesh::ghost || ends.b == GhostMesh::ghost) return;
  if (triangulation_.squared_length(ends.a, ends.b) > square_limit) return;
  ends_[e] = {ends.a, ends.b};
  unlinked_[e] = 0;
  table_.link(ends.a, ends.b);
}

/// Chooses among all edges.
void Neighbourhood::fill(std::span<const double> x, std::span<const double> y, double link_limit) {
  const bool short_ones_suffice =
      selection_.select(x, y, link_limit, triangulation_.edges(), links_);
  table_.reset(static_cast<Index>(x.size()));
  const GhostMesh& mesh = triangulation_.mesh();
  patchable_ = short_ones_suffice && !mesh.empty();
  if (!patchable_) {
    for (const auto& [i, j] : links_) table_.link(i, j);
    return;
  }
  // The chosen ones are the short edges of the mesh.
  make_room(mesh.edge_count());
  std::fill(unlinked_.begin(), unlinked_.end(), 1.0);
  for (int edge = 0; edge < mesh.edge_count(); ++edge) {
    link_if_short(edge, link_limit * link_limit);
  }
}

}  // namespace metamorph::core
