#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace metamorph::kernels {

/// Elementary functions from + - * / and std::fma alone, so that every machine and every lane width
/// gives the same bits; free of branches, so that they vectorise. The polynomials are the plain
/// Taylor series; the stated errors are tested.

/// c0 + x (c1 + x (c2 + ...)), innermost first. Written out at compile time: a loop here would keep
/// the loop around it from being vectorised.
template <class T>
constexpr T horner(T /*x*/, T last) {
  return last;
}
template <class T, class... Rest>
inline T horner(T x, T first, Rest... rest) {
  return std::fma(horner(x, rest...), x, first);
}

/// tanh(x/2) = (e^x - 1)/(e^x + 1), the signed sigmoid of the control networks. Exactly odd.
/// Relative error below 4e-7 (float: about 3 units in the last place) and 1e-15 (double).
/// Not a number in, not a number out.
template <class T>
inline T tanh_half(T x) {
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, double>);
  constexpr bool single = std::is_same_v<T, float>;
  using Bits = std::conditional_t<single, std::uint32_t, std::uint64_t>;
  constexpr int mantissa = single ? 23 : 52;
  constexpr Bits exponent_of_one = static_cast<Bits>(single ? 127 : 1023) << mantissa;
  // Adding 1.5 * 2^mantissa rounds to an integer, which then stands in the low bits.
  constexpr T shifter = static_cast<T>(single ? 12582912.0 : 6755399441055744.0);
  constexpr T log2_e = static_cast<T>(1.4426950408889634);
  // ln 2 in two parts; the high one is short enough that n * ln2_high is exact.
  constexpr T ln2_high = static_cast<T>(single ? 0x1.62e4p-1 : 0x1.62e42fee00000p-1);
  constexpr T ln2_low =
      static_cast<T>(0.69314718055994530942L - static_cast<long double>(ln2_high));
  const T magnitude = std::fabs(x);
  const T a = magnitude > T(64) ? T(64) : magnitude;  // there the result is 1 to the last bit
  const T shifted = std::fma(-a, log2_e, shifter);
  const T n = shifted - shifter;
  const T r = std::fma(-n, ln2_low, std::fma(-n, ln2_high, -a));
  // e^r - 1 without its factor r: terms up to r^7/7! (r^13/13!), |r| <= ln2/2.
  T p;
  if constexpr (single) {
    p = horner(r, T(1), T(1.0 / 2), T(1.0 / 6), T(1.0 / 24), T(1.0 / 120), T(1.0 / 720),
               T(1.0 / 5040));
  } else {
    p = horner(r, T(1), T(1.0 / 2), T(1.0 / 6), T(1.0 / 24), T(1.0 / 120), T(1.0 / 720),
               T(1.0 / 5040), T(1.0 / 40320), T(1.0 / 362880), T(1.0 / 3628800), T(1.0 / 39916800),
               T(1.0 / 479001600), T(1.0 / 6227020800.0));
  }
  p *= r;
  const T power = std::bit_cast<T>(
      static_cast<Bits>((std::bit_cast<Bits>(shifted) << mantissa) + exponent_of_one));  // 2^n
  const T exp_minus_one = std::fma(power, p, power - T(1));  // e^-a - 1, accurate near a = 0
  return std::copysign(-exp_minus_one / (T(2) + exp_minus_one), x);
}

/// sin(pi u) and cos(pi u) for |u| <= 1. Absolute error below 2e-7 (float) and 5e-16 (double);
/// exact at multiples of 1/2.
template <class T>
inline void sin_cos_pi(T u, T& sine, T& cosine) {
  // Quarter turns: q in -2..2, the rest |v| <= 1/4 is exact.
  const int q = (u >= T(0.25)) + (u >= T(0.75)) - (u <= T(-0.25)) - (u <= T(-0.75));
  const T v = u - T(0.5) * static_cast<T>(q);
  const T w = v * v;
  // pi^(2k+1)/(2k+1)! and pi^(2k)/(2k)! with alternating signs, |pi v| <= pi/4.
  T s, c;
  if constexpr (std::is_same_v<T, float>) {
    s = horner(w, 3.14159265f, -5.16771278f, 2.55016404f, -0.599264529f, 0.0821458866f);
    c = horner(w, 1.0f, -4.93480220f, 4.05871213f, -1.33526277f, 0.235330630f);
  } else {
    s = horner(w, 3.14159265358979324, -5.16771278004997003, 2.55016403987734544,
               -0.599264529320792077, 0.0821458866111282288, -0.00737043094571435078,
               4.66302805767612567e-4, -2.19153534478302173e-5, 7.95205400147551251e-7);
    c = horner(w, 1.0, -4.93480220054467931, 4.05871212641676822, -1.33526276885458950,
               0.235330630358893205, -0.0258068913900140601, 0.00192957430940392305,
               -1.04638104924845751e-4, 4.30306958703294716e-6);
  }
  s *= v;
  const bool odd = (q & 1) != 0;
  const T sine_part = odd ? c : s;
  const T cosine_part = odd ? s : c;
  sine = (q & 2) != 0 ? -sine_part : sine_part;
  cosine = ((q + 1) & 2) != 0 ? -cosine_part : cosine_part;
}

}  // namespace metamorph::kernels
