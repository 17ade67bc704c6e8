#include "evolve/run/evaluate.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <unordered_set>

#include "core/development/link_check.h"
#include "evolve/files/genome_file.h"
#include "evolve/run/starts.h"
#include "evolve/run/stopwatch.h"
#include "metamorph/development.h"
#include "metamorph/locomotion.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

std::ptrdiff_t signed_size(const auto& list) { return static_cast<std::ptrdiff_t>(list.size()); }

// Displaced copies are made for so many simulations at a time: enough to keep threads busy, some
// 100 MB of bodies.
constexpr std::size_t most_at_once = 4096;

/// The distinct stages of the trials that run, ascending.
std::vector<int> stages_of(const Experiment& experiment,
                           const std::vector<std::uint8_t>& run_trial) {
  std::vector<int> stages;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    if (run_trial[t] != 0) stages.push_back(experiment.trials[t].stage);
  }
  std::sort(stages.begin(), stages.end());
  stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
  return stages;
}

std::size_t position_of(int stage, const std::vector<int>& stages) {
  return static_cast<std::size_t>(std::lower_bound(stages.begin(), stages.end(), stage) -
                                  stages.begin());
}

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
      threads_(core::thread_count(threads)),
      checked_(checked),
      renews_(std::any_of(experiment.trials.begin(), experiment.trials.end(),
                          [](const Trial& trial) { return trial.starts_renew; })) {}

std::vector<Evaluated> Evaluator::evaluate(std::span<const Genome> genomes,
                                           const std::vector<std::uint8_t>& run_trial,
                                           int generation, EvaluationSeconds& seconds) {
  if (run_trial != known_trials_) known_.clear();
  work_ = {};

  Stopwatch watch;
  const ControlShape shape = shape_of(experiment_.development);
  std::vector<core::Network> networks(genomes.size());
  std::vector<Fingerprint> prints(genomes.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (std::ptrdiff_t i = 0; i < signed_size(networks); ++i) {
    const auto n = static_cast<std::size_t>(i);
    networks[n] = compile(genomes[n], shape);
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

  std::vector<Known> grown = grow(fresh, fresh_genomes, run_trial, seconds, work_);
  std::unordered_map<Fingerprint, Known, FingerprintHash> current;
  std::vector<Known*> distinct;
  for (const Fingerprint& print : prints) {
    const auto [entry, is_first] = current.try_emplace(print);
    if (!is_first) continue;
    const auto at = fresh_position.find(print);
    entry->second = std::move(at == fresh_position.end() ? known_.at(print) : grown[at->second]);
    distinct.push_back(&entry->second);
  }
  outcomes_ = run_bodies(distinct, generation, seconds, work_);

  std::vector<Evaluated> results;
  for (const Fingerprint& print : prints) {
    const Known& known = current.at(print);
    results.push_back(known.result);
    for (const auto& starts : known.tasks) work_.bodies += signed_size(starts);
  }
  work_.individuals = static_cast<std::int64_t>(genomes.size());
  known_ = std::move(current);
  known_trials_ = run_trial;
  return results;
}

Evaluated Evaluator::evaluate_fully(const Genome& genome, int generation,
                                    EvaluationSeconds& seconds) const {
  const core::Network networks[] = {compile(genome, shape_of(experiment_.development))};
  const Genome* const genomes[] = {&genome};
  const std::vector<std::uint8_t> every_trial(experiment_.trials.size(), 1);
  EvaluationWork work;
  std::vector<Known> grown = grow(networks, genomes, every_trial, seconds, work);
  Known* const all[] = {&grown.front()};
  run_bodies(all, generation, seconds, work);
  return std::move(grown.front().result);
}

std::vector<Evaluator::Known> Evaluator::grow(std::span<const core::Network> networks,
                                              std::span<const Genome* const> genomes,
                                              const std::vector<std::uint8_t>& run_trial,
                                              EvaluationSeconds& seconds,
                                              EvaluationWork& work) const {
  const std::size_t count = networks.size(), trials = experiment_.trials.size();
  const std::vector<int> stages = stages_of(experiment_, run_trial);
  const std::size_t stage_count = stages.size();

  Stopwatch watch;
  const std::vector<std::vector<core::Embryo>> embryos =
      core::develop(networks, experiment_.development, stages, threads_);
  if (checked_ != nullptr) {
    const std::vector<core::LinkCheck> checks =
        core::check_links(networks, experiment_.development, stages, threads_);
    for (std::size_t i = 0; i < count; ++i) count_links(checks[i], *genomes[i], *checked_);
  }
  work.developed += static_cast<std::int64_t>(count);
  seconds.develop += watch.lap();

  std::vector<Known> all(count);
  for (Known& one : all) one.bodies.resize(stage_count);
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(count * stage_count); ++i) {
    const std::size_t n = static_cast<std::size_t>(i) / stage_count;
    const std::size_t stage = static_cast<std::size_t>(i) % stage_count;
    all[n].bodies[stage] = core::extract_body(embryos[n][stage], experiment_.min_cells);
  }
  for (std::size_t i = 0; i < count; ++i) {
    Evaluated& result = all[i].result;
    result.stages.resize(trials);
    result.evaluation.trials.resize(trials);
    result.evaluation.evaluated = run_trial;
    for (std::size_t t = 0; t < trials; ++t) {
      core::Outcome& outcome = result.evaluation.trials[t];
      outcome.status = core::Status::empty;
      if (run_trial[t] == 0) continue;
      const std::size_t stage = position_of(experiment_.trials[t].stage, stages);
      const core::Embryo& embryo = embryos[i][stage];
      result.stages[t] = {embryo.cell_count(), embryo.created, embryo.died};
      outcome.status = all[i].bodies[stage].status;
    }
    const core::Embryo& last = embryos[i].back();
    result.evaluation.created = last.created;
    result.evaluation.died = last.died;
    if (last.created > experiment_.created_limit) {
      result.evaluation.penalty = experiment_.created_penalty;
    }
  }
  seconds.extract += watch.lap();
  return all;
}

std::vector<Evaluator::Task> Evaluator::tasks_of(const core::Body& body, const Trial& trial,
                                                 int generation) const {
  std::vector<Task> tasks;
  const core::Scene* const scene = &experiment_.scene_of(trial);
  for (int s = 0; s < trial.starts; ++s) {
    tasks.push_back({is_displaced(trial, s)
                         ? fingerprint(start_of(body, trial, s, experiment_.seed, generation))
                         : fingerprint(body),
                     scene});
  }
  return tasks;
}

Evaluator::Outcomes Evaluator::run_bodies(std::span<Known* const> all, int generation,
                                          EvaluationSeconds& seconds, EvaluationWork& work) const {
  const std::size_t trials = experiment_.trials.size();
  const auto body_of = [&](const Known& one, std::size_t trial) -> const core::Body* {
    const auto& ran = one.result.evaluation.evaluated;
    if (one.bodies.empty() || ran[trial] == 0) return nullptr;
    const std::vector<int> stages = stages_of(experiment_, ran);
    const core::Extraction& extraction =
        one.bodies[position_of(experiment_.trials[trial].stage, stages)];
    return extraction.status == core::Status::ok ? &extraction.body : nullptr;
  };

  Stopwatch watch;
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (std::ptrdiff_t i = 0; i < signed_size(all); ++i) {
    Known& one = *all[static_cast<std::size_t>(i)];
    one.tasks.resize(trials);
    for (std::size_t t = 0; t < trials; ++t) {
      if (const core::Body* body = body_of(one, t)) {
        one.tasks[t] = tasks_of(*body, experiment_.trials[t], generation);
      }
    }
  }
  seconds.extract += watch.lap();

  Outcomes outcomes;
  std::vector<Run> runs;  // of different bodies or scenes
  std::unordered_set<Task, TaskHash> running;
  for (const Known* one : all) {
    for (std::size_t t = 0; t < trials; ++t) {
      for (std::size_t s = 0; s < one->tasks[t].size(); ++s) {
        const Task& task = one->tasks[t][s];
        if (const auto known = outcomes_.find(task); known != outcomes_.end()) {
          outcomes.insert(*known);
        } else if (running.insert(task).second) {
          runs.push_back({task, body_of(*one, t), &experiment_.trials[t], static_cast<int>(s)});
        }
      }
    }
  }
  for (std::size_t first = 0; first < runs.size(); first += most_at_once) {
    const std::size_t size = std::min(most_at_once, runs.size() - first);
    simulate(std::span(runs).subspan(first, size), generation, outcomes);
  }
  for (Known* one : all) {
    for (std::size_t t = 0; t < trials; ++t) {
      if (one->tasks[t].empty()) continue;
      std::vector<core::Outcome> starts;
      for (const Task& task : one->tasks[t]) starts.push_back(outcomes.at(task));
      one->result.evaluation.trials[t] =
          combine_starts(starts, experiment_.trials[t].starts_combine);
    }
    if (!renews_) one->bodies = {};
  }
  work.simulated += signed_size(runs);
  seconds.locomotion += watch.lap();
  return outcomes;
}

void Evaluator::simulate(std::span<const Run> runs, int generation, Outcomes& outcomes) const {
  std::vector<core::Body> displaced(runs.size());
  std::vector<core::LocomotionTask> tasks(runs.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (std::ptrdiff_t i = 0; i < signed_size(runs); ++i) {
    const auto n = static_cast<std::size_t>(i);
    const auto& [task, body, trial, start] = runs[n];
    tasks[n] = {body, task.scene};
    if (!is_displaced(*trial, start)) continue;
    displaced[n] = start_of(*body, *trial, start, experiment_.seed, generation);
    tasks[n].body = &displaced[n];
  }
  const core::LocomotionOptions options{experiment_.locomotion.precision,
                                        experiment_.locomotion.method, threads_};
  const std::vector<core::Outcome> computed = core::simulate(tasks, options);
  for (std::size_t n = 0; n < runs.size(); ++n) outcomes.emplace(runs[n].task, computed[n]);
}

}  // namespace metamorph::evolve
