#pragma once

#include <cstdint>

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// What a neighbour needs to know of a node, in one load: 16 bytes in float, 32 in double.
/// Gathering whole records and transposing them in registers takes a fraction of the time of four
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

/// Place of a node's record in bytes from the first: what a gather adds to the base as it is.
template <class T>
constexpr std::uint32_t record_offset(std::uint32_t node) {
  return node * static_cast<std::uint32_t>(sizeof(NodeRecord<T>));
}

namespace detail {

template <class T>
inline const T* record_at(const NodeRecord<T>* records, std::uint32_t offset) {
  return reinterpret_cast<const T*>(reinterpret_cast<const char*>(records) + offset);
}

// Rows to lanes. Float: row q holds the records of the lanes q, q + 4, q + 8, ... in its 128-bit
// parts. Double: the records of q, q + 4 in its 256-bit parts.
#if defined(__AVX512F__)

// Within each 128-bit part: the first (last) two numbers of a and b, interleaved; the first (last)
// pair of a, then of b. Written as shuffles because GCC 12 warns of its own intrinsics for them.
using Floats = Lanes<float>::Vector;
[[gnu::always_inline]] inline Floats interleave_low(Floats a, Floats b) {
  return __builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
}
[[gnu::always_inline]] inline Floats interleave_high(Floats a, Floats b) {
  return __builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
}
[[gnu::always_inline]] inline Floats low_pairs(Floats a, Floats b) {
  return __builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
}
[[gnu::always_inline]] inline Floats high_pairs(Floats a, Floats b) {
  return __builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
}

// Consecutive records, a few to a register: the first (last) two columns of the rows a and b, and
// back to the first (last) records of a row.
using Doubles = Lanes<double>::Vector;
[[gnu::always_inline]] inline Floats columns_01(Floats a, Floats b) {
  return __builtin_shufflevector(a, b, 0, 4, 8, 12, 16, 20, 24, 28, 1, 5, 9, 13, 17, 21, 25, 29);
}
[[gnu::always_inline]] inline Floats columns_23(Floats a, Floats b) {
  return __builtin_shufflevector(a, b, 2, 6, 10, 14, 18, 22, 26, 30, 3, 7, 11, 15, 19, 23, 27, 31);
}
[[gnu::always_inline]] inline Floats first_records(Floats xy, Floats uv) {
  return __builtin_shufflevector(xy, uv, 0, 8, 16, 24, 1, 9, 17, 25, 2, 10, 18, 26, 3, 11, 19, 27);
}
[[gnu::always_inline]] inline Floats last_records(Floats xy, Floats uv) {
  return __builtin_shufflevector(xy, uv, 4, 12, 20, 28, 5, 13, 21, 29, 6, 14, 22, 30, 7, 15, 23,
                                 31);
}
[[gnu::always_inline]] inline Floats first_halves(Floats a, Floats b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23);
}
[[gnu::always_inline]] inline Floats last_halves(Floats a, Floats b) {
  return __builtin_shufflevector(a, b, 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30,
                                 31);
}
[[gnu::always_inline]] inline Doubles columns_01(Doubles a, Doubles b) {
  return __builtin_shufflevector(a, b, 0, 4, 8, 12, 1, 5, 9, 13);
}
[[gnu::always_inline]] inline Doubles columns_23(Doubles a, Doubles b) {
  return __builtin_shufflevector(a, b, 2, 6, 10, 14, 3, 7, 11, 15);
}
[[gnu::always_inline]] inline Doubles first_records(Doubles xy, Doubles uv) {
  return __builtin_shufflevector(xy, uv, 0, 4, 8, 12, 1, 5, 9, 13);
}
[[gnu::always_inline]] inline Doubles last_records(Doubles xy, Doubles uv) {
  return __builtin_shufflevector(xy, uv, 2, 6, 10, 14, 3, 7, 11, 15);
}
[[gnu::always_inline]] inline Doubles first_halves(Doubles a, Doubles b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
}
[[gnu::always_inline]] inline Doubles last_halves(Doubles a, Doubles b) {
  return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
}

/// The numbers of `width` consecutive records in four registers.
template <class T>
[[gnu::always_inline]] inline Lanes<T> load_row(const NodeRecord<T>* records, int row) {
  typename Lanes<T>::Vector numbers;
  __builtin_memcpy(&numbers, records + row * Lanes<T>::width / 4, sizeof numbers);
  return numbers;
}
template <class T>
[[gnu::always_inline]] inline void store_row(typename Lanes<T>::Vector numbers,
                                             NodeRecord<T>* records, int row) {
  __builtin_memcpy(records + row * Lanes<T>::width / 4, &numbers, sizeof numbers);
}

[[gnu::always_inline]] inline NodePack<float> gather_floats(const NodeRecord<float>* records,
                                                            const std::uint32_t* offset) {
  Lanes<float>::Vector row[4];
  for (int q = 0; q < 4; ++q) {
    __m512 z = _mm512_castps128_ps512(_mm_load_ps(record_at(records, offset[q])));
    z = _mm512_insertf32x4(z, _mm_load_ps(record_at(records, offset[q + 4])), 1);
    z = _mm512_insertf32x4(z, _mm_load_ps(record_at(records, offset[q + 8])), 2);
    row[q] = _mm512_insertf32x4(z, _mm_load_ps(record_at(records, offset[q + 12])), 3);
  }
  const detail::Floats xy01 = detail::interleave_low(row[0], row[1]),
                       xy23 = detail::interleave_low(row[2], row[3]);
  const detail::Floats uv01 = detail::interleave_high(row[0], row[1]),
                       uv23 = detail::interleave_high(row[2], row[3]);
  return {Lanes<float>(detail::low_pairs(xy01, xy23)), Lanes<float>(detail::high_pairs(xy01, xy23)),
          Lanes<float>(detail::low_pairs(uv01, uv23)),
          Lanes<float>(detail::high_pairs(uv01, uv23))};
}

[[gnu::always_inline]] inline NodePack<double> gather_doubles(const NodeRecord<double>* records,
                                                              const std::uint32_t* offset) {
  Lanes<double>::Vector z[4];
  for (int q = 0; q < 4; ++q) {
    const __m256d a = _mm256_load_pd(record_at(records, offset[q]));
    const __m256d b = _mm256_load_pd(record_at(records, offset[q + 4]));
    z[q] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  const Lanes<double>::Vector xu01 = __builtin_shufflevector(z[0], z[1], 0, 8, 2, 10, 4, 12, 6, 14),
                              xu23 = __builtin_shufflevector(z[2], z[3], 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes<double>::Vector yv01 = __builtin_shufflevector(z[0], z[1], 1, 9, 3, 11, 5, 13, 7, 15),
                              yv23 = __builtin_shufflevector(z[2], z[3], 1, 9, 3, 11, 5, 13, 7, 15);
  const __m512i low = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
  const __m512i high = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
  return {Lanes<double>(_mm512_permutex2var_pd(xu01, low, xu23)),
          Lanes<double>(_mm512_permutex2var_pd(yv01, low, yv23)),
          Lanes<double>(_mm512_permutex2var_pd(xu01, high, xu23)),
          Lanes<double>(_mm512_permutex2var_pd(yv01, high, yv23))};
}

#elif defined(__AVX2__) && defined(__FMA__)

[[gnu::always_inline]] inline NodePack<float> gather_floats(const NodeRecord<float>* records,
                                                            const std::uint32_t* offset) {
  __m256 row[4];
  for (int q = 0; q < 4; ++q) {
    row[q] =
        _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(record_at(records, offset[q]))),
                             _mm_load_ps(record_at(records, offset[q + 4])), 1);
  }
  const __m256 xy01 = _mm256_unpacklo_ps(row[0], row[1]), xy23 = _mm256_unpacklo_ps(row[2], row[3]);
  const __m256 uv01 = _mm256_unpackhi_ps(row[0], row[1]), uv23 = _mm256_unpackhi_ps(row[2], row[3]);
  return {Lanes<float>(_mm256_shuffle_ps(xy01, xy23, 0x44)),
          Lanes<float>(_mm256_shuffle_ps(xy01, xy23, 0xee)),
          Lanes<float>(_mm256_shuffle_ps(uv01, uv23, 0x44)),
          Lanes<float>(_mm256_shuffle_ps(uv01, uv23, 0xee))};
}

[[gnu::always_inline]] inline NodePack<double> gather_doubles(const NodeRecord<double>* records,
                                                              const std::uint32_t* offset) {
  __m256d row[4];
  for (int q = 0; q < 4; ++q) row[q] = _mm256_load_pd(record_at(records, offset[q]));
  const __m256d xu01 = _mm256_unpacklo_pd(row[0], row[1]);
  const __m256d xu23 = _mm256_unpacklo_pd(row[2], row[3]);
  const __m256d yv01 = _mm256_unpackhi_pd(row[0], row[1]);
  const __m256d yv23 = _mm256_unpackhi_pd(row[2], row[3]);
  return {Lanes<double>(_mm256_permute2f128_pd(xu01, xu23, 0x20)),
          Lanes<double>(_mm256_permute2f128_pd(yv01, yv23, 0x20)),
          Lanes<double>(_mm256_permute2f128_pd(xu01, xu23, 0x31)),
          Lanes<double>(_mm256_permute2f128_pd(yv01, yv23, 0x31))};
}

#endif

}  // namespace detail

/// Gathers the records at `width` offsets into packs.
template <class T>
[[gnu::always_inline]] inline NodePack<T> gather(const NodeRecord<T>* records,
                                                 const std::uint32_t* offset) {
#if defined(__AVX2__) && defined(__FMA__)
  if constexpr (sizeof(T) == 4) return detail::gather_floats(records, offset);
  if constexpr (sizeof(T) == 8) return detail::gather_doubles(records, offset);
#else
  NodePack<T> pack;
  for (int l = 0; l < Lanes<T>::width; ++l) {
    const T* record = detail::record_at(records, offset[l]);
    pack.x.v[l] = record[0];
    pack.y.v[l] = record[1];
    pack.vx.v[l] = record[2];
    pack.vy.v[l] = record[3];
  }
  return pack;
#endif
}

/// The `width` consecutive records from `records` on.
template <class T>
[[gnu::always_inline]] inline NodePack<T> load(const NodeRecord<T>* records) {
#if defined(__AVX512F__)
  using Vector = typename Lanes<T>::Vector;
  const Vector row0 = detail::load_row(records, 0).v, row1 = detail::load_row(records, 1).v;
  const Vector row2 = detail::load_row(records, 2).v, row3 = detail::load_row(records, 3).v;
  const Vector xy_low = detail::columns_01(row0, row1), xy_high = detail::columns_01(row2, row3);
  const Vector uv_low = detail::columns_23(row0, row1), uv_high = detail::columns_23(row2, row3);
  return {Lanes<T>(detail::first_halves(xy_low, xy_high)),
          Lanes<T>(detail::last_halves(xy_low, xy_high)),
          Lanes<T>(detail::first_halves(uv_low, uv_high)),
          Lanes<T>(detail::last_halves(uv_low, uv_high))};
#else
  std::uint32_t offset[Lanes<T>::width];
  for (std::uint32_t l = 0; l < Lanes<T>::width; ++l) offset[l] = record_offset<T>(l);
  return gather(records, offset);
#endif
}

/// Writes packs as consecutive records.
template <class T>
[[gnu::always_inline]] inline void store(const NodePack<T>& pack, NodeRecord<T>* records) {
#if defined(__AVX512F__)
  using Vector = typename Lanes<T>::Vector;
  const Vector xy_low = detail::first_halves(pack.x.v, pack.y.v);
  const Vector xy_high = detail::last_halves(pack.x.v, pack.y.v);
  const Vector uv_low = detail::first_halves(pack.vx.v, pack.vy.v);
  const Vector uv_high = detail::last_halves(pack.vx.v, pack.vy.v);
  detail::store_row<T>(detail::first_records(xy_low, uv_low), records, 0);
  detail::store_row<T>(detail::last_records(xy_low, uv_low), records, 1);
  detail::store_row<T>(detail::first_records(xy_high, uv_high), records, 2);
  detail::store_row<T>(detail::last_records(xy_high, uv_high), records, 3);
#else
#if defined(__AVX2__) && defined(__FMA__)
  if constexpr (sizeof(T) == 4) {
    const __m256 xy_low = _mm256_unpacklo_ps(pack.x.v, pack.y.v);
    const __m256 xy_high = _mm256_unpackhi_ps(pack.x.v, pack.y.v);
    const __m256 uv_low = _mm256_unpacklo_ps(pack.vx.v, pack.vy.v);
    const __m256 uv_high = _mm256_unpackhi_ps(pack.vx.v, pack.vy.v);
    const __m256 row[4] = {
        _mm256_shuffle_ps(xy_low, uv_low, 0x44), _mm256_shuffle_ps(xy_low, uv_low, 0xee),
        _mm256_shuffle_ps(xy_high, uv_high, 0x44), _mm256_shuffle_ps(xy_high, uv_high, 0xee)};
    for (int q = 0; q < 4; ++q) {
      _mm_store_ps(&records[q].x, _mm256_castps256_ps128(row[q]));
      _mm_store_ps(&records[q + 4].x, _mm256_extractf128_ps(row[q], 1));
    }
    return;
  }
#endif
  for (int l = 0; l < Lanes<T>::width; ++l) {
    records[l] = {pack.x[l], pack.y[l], pack.vx[l], pack.vy[l]};
  }
#endif
}

}  // namespace metamorph::kernels
