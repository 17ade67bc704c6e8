#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/lanes.h"
#include "kernels/node_record.h"

namespace metamorph::kernels {

/// An outline node and an outline edge that may come close.
template <class T>
struct CollisionPair {
  std::uint32_t node, first, second;  ///< lanes of the body: the node, the edge's ends
  T threshold;                        ///< gap below which they repel, d
};

/// The point of segment ab nearest to p, as a share of ab in [0, 1], and p's offset from it.
template <class T>
struct NearestOnSegment {
  T share, dx, dy, distance2;
};

template <class T>
inline NearestOnSegment<T> nearest_on_segment(T px, T py, T ax, T ay, T bx, T by) {
  const T ex = bx - ax, ey = by - ay, qx = px - ax, qy = py - ay;
  const T length2 = std::fma(ex, ex, ey * ey);
  T share = length2 > T(0) ? std::fma(qx, ex, qy * ey) / length2 : T(0);
  share = share < T(0) ? T(0) : (share > T(1) ? T(1) : share);
  const T dx = std::fma(-share, ex, qx), dy = std::fma(-share, ey, qy);
  return {share, dx, dy, std::fma(dx, dx, dy * dy)};
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

/// The lanes of one group whose node lies within `reach` of segment ab, as bits. No node within
/// reach is left out.
template <class T>
inline std::uint32_t near_segment(const T* x, const T* y, T ax, T ay, T bx, T by, T reach) {
  using Pack = Lanes<T>;
  const Pack ex(bx - ax), ey(by - ay);
  const Pack qx = Pack::load(x) - Pack(ax), qy = Pack::load(y) - Pack(ay);
  const Pack length2 = max(fma(ex, ex, ey * ey), Pack(T(1e-12)));
  const Pack share = min(max(fma(qx, ex, qy * ey) / length2, Pack(T(0))), Pack(T(1)));
  const Pack dx = fma(-share, ex, qx), dy = fma(-share, ey, qy);
  return bits(fma(dx, dx, dy * dy) < Pack(reach * reach));
}

/// Adds the elastic penalty of every pair closer than its threshold (MODEL section 4):
/// k_s (threshold - gap) on the node along the gap, the opposite shared by the edge's ends
/// barycentrically. Pairs are taken in order, so that pairs that do not touch change no bit.
/// Returns how many touch.
template <class T>
inline int add_collision_forces(const CollisionPair<T>* pairs, int count,
                                const NodeRecord<T>* records, T stiffness, T* fx, T* fy) {
  int touching = 0;
  for (int i = 0; i < count; ++i) {
    const CollisionPair<T>& pair = pairs[i];
    const NodeRecord<T>&p = records[pair.node], &a = records[pair.first], &b = records[pair.second];
    const NearestOnSegment<T> near = nearest_on_segment(p.x, p.y, a.x, a.y, b.x, b.y);
    if (!(near.distance2 < pair.threshold * pair.threshold) || !(near.distance2 > T(0))) continue;
    const T gap = std::sqrt(near.distance2);
    const T scale = stiffness * (pair.threshold - gap) / gap;
    const T sx = scale * near.dx, sy = scale * near.dy;
    const T second = near.share, first = T(1) - near.share;
    fx[pair.node] += sx;
    fy[pair.node] += sy;
    fx[pair.first] -= first * sx;
    fy[pair.first] -= first * sy;
    fx[pair.second] -= second * sx;
    fy[pair.second] -= second * sy;
    ++touching;
  }
  return touching;
}

}  // namespace metamorph::kernels
