#include "evolve/run/run.h"

#include <fmt/format.h>

#include <numeric>

#include "evolve/files/input_error.h"
#include "evolve/run/stopwatch.h"

namespace metamorph::evolve {
namespace {

/// Grows the best individual by score through all trials, for the record: progressive search runs
/// only larvae at first, but the figures show what adults their best would become.
void complete_best(const Experiment& experiment, const PopulationState& population,
                   const Evaluator& evaluator, GenerationResult& result,
                   EvaluationSeconds& seconds) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < result.scores.size(); ++i) {
    if (result.scores[i] > result.scores[best]) best = i;
  }
  Evaluated& evaluated = result.individuals[best];
  const auto& ran = evaluated.evaluation.evaluated;
  if (std::accumulate(ran.begin(), ran.end(), std::size_t{0}) == experiment.trials.size()) return;
  evaluated = evaluator.evaluate_fully(population.genomes[best], result.generation, seconds);
}

GenerationResult run_generation(const Experiment& experiment, const PopulationState& population,
                                SearchState& search, Evaluator& evaluator, int threads,
                                PhaseSeconds& seconds) {
  GenerationResult result;
  result.generation = population.generation;
  result.archive_before = search.archive.size();
  result.individuals =
      evaluator.evaluate(population.genomes, trials_to_run(experiment, population.generation),
                         population.generation, seconds.evaluation);
  result.work = evaluator.work();
  Stopwatch watch;
  std::vector<Evaluation> evaluations;
  std::vector<std::int64_t> ids;
  for (std::size_t i = 0; i < result.individuals.size(); ++i) {
    evaluations.push_back(result.individuals[i].evaluation);
    ids.push_back(population.individuals[i].id);
  }
  result.scores = score_generation(experiment.search, search, evaluations, ids,
                                   population.generation, experiment.generations, threads);
  seconds.search += watch.lap();
  complete_best(experiment, population, evaluator, result, seconds.evaluation);
  for (const Evaluated& one : result.individuals) {
    result.eq6.push_back(scalar_fitness(one.evaluation));
  }
  result.champion = best_position(result.eq6, result.scores);
  return result;
}

/// True if the champion of this generation is better than all before.
bool keep_best(const PopulationState& population, const GenerationResult& result, BestEver& best) {
  const std::size_t champion = result.champion;
  const double eq6 = result.eq6[champion], score = result.scores[champion];
  if (std::pair(eq6, score) <= std::pair(best.eq6, best.score)) return false;
  best = {result.generation,           population.individuals[champion].id, eq6, score, {},
          population.genomes[champion]};
  for (const core::Outcome& outcome : result.individuals[champion].evaluation.trials) {
    best.distances.push_back(outcome.distance);
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> trials_to_run(const Experiment& experiment, int generation) {
  std::vector<std::uint8_t> trials;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    trials.push_back(evaluates_trial(experiment.search.kind, static_cast<int>(t), generation,
                                     experiment.generations)
                         ? 1
                         : 0);
  }
  return trials;
}

RunSummary run(Record& record, const RunOptions& options) {
  const Experiment experiment = record.experiment();
  Checkpoint state = record.checkpoint();
  Evaluator evaluator(experiment, options.threads, options.checked_links);
  RunSummary summary;
  const RunStart start{experiment, record.directory(), state.population.generation};
  for (Reporter* reporter : options.reporters) reporter->started(start);

  while (state.population.generation < experiment.generations) {
    if (options.stop && options.stop()) {
      summary.interrupted = true;
      break;
    }
    Stopwatch whole;
    PhaseSeconds seconds;
    const PopulationState population = state.population;  // as evaluated; the state breeds on
    const GenerationResult result =
        run_generation(experiment, population, state.search, evaluator, options.threads, seconds);
    const bool improved = keep_best(population, result, state.best);
    Stopwatch watch;
    next_generation(
        state.population, experiment.neat, result.scores,
        restarts_records(experiment.search.kind, result.generation, experiment.generations),
        options.threads);
    seconds.breeding = watch.lap();
    record.write(population, result, seconds, state);
    seconds.record = watch.lap();

    const auto counts = count_statuses(result);
    for (std::size_t s = 0; s < counts.size(); ++s) summary.statuses[s] += counts[s];
    summary.near_step_limit += count_near_step_limit(result);
    summary.seconds += seconds;
    summary.work += result.work;
    const GenerationReport report{experiment, population, result,
                                  state.best, improved,   count_evaluations(experiment, result),
                                  whole.lap()};
    for (Reporter* reporter : options.reporters) reporter->generation_done(report);
  }
  summary.generations_done = state.population.generation;
  summary.best = state.best;
  for (Reporter* reporter : options.reporters) reporter->finished(summary);
  return summary;
}

void check_new_generations(const Experiment& experiment, int done, int generations) {
  if (generations == experiment.generations) return;
  if (generations < done) {
    throw InputError(
        fmt::format("--generations {}: expected at least {}, which the run has done already",
                    generations, done));
  }
  if (experiment.search.kind == SearchKind::progressive) {
    throw InputError(fmt::format(
        "--generations {}: expected {}: progressive search paces itself by the number of "
        "generations, another number would have been another run from the start",
        generations, experiment.generations));
  }
}

}  // namespace metamorph::evolve
