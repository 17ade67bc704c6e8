#include "evolve/run/evaluate.h"

#include <omp.h>

#include <algorithm>
#include <functional>
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

EvaluationWork& EvaluationWork::operator+=(const EvaluationWork& other) {
  individuals += other.individuals;
  developed += other.developed;
  bodies += other.bodies;
  simulated += other.simulated;
  return *this;
}

std::size_t Evaluator::TaskHash::operator()(const Task& task) const {
  return FingerprintHash{}(task.body) ^ std::hash<const core::Scene*>{}(task.scene);
}

Evaluator::Evaluator(const Experiment& experiment, int threads, CheckedLinks* checked)
    : experiment_(experiment),
      threads_(threads > 0 ? threads : omp_get_max_threads()),
      checked_(checked) {}

std::vector<Evaluated> Evaluator::evaluate(std::span<const Genome> genomes,
                                           const std::vector<std::uint8_t>& run_trial,
                                           EvaluationSeconds& seconds) {
  if (run_trial != known_trials_) known_.clear();
  work_ = {};

  Stopwatch watch;
  std::vector<core::Network> networks(genomes.size());
  std::vector<Fingerprint> prints(genomes.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (std::ptrdiff_t i = 0; i < signed_size(networks); ++i) {
    const auto n = static_cast<std::size_t>(i);
    networks[n] = compile(genomes[n]);
    prints[n] = fingerprint(networks[n]);
  }
  std::vector<core::Network> fresh;
  std::vector<const Genome*> fresh_genomes;
  std::unordered_map<Fingerprint, std::size_t, FingerprintHash> fresh_position;
  for (std::size_t i = 0; i < genomes.size(); ++i) {
    if (known_.contains(prints[i])) continue;
    if (fresh_position.emplace(prints[i], fresh.size()).second) {
      fresh.push_back(std::move(networks[i]));
      fresh_genomes.push_back(&genomes[i]);
    }
  }
  seconds.develop += watch.lap();

  std::vector<Known> computed = evaluate_new(fresh, fresh_genomes, run_trial, seconds, work_);
  std::unordered_map<Fingerprint, Known, FingerprintHash> current;
  std::vector<Evaluated> results;
  for (const Fingerprint& print : prints) {
    const auto [entry, is_first] = current.try_emplace(print);
    Known& known = entry->second;
    if (is_first) {
      const auto at = fresh_position.find(print);
      known = std::move(at == fresh_position.end() ? known_.at(print) : computed[at->second]);
    }
    results.push_back(known.result);
    for (const auto& task : known.tasks) work_.bodies += task ? 1 : 0;
  }
  work_.individuals = static_cast<std::int64_t>(genomes.size());
  known_ = std::move(current);
  known_trials_ = run_trial;
  outcomes_.clear();
  for (const auto& [print, known] : known_) {
    for (std::size_t t = 0; t < known.tasks.size(); ++t) {
      if (known.tasks[t]) outcomes_.emplace(*known.tasks[t], known.result.evaluation.trials[t]);
    }
  }
  return results;
}

Evaluated Evaluator::evaluate_fully(const Genome& genome, EvaluationSeconds& seconds) const {
  const core::Network networks[] = {compile(genome)};
  const Genome* const genomes[] = {&genome};
  const std::vector<std::uint8_t> every_trial(experiment_.trials.size(), 1);
  EvaluationWork work;
  return std::move(evaluate_new(networks, genomes, every_trial, seconds, work).front().result);
}

std::vector<Evaluator::Known> Evaluator::evaluate_new(std::span<const core::Network> networks,
                                                      std::span<const Genome* const> genomes,
                                                      const std::vector<std::uint8_t>& run_trial,
                                                      EvaluationSeconds& seconds,
                                                      EvaluationWork& work) const {
  const std::size_t count = networks.size(), trials = experiment_.trials.size();
  std::vector<int> stages;
  for (std::size_t t = 0; t < trials; ++t) {
    if (run_trial[t] != 0) stages.push_back(experiment_.trials[t].stage);
  }
  std::sort(stages.begin(), stages.end());
  stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
  const std::size_t stage_count = stages.size();

  Stopwatch watch;
  std::vector<core::LinkCheck> checks(checked_ != nullptr ? count : 0);
  const std::vector<std::vector<core::Embryo>> embryos =
      core::develop(networks, experiment_.development, stages, threads_, checks);
  for (std::size_t i = 0; i < checks.size(); ++i) count_links(checks[i], *genomes[i], *checked_);
  work.developed += static_cast<std::int64_t>(count);
  seconds.develop += watch.lap();

  std::vector<core::Extraction> bodies(count * stage_count);
  std::vector<Fingerprint> prints(bodies.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (std::ptrdiff_t i = 0; i < signed_size(bodies); ++i) {
    const auto n = static_cast<std::size_t>(i);
    bodies[n] =
        core::extract_body(embryos[n / stage_count][n % stage_count], experiment_.min_cells);
    if (bodies[n].status == core::Status::ok) prints[n] = fingerprint(bodies[n].body);
  }
  seconds.extract += watch.lap();

  std::vector<Known> all(count);
  std::vector<core::LocomotionTask> tasks;  // of different bodies or scenes
  std::unordered_map<Task, std::size_t, TaskHash> position;
  for (std::size_t i = 0; i < count; ++i) {
    Evaluated& result = all[i].result;
    all[i].tasks.resize(trials);
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
      const Task task = {prints[i * stage_count + stage], &experiment_.scene_of(trial)};
      all[i].tasks[t] = task;
      const auto known = outcomes_.find(task);
      if (known != outcomes_.end()) {
        outcome = known->second;
      } else if (position.emplace(task, tasks.size()).second) {
        tasks.push_back({&extraction.body, task.scene});
      }
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
  for (Known& one : all) {
    for (std::size_t t = 0; t < trials; ++t) {
      if (!one.tasks[t]) continue;
      const auto computed = position.find(*one.tasks[t]);
      if (computed == position.end()) continue;
      one.result.evaluation.trials[t] = outcomes[computed->second];
    }
  }
  work.simulated += static_cast<std::int64_t>(tasks.size());
  seconds.locomotion += watch.lap();
  return all;
}

}  // namespace metamorph::evolve
