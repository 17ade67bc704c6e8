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

/// A rigid motion that carries points near to where they are now: turn about the first centre, then
/// move it to the second.
template <class T>
struct RigidMotion {
  T from_x, from_y, to_x, to_y, cosine, sine;
};

/// The rigid motion that fits best how the nodes of `groups` lane groups have moved from (x, y).
/// `weight` [groups * width] is 0 in idle lanes, else 1.
template <class T>
inline RigidMotion<T> fit_rigid_motion(const NodeRecord<T>* records, const T* x, const T* y,
                                       const T* weight, int groups) {
  using Pack = Lanes<T>;
  const Pack zero(T(0));
  Pack count = zero, sum_x = zero, sum_y = zero, sum_u = zero, sum_v = zero;
  Pack xu = zero, yv = zero, xv = zero, yu = zero;
  for (int g = 0; g < groups; ++g) {
    const int base = g * Pack::width;
    const NodePack<T> now = load(records + base);
    const Pack w = Pack::load(weight + base);
    const Pack px = w * Pack::load(x + base), py = w * Pack::load(y + base);
    const Pack u = w * now.x, v = w * now.y;
    count += w;
    sum_x += px;
    sum_y += py;
    sum_u += u;
    sum_v += v;
    xu = fma(px, u, xu);
    yv = fma(py, v, yv);
    xv = fma(px, v, xv);
    yu = fma(py, u, yu);
  }
  const T n = sum(count), from_x = sum(sum_x) / n, from_y = sum(sum_y) / n;
  const T to_x = sum(sum_u) / n, to_y = sum(sum_v) / n;
  // Sums of products about the centres: the dot and the cross product of before and now.
  const T dot = sum(xu) + sum(yv) - n * (from_x * to_x + from_y * to_y);
  const T cross = sum(xv) - sum(yu) - n * (from_x * to_y - from_y * to_x);
  const T size = std::sqrt(dot * dot + cross * cross);
  if (!(size > T(0))) return {from_x, from_y, to_x, to_y, T(1), T(0)};
  return {from_x, from_y, to_x, to_y, dot / size, cross / size};
}

/// Largest squared distance of the nodes from where the rigid motion carries (x, y).
template <class T>
inline T farthest_move2(const NodeRecord<T>* records, const T* x, const T* y, const T* weight,
                        int groups, const RigidMotion<T>& motion) {
  using Pack = Lanes<T>;
  const Pack cosine(motion.cosine), sine(motion.sine);
  Pack farthest(T(0));
  for (int g = 0; g < groups; ++g) {
    const int base = g * Pack::width;
    const NodePack<T> now = load(records + base);
    const Pack px = Pack::load(x + base) - Pack(motion.from_x);
    const Pack py = Pack::load(y + base) - Pack(motion.from_y);
    const Pack dx = now.x - Pack(motion.to_x) - fma(cosine, px, -(sine * py));
    const Pack dy = now.y - Pack(motion.to_y) - fma(sine, px, cosine * py);
    farthest = max(Pack::load(weight + base) * fma(dx, dx, dy * dy), farthest);
  }
  return largest(farthest);
}

/// The lanes of one group whose node lies within `reach` of segment ab, as bits.
template <class T>
inline std::uint32_t near_segment(const T* x, const T* y, T ax, T ay, T bx, T by, T reach) {
  using Pack = Lanes<T>;
  // Most groups are far away: no node can be near if none is in the circle around the segment.
  const Pack mx((ax + bx) / 2), my((ay + by) / 2), px = Pack::load(x), py = Pack::load(y);
  const T half = std::sqrt((bx - ax) * (bx - ax) + (by - ay) * (by - ay)) / 2;
  const T radius = (reach + half) * T(1.001);
  const Pack dx = px - mx, dy = py - my;
  if (bits(fma(dx, dx, dy * dy) < Pack(radius * radius)) == 0) return 0;
  const auto near = nearest_on_segment<T>(px, py, Pack(ax), Pack(ay), Pack(bx), Pack(by));
  return bits(near.distance2 < Pack(reach * reach));
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
