#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// Edges a-b of a triangulation with the third corners c and d of their faces (a, b, c) and
/// (b, a, d). Corners are places in the array of coordinates, in doubles, perhaps negative; one
/// array each, with room for a multiple of Lanes<double>::width.
struct QuadrilateralView {
  const std::int32_t* a;
  const std::int32_t* b;
  const std::int32_t* c;
  const std::int32_t* d;
};

namespace detail {

/// The coordinates of `width` points, each 16 aligned bytes.
[[gnu::always_inline]] inline void load_points(const double* coordinates, const std::int32_t* place,
                                               Lanes<double>& x, Lanes<double>& y) {
#if defined(__AVX512F__)
  const auto row = [&](int first) __attribute__((always_inline)) {
    const auto at = [&](int l) {
      return _mm_castpd_ps(_mm_load_pd(coordinates + place[first + l]));
    };
    __m512 z = _mm512_castps128_ps512(at(0));
    z = _mm512_insertf32x4(z, at(2), 1);
    z = _mm512_insertf32x4(z, at(4), 2);
    return Lanes<double>(_mm512_castps_pd(_mm512_insertf32x4(z, at(6), 3))).v;
  };
  const Lanes<double>::Vector even = row(0), odd = row(1);
  x.v = __builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14);
  y.v = __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15);
#elif defined(__AVX2__) && defined(__FMA__)
  const auto row = [&](int first) __attribute__((always_inline)) {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(coordinates + place[first])),
                                _mm_load_pd(coordinates + place[first + 2]), 1);
  };
  const __m256d even = row(0), odd = row(1);
  x = Lanes<double>(_mm256_unpacklo_pd(even, odd));
  y = Lanes<double>(_mm256_unpackhi_pd(even, odd));
#else
  for (int l = 0; l < Lanes<double>::width; ++l) {
    x.v[l] = coordinates[place[l]];
    y.v[l] = coordinates[place[l] + 1];
  }
#endif
}

}  // namespace detail

/// Writes to `doubtful` the numbers of those edges of which it is not certain that both faces are
/// counter-clockwise and that d is outside the circle through a, b, c, ascending, and returns how
/// many they are; edges whose d is not a number are left out. Certain means beyond the error bounds
/// of the determinants in double (Shewchuk 1997). square: the squared length of each edge, rounded
/// as (ax - bx)^2 + (ay - by)^2 is. coordinates: x, y of each point, 16-byte aligned; doubtful,
/// square: room as the corners have.
inline int certify_edges(const double* coordinates, const QuadrilateralView& view, int count,
                         std::int32_t* doubtful, double* square) {
  using Pack = Lanes<double>;
  constexpr double unit = 0x1p-53;
  const Pack circle_factor((10 + 96 * unit) * unit);
  // The orientation of (a, b, c) is summed from three differences of two products, each product
  // with three roundings: (3 + 1 + 2) units of the sum of all six, and a bit.
  const Pack face_factor(8 * unit);
  int found = 0;
  for (int first = 0; first < count; first += Pack::width) {
    Pack ax, ay, bx, by, cx, cy, dx, dy;
    detail::load_points(coordinates, view.a + first, ax, ay);
    detail::load_points(coordinates, view.b + first, bx, by);
    detail::load_points(coordinates, view.c + first, cx, cy);
    detail::load_points(coordinates, view.d + first, dx, dy);
    const Pack abx = ax - bx, aby = ay - by;
    const Pack length = abx * abx + aby * aby;
    std::memcpy(square + first, &length.v, sizeof length.v);
    ax = ax - dx, ay = ay - dy, bx = bx - dx, by = by - dy, cx = cx - dx, cy = cy - dy;
    const Pack bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy;
    const Pack axby = ax * by, bxay = bx * ay;
    const Pack bc = bxcy - cxby, ca = cxay - axcy, ab = axby - bxay;
    const Pack bc_size = abs(bxcy) + abs(cxby), ca_size = abs(cxay) + abs(axcy),
               ab_size = abs(axby) + abs(bxay);
    const Pack aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    const Pack determinant = aa * bc + bb * ca + cc * ab;
    const Pack permanent = bc_size * aa + ca_size * bb + ab_size * cc;
    const Pack face_bound = face_factor * (bc_size + ca_size + ab_size);
    const std::uint32_t certain = bits(-determinant > circle_factor * permanent) &
                                  bits(bc + ca + ab > face_bound) & bits(-ab > face_bound);
    std::uint32_t rest = ~certain & bits(LaneMask<double>{dx.v == dx.v});
    if (count - first < Pack::width) rest &= (1u << (count - first)) - 1;
    for (; rest != 0; rest &= rest - 1) doubtful[found++] = first + std::countr_zero(rest);
  }
  return found;
}

/// Writes to `changed` the numbers of those edges that are on the other side of a limit than they
/// were: square > limit where was_beyond is 0, or not where it is 1. Returns how many they are.
/// All arrays have room for a multiple of Lanes<double>::width, aligned to nothing.
inline int crossed_limit(const double* square, double limit, const double* was_beyond, int count,
                         std::int32_t* changed) {
  using Pack = Lanes<double>;
  int found = 0;
  for (int first = 0; first < count; first += Pack::width) {
    const auto load = [first](const double* values) {
      Pack pack;
      std::memcpy(&pack.v, values + first, sizeof pack.v);
      return pack;
    };
    std::uint32_t rest = bits(load(square) > Pack(limit)) ^ bits(load(was_beyond) > Pack(0.5));
    if (count - first < Pack::width) rest &= (1u << (count - first)) - 1;
    for (; rest != 0; rest &= rest - 1) changed[found++] = first + std::countr_zero(rest);
  }
  return found;
}

}  // namespace metamorph::kernels
