#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/locomotion/body_batch.h"
#include "core/locomotion/motion_watch.h"
#include "kernels/self_collision.h"
#include "kernels/stop.h"

namespace metamorph::core {

/// Pairs of self-collision for one running animat: every pair of an outline node and an outline
/// edge of which it is no end that could come within reach before anything has moved by half a
/// skin; and, for ever, the corners of triangles without pressure against their opposite sides,
/// which nothing else keeps from turning over. Renewed only when something has moved so far, so
/// that it costs little while nothing is near, and never misses a pair.
///
/// Pairs closer than the gap at rest keep their rest distance as threshold.
template <class T>
class CollisionList {
 public:
  /// Prepares body `i` of a batch. Storage grows to the largest body met and is kept.
  void reset(const Body& body, const Scene& scene, const BodyBatch<T>& batch, std::size_t i);

  /// The pairs to test at the records' positions, by edge, then node of the body; renews the list
  /// if it is stale. No pair is missed that is nearer than its threshold, or than its least gap and
  /// `reach`; which others are listed depends on when the list was renewed. `weight`: 1, or 0 in
  /// idle lanes.
  kernels::CollisionPairs<T> pairs(const kernels::NodeRecord<T>* records, const T* weight, T reach);

  /// Says that every node has moved for a time h, at no more than the speed whose square is in its
  /// lane of `speed2`. Must be told of all motion.
  void advance(kernels::Lanes<T> speed2, T h) {
    const kernels::Lanes<T> way = kernels::Lanes<T>(h) * sqrt(speed2);
    block_watch_.advance(way);
    pair_watch_.advance(way);
  }

  /// Groups of nodes that are in a pair: those of the outline, or all.
  int groups() const { return groups_; }

  /// Place for as many as there can be pairs.
  kernels::Approach<T>* approaches() { return approaches_.data(); }

 private:
  using Edge = std::array<std::uint32_t, 2>;  ///< lanes of both ends
  static constexpr std::size_t width = static_cast<std::size_t>(kernels::Lanes<T>::width);

  struct CloseAtRest {
    std::size_t edge, place;
    T threshold;
  };
  struct LastingPair {
    std::uint32_t node, first, second;  ///< record offsets
    T threshold;
  };

  void line_up(std::span<const Edge> edges);
  void list_all_blocks(std::span<const Edge> edges);
  void find_close_at_rest(const Body& body, std::span<const Edge> edges);
  void find_lasting(const Body& body, const Scene& scene, std::span<const Index> node_of_lane);
  void measure(const kernels::NodeRecord<T>* records, T reach);
  void renew_blocks(const kernels::NodeRecord<T>* records, T limit);
  void renew_pairs(const kernels::NodeRecord<T>* records, T limit);
  kernels::CollisionBlock& block(std::size_t edge, std::size_t place) {
    return all_[(edge * node_.size() + place) / width];
  }
  static std::uint32_t lane(std::size_t place) { return 1u << (place % width); }
  T threshold(std::size_t edge, std::size_t place) const;
  void add(std::uint32_t node, std::uint32_t first, std::uint32_t second, T threshold);
  void append(std::uint32_t node, std::uint32_t first, std::uint32_t second, T threshold);

  T gap_ = 0;
  T spare_ = 0;  ///< half of what the gap exceeds the least by
  int groups_ = 0;
  std::span<const Index> nodes_;  ///< of the outline's lanes
  std::size_t edges_ = 0;
  // Outline nodes along the contour, so that those of a group are near each other.
  Aligned<std::uint32_t> node_;            ///< [places, whole groups] record offset
  std::vector<std::size_t> place_;         ///< [lanes] the inverse
  Aligned<T> x_, y_;                       ///< [places, whole groups] coordinates at renewal
  Aligned<std::uint32_t> first_, second_;  ///< [edges, whole groups] record offsets of the ends
  Aligned<kernels::Circle<T>> circles_;    ///< [edges, whole groups] around them, at renewal
  std::vector<CloseAtRest> close_at_rest_;
  std::vector<LastingPair> lasting_;
  std::vector<kernels::CollisionBlock> all_;            ///< by edge, then place
  std::vector<kernels::CollisionBlock> wide_, narrow_;  ///< those within reach, one more than all
  kernels::CollisionBlock* wide_end_ = nullptr;
  MotionWatch<T> block_watch_, pair_watch_;

  // The pairs; filled up to whole lane groups.
  std::size_t count_ = 0;
  Aligned<std::uint32_t> pair_node_, pair_first_, pair_second_;
  Aligned<T> pair_threshold_;
  std::vector<kernels::Approach<T>> approaches_;
};

extern template class CollisionList<float>;
extern template class CollisionList<double>;

}  // namespace metamorph::core
