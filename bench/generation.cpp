// Whole generations: 300 metamorphic individuals of evolved size, from genomes to the next genomes;
// reproduction and novelty on their own; memory.

#include <omp.h>

#include <fstream>
#include <string>
#include <vector>

#include "bench/bodies.h"
#include "bench/measure.h"
#include "evolve/experiment/experiment_file.h"
#include "evolve/search/novelty.h"
#include "metamorph/evaluator.h"
#include "metamorph/random.h"
#include "metamorph/searches.h"

namespace metamorph::bench {
namespace {

constexpr int population = 300;

/// A metamorphic experiment. Adults grow to 200 cells at most, so that bodies have the sizes that
/// evolved ones have on average: larvae about 90 cells, adults about 200.
evolve::Experiment experiment(const std::string& larva, const std::string& adult) {
  return evolve::parse_experiment(
      "name = 'bench'\n[search]\nkind = 'novelty'\n[development]\nmax_cells = 200\n"
      "[[trials]]\nname = 'larva'\nstage = 600\nscene = '" +
          larva + "'\n[[trials]]\nname = 'adult'\nstage = 1200\nscene = '" + adult + "'\n",
      "bench");
}

/// The evolved genomes, again and again, each time with weights so little larger that networks and
/// bodies differ in their last digits: what is the same would be evaluated only once.
evolve::PopulationState evolved_population(const evolve::NeatSettings& settings) {
  const auto evolved = evolved_genomes();
  evolve::PopulationState state = evolve::first_generation(settings, 1);
  for (std::size_t i = 0; i < state.genomes.size(); ++i) {
    state.genomes[i] = evolved[i % evolved.size()];
    const auto copy = static_cast<double>(i / evolved.size());
    for (evolve::LinkGene& link : state.genomes[i].links) link.weight *= 1 + 1e-5 * copy;
  }
  return state;
}

/// Largest resident size since the last call of forget_peak(), bytes; 0 where the system does not
/// say.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (status >> word) {
    if (word == "VmHWM:") status >> kilobytes;
  }
  return kilobytes * 1024;
}

void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

void generation(benchmark::State& state, const std::string& larva, const std::string& adult,
                int threads) {
  const evolve::Experiment setting = experiment(larva, adult);
  const evolve::PopulationState start = evolved_population(setting.neat);
  const std::vector<std::uint8_t> every_trial(setting.trials.size(), 1);
  evolve::EvaluationSeconds seconds;
  std::vector<evolve::Evaluated> individuals;
  evolve::EvaluationWork work;
  forget_peak();
  for (auto _ : state) {
    evolve::Evaluator evaluator(evolve::rules_of(setting), threads);
    std::vector<core::Network> networks;
    for (const evolve::Genome& genome : start.genomes) networks.push_back(compile(genome));
    individuals = evaluator.evaluate(networks, every_trial, 0);
    work += evaluator.work();
    seconds += evaluator.seconds();
    const auto search = evolve::make_search(evolve::search_setup_of(setting, threads));
    std::vector<evolve::Evaluation> evaluations;
    for (const auto& one : individuals) evaluations.push_back(evolve::evaluation_of(one));
    benchmark::DoNotOptimize(search->tell(evaluations));
    benchmark::DoNotOptimize(search->ask());
  }
  report(state, 1, "generation");
  state.counters["peak_MB"] = peak_memory() / 1e6;
  const auto runs = static_cast<double>(state.iterations());
  state.counters["develop_s"] = seconds.develop / runs;
  state.counters["extract_s"] = seconds.extract / runs;
  state.counters["locomotion_s"] = seconds.locomotion / runs;
  state.counters["developed"] = static_cast<double>(work.developed) / runs;
  state.counters["simulated"] = static_cast<double>(work.simulated) / runs;
  for (std::size_t t = 0; t < setting.trials.size(); ++t) {
    double cells = 0, steps = 0;
    for (const auto& individual : individuals) {
      cells += individual.trials[t].cells;
      steps += static_cast<double>(individual.trials[t].steps);
    }
    state.counters[setting.trials[t].name + "_cells"] = cells / population;
    state.counters[setting.trials[t].name + "_steps"] = steps / population;
  }
}

/// A population that has lived for some generations under random fitness: diverse, in species.
evolve::PopulationState lived_population(const evolve::NeatSettings& settings,
                                         std::vector<double>& fitness) {
  evolve::PopulationState state = evolve::first_generation(settings, 1);
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 0);
  fitness.resize(population);
  for (int generation = 0; generation < 50; ++generation) {
    for (double& value : fitness) value = random.uniform();
    evolve::next_generation(state, settings, fitness, false, 1);
  }
  return state;
}

void reproduction(benchmark::State& state) {
  const evolve::NeatSettings settings;
  std::vector<double> fitness;
  const evolve::PopulationState start = lived_population(settings, fitness);
  for (auto _ : state) {
    state.PauseTiming();
    evolve::PopulationState next = start;
    state.ResumeTiming();
    evolve::next_generation(next, settings, fitness, false, 1);
    benchmark::DoNotOptimize(next);
  }
  report(state, 1, "generation");
  double links = 0;
  for (const auto& genome : start.genomes) links += static_cast<double>(genome.links.size());
  state.counters["links"] = links / population;
  state.counters["species"] = static_cast<double>(start.species.size());
}

void novelty(benchmark::State& state) {
  const evolve::NoveltySettings settings;
  evolve::RandomStream random(evolve::Purpose::test, 2, 0, 0);
  const auto behaviour = [&] {
    std::vector<double> place(4);
    for (double& value : place) value = 50 * random.triangular();
    return place;
  };
  std::vector<std::vector<double>> behaviours(population);
  for (auto& place : behaviours) place = behaviour();
  std::vector<evolve::ArchiveEntry> archive(static_cast<std::size_t>(state.range(0)));
  for (auto& entry : archive) entry.behaviour = behaviour();
  for (auto _ : state) {
    benchmark::DoNotOptimize(evolve::novelty(behaviours, archive, settings.neighbours, 1, 1));
  }
  report(state, 1, "generation");
}

void add(const std::string& larva, const std::string& adult, int threads) {
  const std::string name =
      "generation/" + larva + "-to-" + adult + "/threads:" + std::to_string(threads);
  benchmark::RegisterBenchmark(name.c_str(),
                               [larva, adult, threads](benchmark::State& state) {
                                 generation(state, larva, adult, threads);
                               })
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

void add_generations() {
  std::vector<int> threads = {1};
  if (omp_get_max_threads() > 1) threads.push_back(2);
  if (omp_get_max_threads() > 2) threads.push_back(omp_get_max_threads());
  for (const int count : threads) {
    add("water", "land", count);
    add("land", "water", count);
  }
}

BENCHMARK(reproduction)->Unit(benchmark::kMillisecond);
BENCHMARK(novelty)->Arg(5000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace metamorph::bench

int main(int argc, char** argv) {
  return metamorph::bench::run(argc, argv, metamorph::bench::add_generations);
}
