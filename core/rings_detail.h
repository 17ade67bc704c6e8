#pragma once

#include <cstdint>
#include <vector>

#include "core/body.h"

namespace metamorph::core {

/// One place in a node's ring (see kernels/body_view.h).
struct RingSlot {
  Index neighbour;
  Index spring;    ///< index into Body::springs; -1 if the slot holds none
  Index triangle;  ///< triangle between this slot and the one before; -1 if none
};

/// The rings of all nodes of a body, and its outline seen from each node.
struct Rings {
  std::vector<int> begin;  ///< [nodes + 1] first slot of a node
  std::vector<RingSlot> slots;
  std::vector<Index> before;  ///< [nodes] neighbour before the first slot of a closed ring; else -1
  std::vector<int> edge_begin;    ///< [nodes + 1] first outline edge of a node
  std::vector<Index> edge_other;  ///< the other end of an outline edge

  int size(Index node) const {
    return begin[static_cast<std::size_t>(node) + 1] - begin[static_cast<std::size_t>(node)];
  }
  int edges(Index node) const {
    return edge_begin[static_cast<std::size_t>(node) + 1] -
           edge_begin[static_cast<std::size_t>(node)];
  }
};

/// Rings of a sound body, counter-clockwise. A closed ring starts at its lowest neighbour, whose
/// slot holds the triangle to the last one (`before`). Otherwise there is one open fan after the
/// other (several at a pinch), by their first neighbour, each from its first edge. (A closed fan
/// beside others, which only a file can hold, repeats its first neighbour without spring.) Springs
/// on no triangle follow in slots of their own.
Rings make_rings(const Body& body);

}  // namespace metamorph::core
