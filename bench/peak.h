#pragma once

#include "bench/measure.h"
#include "kernels/lanes.h"

namespace metamorph::bench {

/// The machine's peak on one thread: independent fused multiply-adds in registers, enough of them
/// to hide their latency. Returns a value that depends on all of them.
template <class T>
inline T multiply_add(int rounds, T seed) {
  using Pack = kernels::Lanes<T>;
  constexpr int chains = 12;
  Pack sum[chains];
  for (int i = 0; i < chains; ++i) sum[i] = Pack(seed);
  const Pack factor(T(0.999)), term(T(0.001));
  for (int r = 0; r < rounds; ++r) {
    for (int i = 0; i < chains; ++i) sum[i] = fma(sum[i], factor, term);
  }
  Pack all(T(0));
  for (int i = 0; i < chains; ++i) all += sum[i];
  return largest(all);
}

template <class T>
constexpr double multiply_add_flop(int rounds) {
  return 2.0 * 12 * kernels::Lanes<T>::width * rounds;
}

template <class T>
void peak(benchmark::State& state) {
  constexpr int rounds = 1 << 20;
  T seed(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(seed);
    benchmark::DoNotOptimize(multiply_add<T>(rounds, seed));
  }
  report(state, multiply_add_flop<T>(rounds), "flop");
  report_flop(state, multiply_add_flop<T>(rounds));
}

}  // namespace metamorph::bench
