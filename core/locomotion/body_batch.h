#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/body/aligned.h"
#include "core/locomotion/shape_columns.h"
#include "kernels/body_step.h"
#include "kernels/self_collision.h"
#include "metamorph/body.h"
#include "metamorph/motion.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// Storage for the state of one running animat. Each thread has its own: lines of the cache that
/// one writes in every step are nobody else's, nor next to another's.
template <class T>
struct StateBuffers {
  Aligned<kernels::NodeRecord<T>> now, next;
  Aligned<T> vx, vy, extra_fx, extra_fy;
};

/// The bodies of many tasks as structure-of-arrays, ready for the kernels: every array holds all
/// bodies one behind the other, each padded to whole lane groups. Constants of the bodies and where
/// they start; what changes in time is in its runner.
template <class T>
class BodyBatch {
 public:
  static constexpr int width = kernels::Lanes<T>::width;

  /// Packs the bodies of `tasks`; oscillators advance by the task's own step.
  /// `midpoint`: forces are taken half a step later than the step's start (drift-kick-drift).
  BodyBatch(std::span<const LocomotionTask> tasks, bool midpoint, int threads);

  /// What is constant of body `i`, as the kernels see it.
  kernels::BodyShape<T> shape(std::size_t i) const;

  /// Puts body `i` at rest in its starting position; the state is valid as long as `buffers`.
  kernels::BodyState<T> start(std::size_t i, StateBuffers<T>& buffers) const;

  /// What was taken from the positions of body `i`: it starts about x = 0, with its lowest node at
  /// y = 0 on the ground, else about y = 0, so that rounding does not depend on where it lies.
  std::array<double, 2> origin(std::size_t i) const { return origin_[i]; }

  /// lane -> node of the Body, for body `i`; -1 in idle lanes.
  std::span<const Index> node_of_lane(std::size_t i) const;

  /// Outline nodes (they fill the first lanes, in order) and outline edges (lanes of both ends) of
  /// body `i`.
  std::span<const Index> outline_nodes(std::size_t i) const;
  std::span<const std::array<std::uint32_t, 2>> outline_edges(std::size_t i) const;

 private:
  struct Extent {
    int nodes, groups, outline_groups, slots, edge_slots, outline_nodes, outline_edges;
  };
  struct Offset {
    std::size_t groups, slots, edge_groups, edge_slots, outline_edges;
  };
  struct Plan;
  struct Oscillators;

  void fill(std::size_t i, const LocomotionTask& task, const Plan& plan, bool midpoint);
  void fill_rings(std::size_t i, const LocomotionTask& task, const Plan& plan,
                  const Oscillators& oscillators);
  void fill_edges(std::size_t i, const Plan& plan);

  std::vector<Extent> extent_;
  std::vector<Offset> offset_;
  std::vector<std::uint64_t> advance_;  ///< of each body's main period in a step, see BodyShape
  std::vector<std::array<double, 2>> origin_;

  // Of all bodies one behind the other.
  Columns<ShapeGroup<T>> groups_;
  Columns<ShapeLane<T>> lanes_;
  Columns<ShapeSlot<T>> slots_;
  Columns<ShapeEdgeGroup<T>> edge_groups_;
  Columns<ShapeEdgeLane<T>> edge_lanes_;
  Columns<ShapeEdgeSlot<T>> edge_slots_;
  Aligned<kernels::NodeRecord<T>> start_;  ///< [lanes]
  std::vector<Index> node_of_lane_;
  std::vector<std::array<std::uint32_t, 2>> outline_edges_;
};

extern template class BodyBatch<float>;
extern template class BodyBatch<double>;

}  // namespace metamorph::core
