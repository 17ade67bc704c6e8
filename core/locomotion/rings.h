#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "metamorph/body.h"

namespace metamorph::core {

/// One place in a node's ring (see kernels/body_shape.h).
struct RingSlot {
  Index neighbour;
  Index spring;    ///< index into Body::springs
  Index triangle;  ///< triangle between this slot and the one before; -1 if none
};

/// The rings of all nodes of a body, and its outline seen from each node.
struct Rings {
  std::vector<int> begin;  ///< [nodes + 1] first slot of a node
  std::vector<RingSlot> slots;
  std::vector<Index> closing;  ///< [nodes] triangle of a closed ring's last and first slot; else -1
  std::vector<int> edge_begin;    ///< [nodes + 1] first outline edge of a node
  std::vector<Index> edge_other;  ///< other end of an outline edge; of a node's, the first leads to
                                  ///< its ring's first neighbour, the last to its last

  int size(Index node) const {
    return begin[static_cast<std::size_t>(node) + 1] - begin[static_cast<std::size_t>(node)];
  }
  int edges(Index node) const {
    return edge_begin[static_cast<std::size_t>(node) + 1] -
           edge_begin[static_cast<std::size_t>(node)];
  }
  /// Edges that are neither the first nor the last.
  int inner_edges(Index node) const { return std::max(0, edges(node) - 2); }
};

/// Rings of a sound body, counter-clockwise. A closed ring starts at its lowest neighbour; the
/// triangle between its last slot and the first is `closing`. Otherwise there is one open fan after
/// the other (several at a pinch), by their first neighbour, each from its first edge.
Rings make_rings(const Body& body);

}  // namespace metamorph::core
