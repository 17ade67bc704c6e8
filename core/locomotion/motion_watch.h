#pragma once

#include "core/locomotion/body_batch.h"
#include "kernels/rigid_motion.h"

namespace metamorph::core {

/// Tells cheaply whether nodes can have moved towards each other since a mark, by more than a limit
/// each.
///
/// A rigid motion brings no two points closer: only what is left of the motion without it counts,
/// so that a body may swim and roll as far as it likes. The nodes are looked at only when the
/// speeds since the last look allow that they have moved so far.
template <class T>
class MotionWatch {
 public:
  /// Watches the nodes of the first `groups` lane groups; forgets the mark.
  void reset(int groups);

  /// Remembers where the nodes are, and the limit from now on.
  void mark(const kernels::NodeRecord<T>* records, T limit);

  /// Says that every node has moved, by no more than what is in its lane of `way`.
  void advance(kernels::Lanes<T> way) { travelled_ += way + kernels::Lanes<T>(rounding_); }

  /// Whether every node is nearer than the limit, less `ahead`, to where some rigid motion since
  /// the mark carries it. `weight`: 1, or 0 in idle lanes. Never true without a mark.
  bool holds(const kernels::NodeRecord<T>* records, const T* weight, T ahead) {
    if (all(travelled_ < kernels::Lanes<T>(slack_ - ahead))) return true;
    return look(records, weight, ahead);
  }

 private:
  void start_anew(T slack);
  bool look(const kernels::NodeRecord<T>* records, const T* weight, T ahead);

  int groups_ = 0;
  T limit_ = 0;
  bool marked_ = false;
  Aligned<T> x_, y_;                   ///< [groups * width] coordinates at the mark
  T slack_ = 0;                        ///< what the nodes may travel before the next look
  kernels::Lanes<T> travelled_{T(0)};  ///< bound on what they have travelled since the last one
  T farthest_out_ = 0;                 ///< bound on their coordinates then
  T rounding_ = 0;                     ///< bound on what a step's rounding adds to its motion
};

extern template class MotionWatch<float>;
extern template class MotionWatch<double>;

}  // namespace metamorph::core
