#pragma once

#include <benchmark/benchmark.h>

#include <string>

#include "bench/hardware_counters.h"

namespace metamorph::bench {

/// Says what one iteration of a benchmark did: `units` of `unit` (spring-step, network-cell, ...).
/// bench/report.py divides each repetition's time by it; the console shows the same as per_unit.
inline void report(benchmark::State& state, double units, const std::string& unit) {
  using benchmark::Counter;
  state.SetLabel(unit);
  state.counters["units"] = units;
  state.counters["per_unit"] =
      Counter(units, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

/// The same, with the instructions and cycles of one unit.
inline void report(benchmark::State& state, const HardwareCounters& counters, double units,
                   const std::string& unit) {
  counters.report(state, units);  // first: the reporting itself is not to be counted
  report(state, units, unit);
}

/// Arithmetic of one iteration, for GFLOP/s.
inline void report_flop(benchmark::State& state, double flop) {
  using benchmark::Counter;
  state.counters["flop"] = flop;
  state.counters["flop_per_s"] = Counter(flop, Counter::kIsIterationInvariantRate);
}

/// What main() of a program does that adds its benchmarks by `add`.
inline int run(int argc, char** argv, void (*add)()) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace metamorph::bench
