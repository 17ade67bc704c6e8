#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/body_batch_detail.h"
#include "kernels/self_collision.h"

namespace metamorph::core {

/// Candidate pairs of self-collision for one running animat: every pair of an outline node and an
/// outline edge that could touch before anything has moved by half the skin. Renewed only then, so
/// that it costs next to nothing while nothing is near, and never misses a pair.
///
/// Excluded are edges that a walk along the outline traverses first or second from the node. Pairs
/// closer than the gap at rest keep their rest distance as threshold.
template <class T>
class CollisionList {
 public:
  /// Prepares for one body. Storage grows to the largest body met and is kept.
  void reset(const Body& body, const Scene& scene, std::span<const Index> nodes,
             std::span<const std::array<std::uint32_t, 2>> edges);

  /// The pairs to test at the records' positions; renews the list if it is stale. `weight`: 1, or 0
  /// in idle lanes.
  kernels::CollisionPairs<T> pairs(const kernels::NodeRecord<T>* records, const T* weight);

 private:
  struct Edge {
    std::uint32_t first, second;  ///< lanes
    Index a, b;                   ///< nodes of the body
  };

  bool stale(const kernels::NodeRecord<T>* records, const T* weight);
  void renew(const kernels::NodeRecord<T>* records);
  void find_close_at_rest();
  T distance_at_rest(std::size_t node, const Edge& edge) const;
  void add(std::uint32_t node, std::uint32_t first, std::uint32_t second, T threshold);

  const Body* body_ = nullptr;
  T gap_ = 0, skin_ = 0;
  bool valid_ = false;
  kernels::RigidMotion<T> motion_{};  ///< since renewal, as last fitted
  int groups_ = 0;                    ///< lane groups that hold outline nodes
  std::span<const Index> nodes_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> allowed_;  ///< [edges * groups] lanes that may collide with the edge
  std::vector<std::uint32_t>
      close_at_rest_;  ///< [edges * groups] lanes nearer than the gap at rest
  Aligned<T> x_, y_;   ///< [groups * width] positions at renewal

  // The pairs, by edge, then node; filled up to whole lane groups.
  std::size_t count_ = 0;
  Aligned<std::uint32_t> pair_node_, pair_first_, pair_second_;
  Aligned<T> pair_threshold_;
};

extern template class CollisionList<float>;
extern template class CollisionList<double>;

}  // namespace metamorph::core
