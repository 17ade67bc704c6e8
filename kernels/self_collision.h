#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "kernels/lanes.h"
#include "kernels/node_record.h"

namespace metamorph::kernels {

/// Outline nodes and outline edges that may come close, one entry per pair; all arrays are filled
/// up to whole lane groups with entries of threshold 0.
template <class T>
struct CollisionPairs {
  int count;                   ///< entries, a multiple of the lane width
  const std::uint32_t* node;   ///< record offset of the node
  const std::uint32_t* first;  ///< and of the edge's ends
  const std::uint32_t* second;
  const T* threshold;  ///< gap below which they repel, d
};

/// The points of segments ab nearest to points p, as a share of ab in [0, 1], and p's offset from
/// them.
template <class T>
struct NearestOnSegment {
  Lanes<T> share, dx, dy, distance2;
};

template <class T>
inline NearestOnSegment<T> nearest_on_segment(Lanes<T> px, Lanes<T> py, Lanes<T> ax, Lanes<T> ay,
                                              Lanes<T> bx, Lanes<T> by) {
  const Lanes<T> zero(T(0)), one(T(1)), tiny(T(1e-12));
  const Lanes<T> ex = bx - ax, ey = by - ay, qx = px - ax, qy = py - ay;
  const Lanes<T> length2 = max(fma(ex, ex, ey * ey), tiny);
  const Lanes<T> share = min(max(fma(qx, ex, qy * ey) / length2, zero), one);
  const Lanes<T> dx = fma(-share, ex, qx), dy = fma(-share, ey, qy);
  return {share, dx, dy, fma(dx, dx, dy * dy)};
}

/// Largest squared distance that the nodes of `groups` lane groups have moved from (x, y), their
/// common motion (shift_x, shift_y) left out. Idle lanes must hold their own position in (x, y).
template <class T>
inline T farthest_move2(const NodeRecord<T>* records, const T* x, const T* y, int groups, T shift_x,
                        T shift_y) {
  Lanes<T> farthest(T(0));
  for (int g = 0; g < groups; ++g) {
    const int base = g * Lanes<T>::width;
    const NodePack<T> now = load(records + base);
    const Lanes<T> dx = now.x - Lanes<T>::load(x + base) - Lanes<T>(shift_x);
    const Lanes<T> dy = now.y - Lanes<T>::load(y + base) - Lanes<T>(shift_y);
    farthest = max(farthest, fma(dx, dx, dy * dy));
  }
  return largest(farthest);
}

/// The lanes of one group whose node lies within `reach` of segment ab, as bits.
template <class T>
inline std::uint32_t near_segment(const T* x, const T* y, T ax, T ay, T bx, T by, T reach) {
  const auto near = nearest_on_segment<T>(Lanes<T>::load(x), Lanes<T>::load(y), Lanes<T>(ax),
                                          Lanes<T>(ay), Lanes<T>(bx), Lanes<T>(by));
  return bits(near.distance2 < Lanes<T>(reach * reach));
}

/// Adds the elastic penalty of every pair closer than its threshold (MODEL section 4):
/// k_s (threshold - gap) on the node along the gap, the opposite shared by the edge's ends
/// barycentrically. Lanes find the pairs that touch; these push one after the other, in order, so
/// that pairs that do not touch change no bit. Returns how many touch. fx, fy: [lanes of the body].
template <class T>
inline int add_collision_forces(const CollisionPairs<T>& pairs, const NodeRecord<T>* records,
                                T stiffness, T* fx, T* fy) {
  using Pack = Lanes<T>;
  int touching = 0;
  for (int base = 0; base < pairs.count; base += Pack::width) {
    const NodePack<T> p = gather(records, pairs.node + base);
    const NodePack<T> a = gather(records, pairs.first + base);
    const NodePack<T> b = gather(records, pairs.second + base);
    const Pack threshold = Pack::load(pairs.threshold + base);
    const auto near = nearest_on_segment(p.x, p.y, a.x, a.y, b.x, b.y);
    std::uint32_t touch =
        bits((near.distance2 < threshold * threshold) & (near.distance2 > Pack(T(0))));
    for (; touch != 0; touch &= touch - 1) {
      const int lane = std::countr_zero(touch);
      const T gap = std::sqrt(near.distance2[lane]);
      const T scale = stiffness * (threshold[lane] - gap) / gap;
      const T sx = scale * near.dx[lane], sy = scale * near.dy[lane];
      const T second = near.share[lane], first = T(1) - second;
      const auto at = [&](const std::uint32_t* offset) {
        return offset[base + lane] / record_offset<T>(1);
      };
      fx[at(pairs.node)] += sx;
      fy[at(pairs.node)] += sy;
      fx[at(pairs.first)] -= first * sx;
      fy[at(pairs.first)] -= first * sy;
      fx[at(pairs.second)] -= second * sx;
      fy[at(pairs.second)] -= second * sy;
      ++touching;
    }
  }
  return touching;
}

}  // namespace metamorph::kernels
