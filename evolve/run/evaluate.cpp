#include "evolve/run/evaluate.h"

#include <omp.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "core/development.h"
#include "core/extract_body.h"
#include "core/locomotion.h"
#include "evolve/files/genome_file.h"
#include "evolve/run/stopwatch.h"

namespace metamorph::evolve {
namespace {

std::ptrdiff_t signed_size(const auto& list) { return static_cast<std::ptrdiff_t>(list.size()); }

void count_links(const core::LinkCheck& check, const Genome& genome, CheckedLinks& total) {
  if (!check.ok()) {
    throw std::runtime_error(difference_text(check) + "; the genome:\n" + genome_text(genome));
  }
  ++total.developments;
  total.renewals += check.renewals;
  total.links += check.links;
}

}  // namespace

std::size_t Evaluator::GenomeHash::operator()(const Genome& genome) const {
  std::uint64_t hash = genome.nodes.size();
  for (const LinkGene& link : genome.links) {
    hash = (hash ^ static_cast<std::uint64_t>(link.innovation)) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ std::bit_cast<std::uint64_t>(link.weight)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return hash;
}

Evaluator::Evaluator(const Experiment& experiment, int threads, CheckedLinks* checked)
    : experiment_(experiment),
      threads_(threads > 0 ? threads : omp_get_max_threads()),
      checked_(checked) {}

std::vector<Evaluated> Evaluator::evaluate(std::span<const Genome> genomes,
                                           const std::vector<std::uint8_t>& run_trial,
                                           EvaluationSeconds& seconds) {
  if (run_trial != previous_trials_) previous_.clear();
  std::vector<const Genome*> fresh;
  for (const Genome& genome : genomes) {
    if (!previous_.contains(genome)) fresh.push_back(&genome);
  }
  std::vector<Evaluated> fresh_results = evaluate_new(fresh, run_trial, seconds);

  std::vector<Evaluated> results(genomes.size());
  std::unordered_map<Genome, Evaluated, GenomeHash> current;
  std::size_t next_fresh = 0;
  for (std::size_t i = 0; i < genomes.size(); ++i) {
    const auto known = previous_.find(genomes[i]);
    results[i] = known != previous_.end() ? known->second : std::move(fresh_results[next_fresh++]);
    current.emplace(genomes[i], results[i]);
  }
  previous_ = std::move(current);
  previous_trials_ = run_trial;
  return results;
}

Evaluated Evaluator::evaluate_fully(const Genome& genome, EvaluationSeconds& seconds) const {
  const Genome* const genomes[] = {&genome};
  const std::vector<std::uint8_t> every_trial(experiment_.trials.size(), 1);
  return std::move(evaluate_new(genomes, every_trial, seconds).front());
}

std::vector<Evaluated> Evaluator::evaluate_new(std::span<const Genome* const> genomes,
                                               const std::vector<std::uint8_t>& run_trial,
                                               EvaluationSeconds& seconds) const {
  const std::size_t count = genomes.size(), trials = experiment_.trials.size();
  std::vector<int> stages;
  for (std::size_t t = 0; t < trials; ++t) {
    if (run_trial[t] != 0) stages.push_back(experiment_.trials[t].stage);
  }
  std::sort(stages.begin(), stages.end());
  stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
  const std::size_t stage_count = stages.size();

  Stopwatch watch;
  std::vector<core::Network> networks(count);
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (std::ptrdiff_t i = 0; i < signed_size(networks); ++i) {
    const auto n = static_cast<std::size_t>(i);
    networks[n] = compile(*genomes[n]);
  }
  std::vector<core::LinkCheck> checks(checked_ != nullptr ? count : 0);
  const std::vector<std::vector<core::Embryo>> embryos =
      core::develop(networks, experiment_.development, stages, threads_, checks);
  for (std::size_t i = 0; i < checks.size(); ++i) count_links(checks[i], *genomes[i], *checked_);
  seconds.develop += watch.lap();

  std::vector<core::Extraction> bodies(count * stage_count);
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (std::ptrdiff_t i = 0; i < signed_size(bodies); ++i) {
    const auto n = static_cast<std::size_t>(i);
    bodies[n] =
        core::extract_body(embryos[n / stage_count][n % stage_count], experiment_.min_cells);
  }
  seconds.extract += watch.lap();

  std::vector<Evaluated> results(count);
  std::vector<core::LocomotionTask> tasks;
  std::vector<core::Outcome*> task_outcome;
  for (std::size_t i = 0; i < count; ++i) {
    Evaluated& result = results[i];
    result.stages.resize(trials);
    result.evaluation.trials.resize(trials);
    result.evaluation.evaluated = run_trial;
    for (std::size_t t = 0; t < trials; ++t) {
      core::Outcome& outcome = result.evaluation.trials[t];
      outcome.status = core::Status::empty;
      if (run_trial[t] == 0) continue;
      const Trial& trial = experiment_.trials[t];
      const auto stage = static_cast<std::size_t>(
          std::lower_bound(stages.begin(), stages.end(), trial.stage) - stages.begin());
      const core::Embryo& embryo = embryos[i][stage];
      result.stages[t] = {embryo.cell_count(), embryo.created, embryo.died};
      const core::Extraction& extraction = bodies[i * stage_count + stage];
      outcome.status = extraction.status;
      if (extraction.status != core::Status::ok) continue;
      tasks.push_back({&extraction.body, &experiment_.scene_of(trial)});
      task_outcome.push_back(&outcome);
    }
    const core::Embryo& last = embryos[i].back();
    result.evaluation.created = last.created;
    result.evaluation.died = last.died;
    if (last.created > experiment_.created_limit) {
      result.evaluation.penalty = experiment_.created_penalty;
    }
  }
  const core::LocomotionOptions options{experiment_.locomotion.precision,
                                        experiment_.locomotion.method, threads_};
  const std::vector<core::Outcome> outcomes = core::simulate(tasks, options);
  for (std::size_t i = 0; i < tasks.size(); ++i) *task_outcome[i] = outcomes[i];
  seconds.locomotion += watch.lap();
  return results;
}

}  // namespace metamorph::evolve
