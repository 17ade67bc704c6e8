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

/// A circle, in one record as nodes have them.
template <class T>
struct alignas(4 * sizeof(T)) Circle {
  T x, y, radius2, unused;
};

/// Circles around outline edges outside which no point is within `reach` of the edge. first, second
/// [groups * width]: record offsets of the ends.
template <class T>
inline void circle_edges(const NodeRecord<T>* records, const std::uint32_t* first,
                         const std::uint32_t* second, int groups, T reach, Circle<T>* circles) {
  using Pack = Lanes<T>;
  const Pack half(T(0.5)), margin(T(1.001));  // room for rounding
  for (int base = 0; base < groups * Pack::width; base += Pack::width) {
    const NodePack<T> a = gather(records, first + base), b = gather(records, second + base);
    const Pack ex = b.x - a.x, ey = b.y - a.y;
    const Pack radius = fma(half, sqrt(fma(ex, ex, ey * ey)), Pack(reach)) * margin;
    const Pack x = half * (a.x + b.x), y = half * (a.y + b.y), radius2 = radius * radius;
    for (int l = 0; l < Pack::width; ++l) circles[base + l] = {x[l], y[l], radius2[l], T(0)};
  }
}

/// An outline edge and a lane group of outline nodes.
struct CollisionBlock {
  std::uint32_t edge;
  std::uint32_t place;  ///< of the group's first node
  std::uint32_t lanes;  ///< nodes of the group that matter, as bits
};

/// Copies the blocks whose lanes(block) are not empty, with these lanes, in order; returns their
/// end. `to` may be `from`, else it must have room for all. All are written, but few counted: a
/// branch would often be mispredicted.
template <class LanesOf>
inline CollisionBlock* copy_blocks_if(const CollisionBlock* from, const CollisionBlock* end,
                                      CollisionBlock* to, LanesOf&& lanes_of) {
  for (; from != end; ++from) {
    const std::uint32_t lanes = from->lanes & lanes_of(*from);
    *to = {from->edge, from->place, lanes};
    to += lanes != 0 ? 1 : 0;
  }
  return to;
}

/// Keeps the nodes within their edge's circle. x, y: coordinates of nodes by place.
template <class T>
inline CollisionBlock* copy_circled(const CollisionBlock* from, const CollisionBlock* end,
                                    const Circle<T>* circles, const T* x, const T* y,
                                    CollisionBlock* to) {
  using Pack = Lanes<T>;
  return copy_blocks_if(from, end, to, [=](const CollisionBlock& block) {
    const Circle<T>& circle = circles[block.edge];
    const Pack dx = Pack::load(x + block.place) - Pack(circle.x);
    const Pack dy = Pack::load(y + block.place) - Pack(circle.y);
    return bits_less(fma(dx, dx, dy * dy), Pack(circle.radius2));
  });
}

/// Keeps the nodes within `reach` of their edge.
template <class T>
inline CollisionBlock* copy_near(const CollisionBlock* from, const CollisionBlock* end,
                                 const NodeRecord<T>* records, const std::uint32_t* first,
                                 const std::uint32_t* second, const T* x, const T* y, T reach,
                                 CollisionBlock* to) {
  using Pack = Lanes<T>;
  return copy_blocks_if(from, end, to, [=](const CollisionBlock& block) {
    const T* const a = detail::record_at(records, first[block.edge]);
    const T* const b = detail::record_at(records, second[block.edge]);
    const auto nearest =
        nearest_on_segment<T>(Pack::load(x + block.place), Pack::load(y + block.place), Pack(a[0]),
                              Pack(a[1]), Pack(b[0]), Pack(b[1]));
    return bits_less(nearest.distance2, Pack(reach * reach));
  });
}

/// A pair so near that it may have to be stopped in this step.
template <class T>
struct Approach {
  std::uint32_t node, first, second;  ///< lanes
  T share;                            ///< of the edge, where it is nearest to the node
  T nx, ny;                           ///< unit vector from there to the node
  T room;                             ///< what the gap exceeds its least by, d; negative below that
};

/// How many pairs repel each other, and how many approaches were found.
struct PairCounts {
  int touching, near;
};

/// Adds the elastic penalty of every pair closer than its threshold (MODEL section 4):
/// k_s (threshold - gap) on the node along the gap, the opposite shared by the edge's ends
/// barycentrically. Computed in lanes, but added one after the other, in order, so that pairs that
/// do not touch change no bit. fx, fy: [lanes of the body].
///
/// Lists the pairs whose room, over a least gap of min(least_gap, threshold / 2), is below `reach`
/// in `approaches`, which has place for all, in order.
template <class T>
inline PairCounts meet_pairs(const CollisionPairs<T>& pairs, const NodeRecord<T>* records,
                             T stiffness, T least_gap, T reach, T* fx, T* fy,
                             Approach<T>* approaches) {
  using Pack = Lanes<T>;
  PairCounts counts{0, 0};
  const Pack zero(T(0)), half(T(0.5)), least_gap_everywhere(least_gap), reach_everywhere(reach);
  for (int base = 0; base < pairs.count; base += Pack::width) {
    const NodePack<T> p = gather(records, pairs.node + base);
    const NodePack<T> a = gather(records, pairs.first + base);
    const NodePack<T> b = gather(records, pairs.second + base);
    const Pack threshold = Pack::load(pairs.threshold + base);
    const Pack least = min(half * threshold, least_gap_everywhere);
    const Pack far = max(threshold, least + reach_everywhere);
    const auto nearest = nearest_on_segment(p.x, p.y, a.x, a.y, b.x, b.y);
    std::uint32_t concerned =
        bits((nearest.distance2 < far * far) & (nearest.distance2 > zero) & (threshold > zero));
    if (concerned == 0) continue;
    const Pack gap = sqrt(nearest.distance2);
    const Pack scale = Pack(stiffness) * (threshold - gap) / gap;
    const Pack nx = nearest.dx / gap, ny = nearest.dy / gap, room = gap - least;
    const Pack sx = scale * nearest.dx, sy = scale * nearest.dy;
    const Pack first = Pack(T(1)) - nearest.share;
    const Pack ax = first * sx, ay = first * sy, bx = nearest.share * sx, by = nearest.share * sy;
    for (; concerned != 0; concerned &= concerned - 1) {
      const int lane = std::countr_zero(concerned);
      const auto at = [&](const std::uint32_t* offset) {
        return offset[base + lane] / record_offset<T>(1);
      };
      const std::uint32_t node = at(pairs.node), one = at(pairs.first), other = at(pairs.second);
      if (gap[lane] < threshold[lane]) {
        fx[node] += sx[lane];
        fy[node] += sy[lane];
        fx[one] -= ax[lane];
        fy[one] -= ay[lane];
        fx[other] -= bx[lane];
        fy[other] -= by[lane];
        ++counts.touching;
      }
      if (room[lane] < reach) {
        approaches[counts.near++] = {node,     one,      other,     nearest.share[lane],
                                     nx[lane], ny[lane], room[lane]};
      }
    }
  }
  return counts;
}

}  // namespace metamorph::kernels
