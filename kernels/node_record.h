#pragma once

#include <cstdint>

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// What a neighbour needs to know of a node, in one load: 16 bytes in float, 32 in double.
/// Gathering whole records and transposing them in registers takes a quarter of the time of four
/// hardware gathers.
template <class T>
struct alignas(4 * sizeof(T)) NodeRecord {
  T x, y, vx, vy;
};

/// Records of `width` nodes, one quantity per pack.
template <class T>
struct NodePack {
  Lanes<T> x, y, vx, vy;
};

namespace detail {

template <class T>
struct Quad {
  typedef T Vector __attribute__((vector_size(4 * sizeof(T))));
};

template <class T>
inline typename Quad<T>::Vector load_record(const NodeRecord<T>* records, std::uint32_t i) {
  return *reinterpret_cast<const typename Quad<T>::Vector*>(records + i);
}

// Transposes of 4x4 blocks. Row q of the input holds the records of the lanes q, q + 4, ...
#if defined(__AVX512F__)
inline NodePack<float> transpose(const Lanes<float>::Vector (&z)[4]) {
  const auto xy01 =
      __builtin_shufflevector(z[0], z[1], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
  const auto xy23 =
      __builtin_shufflevector(z[2], z[3], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
  const auto uv01 = __builtin_shufflevector(z[0], z[1], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27,
                                            14, 30, 15, 31);
  const auto uv23 = __builtin_shufflevector(z[2], z[3], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27,
                                            14, 30, 15, 31);
  return {
      __builtin_shufflevector(xy01, xy23, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
      __builtin_shufflevector(xy01, xy23, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30,
                              31),
      __builtin_shufflevector(uv01, uv23, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
      __builtin_shufflevector(uv01, uv23, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30,
                              31)};
}
#elif defined(__AVX2__)
inline NodePack<float> transpose(const Lanes<float>::Vector (&z)[4]) {
  const auto xy01 = __builtin_shufflevector(z[0], z[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const auto xy23 = __builtin_shufflevector(z[2], z[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const auto uv01 = __builtin_shufflevector(z[0], z[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const auto uv23 = __builtin_shufflevector(z[2], z[3], 2, 10, 3, 11, 6, 14, 7, 15);
  return {__builtin_shufflevector(xy01, xy23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(xy01, xy23, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(uv01, uv23, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(uv01, uv23, 2, 3, 10, 11, 6, 7, 14, 15)};
}
#endif

}  // namespace detail

/// Gathers the records node[0 .. width) into packs.
template <class T>
inline NodePack<T> gather(const NodeRecord<T>* records, const std::uint32_t* node) {
#if defined(__AVX2__)
  if constexpr (sizeof(T) == 4) {
    typename Lanes<T>::Vector row[4];
    for (int q = 0; q < 4; ++q) {
      const auto a = detail::load_record(records, node[q]);
      const auto b = detail::load_record(records, node[q + 4]);
      const auto ab = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
#if defined(__AVX512F__)
      const auto c = detail::load_record(records, node[q + 8]);
      const auto d = detail::load_record(records, node[q + 12]);
      const auto cd = __builtin_shufflevector(c, d, 0, 1, 2, 3, 4, 5, 6, 7);
      row[q] =
          __builtin_shufflevector(ab, cd, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#else
      row[q] = ab;
#endif
    }
    return detail::transpose(row);
  }
#endif
  alignas(register_bytes) T x[Lanes<T>::width], y[Lanes<T>::width], vx[Lanes<T>::width],
      vy[Lanes<T>::width];
  for (int l = 0; l < Lanes<T>::width; ++l) {
    const NodeRecord<T>& record = records[node[l]];
    x[l] = record.x;
    y[l] = record.y;
    vx[l] = record.vx;
    vy[l] = record.vy;
  }
  return {Lanes<T>::load(x), Lanes<T>::load(y), Lanes<T>::load(vx), Lanes<T>::load(vy)};
}

/// The `width` consecutive records from `records` on.
template <class T>
inline NodePack<T> load(const NodeRecord<T>* records) {
  std::uint32_t node[Lanes<T>::width];
  for (int l = 0; l < Lanes<T>::width; ++l) node[l] = static_cast<std::uint32_t>(l);
  return gather(records, node);
}

/// Writes packs as consecutive records.
template <class T>
inline void scatter(const NodePack<T>& pack, NodeRecord<T>* records) {
  for (int l = 0; l < Lanes<T>::width; ++l) {
    records[l] = {pack.x[l], pack.y[l], pack.vx[l], pack.vy[l]};
  }
}

}  // namespace metamorph::kernels
