#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>
#endif

namespace metamorph::kernels {

/// A lane pack: `width` numbers that go through the same arithmetic side by side. It fills one
/// vector register of the target (16 floats with AVX-512, 8 with AVX2, 4 otherwise).
///
/// Every operation is correctly rounded (+ - * / sqrt fma) or exact, and acts on each lane alone,
/// so a lane's result depends neither on the width nor on the instruction set. That is why there is
/// no approximate reciprocal here and why fma is always explicit: contraction by the compiler is
/// off.
///
/// The arithmetic is GCC's and clang's vector extension; only the operations that the extension
/// lacks (fma, sqrt) name instructions.
template <class T>
struct Lanes;

#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__) && defined(__FMA__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

template <class T>
using LaneInt = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

template <class T>
struct LaneTypes {
  static constexpr int width = register_bytes / static_cast<int>(sizeof(T));
  typedef T Vector __attribute__((vector_size(register_bytes)));
  typedef LaneInt<T> Mask __attribute__((vector_size(register_bytes)));
};

/// Truth per lane: all bits set or none.
template <class T>
struct LaneMask {
  typename LaneTypes<T>::Mask v;
  friend LaneMask operator&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
  friend LaneMask operator|(LaneMask a, LaneMask b) { return {a.v | b.v}; }
};

template <class T>
struct Lanes {
  static constexpr int width = LaneTypes<T>::width;
  using Vector = typename LaneTypes<T>::Vector;
  using Mask = LaneMask<T>;
  Vector v;

  Lanes() = default;
  Lanes(Vector vector) : v(vector) {}
  Lanes(T value) : v(value - Vector{}) {}

  static Lanes load(const T* p) { return *reinterpret_cast<const Vector*>(p); }  // aligned
  void store(T* p) const { *reinterpret_cast<Vector*>(p) = v; }                  // aligned
  T operator[](int lane) const { return v[lane]; }

  friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
  friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
  friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
  friend Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
  friend Lanes operator-(Lanes a) { return -a.v; }
  Lanes& operator+=(Lanes b) { return *this = *this + b; }
  Lanes& operator*=(Lanes b) { return *this = *this * b; }

  friend Mask operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
  friend Mask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
};

template <class T>
inline Lanes<T> select(LaneMask<T> mask, Lanes<T> yes, Lanes<T> no) {
  return mask.v ? yes.v : no.v;
}
/// The second argument where either is not a number, as the instruction has it.
template <class T>
inline Lanes<T> min(Lanes<T> a, Lanes<T> b) {
#if defined(__AVX512F__)
  if constexpr (sizeof(T) == 4) return Lanes<T>(_mm512_maskz_min_ps(__mmask16(-1), a.v, b.v));
  if constexpr (sizeof(T) == 8) return Lanes<T>(_mm512_maskz_min_pd(__mmask8(-1), a.v, b.v));
#else
  return a.v < b.v ? a.v : b.v;
#endif
}
template <class T>
inline Lanes<T> max(Lanes<T> a, Lanes<T> b) {
#if defined(__AVX512F__)
  if constexpr (sizeof(T) == 4) return Lanes<T>(_mm512_maskz_max_ps(__mmask16(-1), a.v, b.v));
  if constexpr (sizeof(T) == 8) return Lanes<T>(_mm512_maskz_max_pd(__mmask8(-1), a.v, b.v));
#else
  return a.v > b.v ? a.v : b.v;
#endif
}

/// The sign bit alone.
template <class T>
inline constexpr LaneInt<T> sign_bit =
    static_cast<LaneInt<T>>(LaneInt<T>{1} << (8 * sizeof(T) - 1));

template <class T>
inline Lanes<T> abs(Lanes<T> a) {
  using Bits = typename LaneTypes<T>::Mask;
  return Lanes<T>(
      reinterpret_cast<typename Lanes<T>::Vector>(reinterpret_cast<Bits>(a.v) & ~sign_bit<T>));
}
/// a, with its sign changed where b is negative.
template <class T>
inline Lanes<T> sign_flipped(Lanes<T> a, Lanes<T> b) {
  using Bits = typename LaneTypes<T>::Mask;
  return Lanes<T>(reinterpret_cast<typename Lanes<T>::Vector>(
      reinterpret_cast<Bits>(a.v) ^ (reinterpret_cast<Bits>(b.v) & sign_bit<T>)));
}

/// Bit l is lane l's truth.
template <class T>
inline std::uint32_t bits(LaneMask<T> mask) {
#if defined(__AVX512DQ__)
  if constexpr (sizeof(T) == 4) return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask.v));
  if constexpr (sizeof(T) == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask.v));
#elif defined(__AVX2__)
  if constexpr (sizeof(T) == 4) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask.v)));
  }
  if constexpr (sizeof(T) == 8) {
    return static_cast<std::uint32_t>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask.v)));
  }
#else
  std::uint32_t result = 0;
  for (int l = 0; l < Lanes<T>::width; ++l) result |= mask.v[l] ? 1u << l : 0u;
  return result;
#endif
}

/// True in every lane.
template <class T>
inline bool all(LaneMask<T> mask) {
  return bits(mask) == (1u << Lanes<T>::width) - 1;
}

/// bits(a < b), in one instruction where there is one.
template <class T>
inline std::uint32_t bits_less(Lanes<T> a, Lanes<T> b) {
#if defined(__AVX512F__)
  if constexpr (sizeof(T) == 4) return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OS);
  if constexpr (sizeof(T) == 8) return _mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OS);
#else
  return bits(a < b);
#endif
}

/// The largest lane.
template <class T>
inline T largest(Lanes<T> pack) {
  T value = pack[0];
  for (int l = 1; l < Lanes<T>::width; ++l) value = pack[l] > value ? pack[l] : value;
  return value;
}

/// The sum of the lanes, in order.
template <class T>
inline T sum(Lanes<T> pack) {
  T value = T(0);
  for (int l = 0; l < Lanes<T>::width; ++l) value += pack[l];
  return value;
}

/// a * b + c with one rounding.
template <class T>
inline Lanes<T> fma(Lanes<T> a, Lanes<T> b, Lanes<T> c) {
#if defined(__AVX512F__)
  if constexpr (sizeof(T) == 4) return Lanes<T>(_mm512_fmadd_ps(a.v, b.v, c.v));
  if constexpr (sizeof(T) == 8) return Lanes<T>(_mm512_fmadd_pd(a.v, b.v, c.v));
#elif defined(__AVX2__) && defined(__FMA__)
  if constexpr (sizeof(T) == 4) return Lanes<T>(_mm256_fmadd_ps(a.v, b.v, c.v));
  if constexpr (sizeof(T) == 8) return Lanes<T>(_mm256_fmadd_pd(a.v, b.v, c.v));
#else
  Lanes<T> r;
  for (int l = 0; l < Lanes<T>::width; ++l) r.v[l] = std::fma(a.v[l], b.v[l], c.v[l]);
  return r;
#endif
}

template <class T>
inline Lanes<T> sqrt(Lanes<T> a) {
#if defined(__AVX512F__)
  // The masked forms, all lanes on: GCC 12 warns of its own unmasked ones (an uninitialised
  // source).
  if constexpr (sizeof(T) == 4) return Lanes<T>(_mm512_maskz_sqrt_ps(__mmask16(-1), a.v));
  if constexpr (sizeof(T) == 8) return Lanes<T>(_mm512_maskz_sqrt_pd(__mmask8(-1), a.v));
#elif defined(__AVX2__) && defined(__FMA__)
  if constexpr (sizeof(T) == 4) return Lanes<T>(_mm256_sqrt_ps(a.v));
  if constexpr (sizeof(T) == 8) return Lanes<T>(_mm256_sqrt_pd(a.v));
#else
  Lanes<T> r;
  for (int l = 0; l < Lanes<T>::width; ++l) r.v[l] = std::sqrt(a.v[l]);
  return r;
#endif
}

}  // namespace metamorph::kernels
