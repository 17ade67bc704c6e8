// Threads: the same work on more of them (strong), and as much work for each (weak); with the
// machine's peak on the same threads.

#include <omp.h>

#include <set>
#include <string>
#include <vector>

#include "bench/bodies.h"
#include "bench/measure.h"
#include "bench/peak.h"
#include "metamorph/development.h"
#include "metamorph/locomotion.h"

namespace metamorph::bench {
namespace {

using benchmark::Counter;

constexpr int strong_animats = 288;  ///< a generation's worth, the same number of each body
constexpr int weak_animats = 18;     ///< for each thread

void locomotion(benchmark::State& state, int animats, int threads) {
  const core::Scene scene = core::water_scene();
  const std::vector<core::Body> bodies = grown_bodies(1200);
  std::vector<core::LocomotionTask> tasks;
  for (int i = 0; i < animats; ++i) {
    tasks.push_back({&bodies[static_cast<std::size_t>(i) % bodies.size()], &scene});
  }
  core::LocomotionOptions options;
  options.threads = threads;
  std::vector<core::Outcome> outcomes;
  for (auto _ : state) outcomes = core::simulate(tasks, options);
  double spring_steps = 0, flop = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const auto steps = static_cast<double>(outcomes[i].steps);
    spring_steps += steps * outcomes[i].springs;
    flop += steps * water_step_flop(*tasks[i].body);
  }
  report(state, spring_steps, "spring-step");
  report_flop(state, flop);
  state.counters["spring_steps_per_s"] = Counter(spring_steps, Counter::kIsIterationInvariantRate);
  state.counters["animats_per_s"] = Counter(animats, Counter::kIsIterationInvariantRate);
}

void development(benchmark::State& state, int animats, int threads) {
  std::vector<core::Network> networks;
  const auto genomes = evolved_genomes();
  for (int i = 0; i < animats; ++i) {
    networks.push_back(compile(genomes[static_cast<std::size_t>(i) % genomes.size()]));
  }
  const core::DevelopmentRules rules;
  const int stages[] = {rules.steps};
  for (auto _ : state) {
    benchmark::DoNotOptimize(core::develop(networks, rules, stages, threads));
  }
  report(state, animats, "development");
  state.counters["animats_per_s"] = Counter(animats, Counter::kIsIterationInvariantRate);
}

void peak_of_threads(benchmark::State& state, int threads) {
  constexpr int rounds = 1 << 20;
  float seed = 1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(seed);
#pragma omp parallel num_threads(threads)
    benchmark::DoNotOptimize(multiply_add<float>(rounds, seed));
  }
  const double flop = multiply_add_flop<float>(rounds) * threads;
  report(state, flop, "flop");
  report_flop(state, flop);
}

template <class F>
void add(const std::string& name, int threads, F f) {
  benchmark::RegisterBenchmark((name + "/threads:" + std::to_string(threads)).c_str(), f)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

void add_all() {
  const int most = omp_get_max_threads();
  std::set<int> counts = {most};
  for (int threads = 1; threads < most; threads *= 2) counts.insert(threads);
  for (const int threads : counts) {
    add("peak", threads, [threads](benchmark::State& state) { peak_of_threads(state, threads); });
    add("strong/locomotion", threads,
        [threads](benchmark::State& state) { locomotion(state, strong_animats, threads); });
    add("weak/locomotion", threads,
        [threads](benchmark::State& state) { locomotion(state, weak_animats * threads, threads); });
    add("strong/development", threads,
        [threads](benchmark::State& state) { development(state, strong_animats, threads); });
    add("weak/development", threads, [threads](benchmark::State& state) {
      development(state, weak_animats * threads, threads);
    });
  }
}

}  // namespace
}  // namespace metamorph::bench

int main(int argc, char** argv) {
  return metamorph::bench::run(argc, argv, metamorph::bench::add_all);
}
