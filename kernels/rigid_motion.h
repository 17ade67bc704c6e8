#pragma once

#include <cmath>

#include "kernels/lanes.h"
#include "kernels/node_record.h"

namespace metamorph::kernels {

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

/// The largest coordinate among the nodes, without its sign.
template <class T>
inline T farthest_out(const T* x, const T* y, int groups) {
  using Pack = Lanes<T>;
  Pack out(T(0));
  for (int base = 0; base < groups * Pack::width; base += Pack::width) {
    out = max(abs(Pack::load(x + base)), max(abs(Pack::load(y + base)), out));
  }
  return largest(out);
}

}  // namespace metamorph::kernels
