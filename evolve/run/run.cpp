#include "evolve/run/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/body/parallel_for.h"
#include "evolve/evaluation/stopwatch.h"
#include "evolve/files/input_error.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

/// [genomes] The networks of each in its stages of life.
using Lives = std::vector<std::vector<core::Network>>;

Lives compile_all(const std::vector<Genome>& genomes, const Experiment& experiment, int threads) {
  Lives lives(genomes.size());
  core::parallel_for<core::Schedule::dynamic>(genomes.size(), threads, [&](std::size_t n) {
    lives[n] = networks_of(experiment, genomes[n]);
  });
  return lives;
}

/// Grows the best individual by score through all trials, for the record: progressive search runs
/// only larvae at first, but the figures show what adults their best would become.
void complete_best(const Lives& lives, Evaluator& evaluator, GenerationResult& result,
                   std::vector<Evaluation>& evaluations) {
  const auto best = static_cast<std::size_t>(
      std::max_element(result.scores.begin(), result.scores.end()) - result.scores.begin());
  Evaluated& evaluated = result.individuals[best];
  const bool complete = std::all_of(evaluated.evaluated.begin(), evaluated.evaluated.end(),
                                    [](std::uint8_t ran) { return ran != 0; });
  if (complete) return;
  evaluated = evaluator.evaluate_fully(lives[best], result.generation);
  evaluations[best] = evaluation_of(evaluated);
}

GenerationResult run_generation(const Experiment& experiment, Search& search, Evaluator& evaluator,
                                int threads, PhaseSeconds& seconds) {
  Stopwatch watch;
  GenerationResult result;
  result.asked = search.ask();
  result.generation = result.asked.generation;
  seconds.search += watch.lap();
  const Lives lives = compile_all(result.asked.genomes, experiment, threads);
  seconds.evaluation.develop += watch.lap();
  result.individuals = evaluator.evaluate(lives, result.asked.measured, result.generation);
  result.work = evaluator.work();
  watch.lap();
  std::vector<Evaluation> evaluations;
  for (const Evaluated& one : result.individuals) evaluations.push_back(evaluation_of(one));
  Told told = search.tell(evaluations);
  result.scores = std::move(told.scores);
  result.search_rows = std::move(told.rows);
  seconds.search += watch.lap();
  complete_best(lives, evaluator, result, evaluations);
  for (const Evaluation& evaluation : evaluations) {
    result.eq6.push_back(geometric_mean(evaluation));
  }
  result.champion = best_position(result.eq6, result.scores);
  return result;
}

/// True if the champion of this generation is better than all before.
bool keep_best(const GenerationResult& result, BestEver& best) {
  const std::size_t champion = result.champion;
  const double eq6 = result.eq6[champion], score = result.scores[champion];
  if (std::pair(eq6, score) <= std::pair(best.eq6, best.score)) return false;
  best = {result.generation,
          result.asked.lineage[champion].id,
          eq6,
          score,
          {},
          result.asked.genomes[champion]};
  for (const core::Outcome& outcome : result.individuals[champion].trials) {
    best.distances.push_back(outcome.distance);
  }
  return true;
}

}  // namespace

RunSummary run(Record& record, const RunOptions& options) {
  const Experiment experiment = record.experiment();
  const int threads = core::thread_count(options.threads);
  const std::unique_ptr<Search> search = make_search(search_setup_of(experiment, threads));
  BestEver best = record.restore(*search);
  Evaluator evaluator(rules_of(experiment), threads, options.checked_links);
  RunSummary summary;
  const RunStart start{experiment, record.directory(), search->generation(), best};
  for (Reporter* reporter : options.reporters) reporter->started(start);

  while (search->generation() < experiment.generations) {
    if (options.stop && options.stop()) {
      summary.interrupted = true;
      break;
    }
    Stopwatch whole;
    PhaseSeconds seconds;
    const EvaluationSeconds before = evaluator.seconds();
    const GenerationResult result =
        run_generation(experiment, *search, evaluator, threads, seconds);
    seconds.evaluation += evaluator.seconds() - before;
    const bool improved = keep_best(result, best);
    Stopwatch watch;
    record.write(result, seconds, *search, best);
    seconds.record = watch.lap();

    const auto counts = count_statuses(result);
    for (std::size_t s = 0; s < counts.size(); ++s) summary.statuses[s] += counts[s];
    summary.near_step_limit += count_near_step_limit(result);
    summary.seconds += seconds;
    summary.work += result.work;
    const GenerationReport report{
        experiment, result, best, improved, count_evaluations(experiment, result), whole.lap()};
    for (Reporter* reporter : options.reporters) reporter->generation_done(report);
  }
  summary.generations_done = search->generation();
  summary.best = best;
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
  if (make_search(search_setup_of(experiment, 1))->is_paced()) {
    throw InputError(
        fmt::format("--generations {}: expected {}: {} search paces itself by the number of "
                    "generations, another number would have been another run from the start",
                    generations, experiment.generations, experiment.search.kind));
  }
}

}  // namespace metamorph::evolve
