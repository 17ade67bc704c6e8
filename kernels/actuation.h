#pragma once

#include <cstdint>

#include "kernels/body_shape.h"

namespace metamorph::kernels {

/// sin of a phase given as a fraction of a turn in fixed point.
///
/// With u in [-1, 1) half turns: |sin(pi u)| = cos(pi (1/2 - |u|)), and cos(pi a) = 1 + z p(z),
/// z = a^2 in [0, 1/4], p interpolated at the Chebyshev points of that interval. Largest error of
/// the polynomial: 4.1e-8 with five coefficients (float), 5.7e-17 with eight (double); rounding
/// adds about one unit in the last place of 1.
template <class T>
inline Lanes<T> sine(typename LaneTypes<T>::Mask phase) {
  constexpr T scale = sizeof(T) == 4 ? T(0x1p-31) : T(0x1p-63);
  const Lanes<T> u =
      Lanes<T>(__builtin_convertvector(phase, typename LaneTypes<T>::Vector)) * Lanes<T>(scale);
  const Lanes<T> a = Lanes<T>(T(0.5)) - abs(u);
  const Lanes<T> z = a * a;
  Lanes<T> p;
  if constexpr (sizeof(T) == 4) {
    p = Lanes<T>(T(-0.024627111852169037));
    p = fma(z, p, Lanes<T>(T(0.23507437109947205)));
    p = fma(z, p, Lanes<T>(T(-1.3352400064468384)));
    p = fma(z, p, Lanes<T>(T(4.058711528778076)));
    p = fma(z, p, Lanes<T>(T(-4.934802055358887)));
  } else {
    p = Lanes<T>(T(4.166399462726949e-06));
    p = fma(z, p, Lanes<T>(T(-0.00010458286368326585)));
    p = fma(z, p, Lanes<T>(T(0.001929562652479866)));
    p = fma(z, p, Lanes<T>(T(-0.02580689002587539)));
    p = fma(z, p, Lanes<T>(T(0.2353306302721577)));
    p = fma(z, p, Lanes<T>(T(-1.3352627688518803)));
    p = fma(z, p, Lanes<T>(T(4.058712126416736)));
    p = fma(z, p, Lanes<T>(T(-4.934802200544679)));
  }
  return sign_flipped(fma(z, p, Lanes<T>(T(1))), u);
}

/// Sine and cosine of a phase, 2^64 being one turn.
struct Phasor {
  double sine, cosine;
};

inline Phasor phasor(std::uint64_t phase) {
  LaneTypes<double>::Mask phases{};
  phases[0] = static_cast<std::int64_t>(phase);
  phases[1] = static_cast<std::int64_t>(phase + (std::uint64_t{1} << 62));
  const Lanes<double> values = kernels::sine<double>(phases);
  return {values[0], values[1]};
}

/// The oscillation sin(2 pi t / T + phi) of eq 3 at step n for one register of phases: at step 0,
/// and the advance of one step.
template <class T>
inline Lanes<T> oscillation(const Turn<T>* start, const Turn<T>* per_step, Turn<T> n) {
  typedef Turn<T> Turns __attribute__((vector_size(register_bytes)));
  const auto from = *reinterpret_cast<const Turns*>(start);
  const auto advance = *reinterpret_cast<const Turns*>(per_step);
  return sine<T>(reinterpret_cast<typename LaneTypes<T>::Mask>(from + advance * n));
}

}  // namespace metamorph::kernels
