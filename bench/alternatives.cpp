// The step against its opponents, all in one run: the tidy scalar loop, the arrangements that lost,
// and the floor. Every one simulates the same bodies for the model's 3000 steps.

#include <cmath>
#include <string>

#include "bench/bodies.h"
#include "bench/measure.h"
#include "bench/peak.h"
#include "bench/ring_opponents.h"
#include "bench/scalar_opponents.h"
#include "metamorph/locomotion.h"
#include "metamorph/reference.h"

namespace metamorph::bench {
namespace {

using core::Body;
using core::Scene;

void report_steps(benchmark::State& state, const HardwareCounters& counters, const Body& body,
                  const Scene& scene, double animats) {
  const double steps = scene.run_steps * animats;
  report(state, counters, steps * static_cast<double>(body.springs.size()), "spring-step");
  report_flop(state, steps * water_step_flop(body));
}

/// Runs an opponent and compares where it got to with the reference simulator.
template <class Opponent>
void opponent(benchmark::State& state, const Body& body, bool same_physics) {
  const Scene scene = plain(core::water_scene());
  const double ramp = scene.ramp_steps * core::paper_step;
  double travel = 0, animats = 0;
  const HardwareCounters counters;
  for (auto _ : state) {
    Opponent simulation(body, scene);
    const double start = simulation.mean_x();
    for (int n = 0; n < scene.run_steps; ++n) {
      const double time = (n + 0.5) * scene.step;
      simulation.step(time, scene.amplitude * (time < ramp ? time / ramp : 1.0));
    }
    travel = simulation.mean_x() - start;
    animats = simulation.animats();
  }
  report_steps(state, counters, body, scene, animats);
  if (!same_physics) return;
  const double expected = core::simulate_reference(body, scene).mean_position[0];
  if (!(std::fabs(travel - expected) < 0.01)) {
    state.SkipWithError(("travelled " + std::to_string(travel) + " d, the reference " +
                         std::to_string(expected) + " d")
                            .c_str());
  }
}

void library(benchmark::State& state, const Body& body, core::Precision precision) {
  const Scene scene = plain(core::water_scene());
  const core::LocomotionTask task{&body, &scene};
  core::LocomotionOptions options;
  options.precision = precision;
  options.threads = 1;
  const HardwareCounters counters;
  for (auto _ : state) benchmark::DoNotOptimize(core::simulate({&task, 1}, options));
  report_steps(state, counters, body, scene, 1);
}

void reference(benchmark::State& state, const Body& body) {
  const Scene scene = plain(core::water_scene());
  const HardwareCounters counters;
  for (auto _ : state) benchmark::DoNotOptimize(core::simulate_reference(body, scene));
  report_steps(state, counters, body, scene, 1);
}

template <class F>
void add(const std::string& name, F f) {
  benchmark::RegisterBenchmark(name.c_str(), f)->Unit(benchmark::kMillisecond);
}

template <class T>
void add_opponents(const Body& body, const std::string& suffix, core::Precision precision) {
  add("library/" + suffix,
      [body, precision](benchmark::State& state) { library(state, body, precision); });
  add("records/" + suffix, [body](benchmark::State& state) {
    opponent<RingOpponent<T, TransposedRecords>>(state, body, true);
  });
  add("floor/" + suffix, [body](benchmark::State& state) {
    opponent<RingOpponent<T, Contiguous>>(state, body, false);
  });
  add("lane-is-node-hardware-gathers/" + suffix, [body](benchmark::State& state) {
    opponent<RingOpponent<T, HardwareGather>>(state, body, true);
  });
  add("lane-is-animat/" + suffix, [body](benchmark::State& state) {
    opponent<Interleaved<T, animat_lanes<T>>>(state, body, true);
  });
  add("scalar-plain-arrays/" + suffix,
      [body](benchmark::State& state) { opponent<Interleaved<T, 1>>(state, body, true); });
  add("scalar-tidy/" + suffix,
      [body](benchmark::State& state) { opponent<TidyLoop<T>>(state, body, true); });
}

void add_all() {
  add("peak/float", peak<float>);
  add("peak/double", peak<double>);
  for (const int cells : {64, 128, 256}) {
    const Body body = lattice_disc(cells);
    const std::string size = std::to_string(cells);
    add_opponents<float>(body, "float/" + size, core::Precision::float32);
    add_opponents<double>(body, "double/" + size, core::Precision::float64);
    add("reference/double/" + size, [body](benchmark::State& state) { reference(state, body); });
  }
}

}  // namespace
}  // namespace metamorph::bench

int main(int argc, char** argv) {
  return metamorph::bench::run(argc, argv, metamorph::bench::add_all);
}
