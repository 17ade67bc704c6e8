#include "metamorph/evaluator.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/body/parallel_for.h"
#include "core/development/link_check.h"
#include "evolve/evaluation/describe.h"
#include "evolve/evaluation/fingerprint.h"
#include "evolve/evaluation/starts.h"
#include "evolve/evaluation/stopwatch.h"
#include "metamorph/extraction.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

using core::parallel_for;
using core::Schedule;

std::ptrdiff_t signed_size(const auto& list) { return static_cast<std::ptrdiff_t>(list.size()); }

/// Of each individual one network, or one for each stage of life.
using Lives = std::span<const std::vector<core::Network>>;

/// The distinct stages of the trials that run, ascending.
std::vector<int> stages_of(const EvaluationRules& rules,
                           const std::vector<std::uint8_t>& run_trial) {
  std::vector<int> stages;
  for (std::size_t t = 0; t < rules.trials.size(); ++t) {
    if (run_trial[t] != 0) stages.push_back(rules.trials[t].stage);
  }
  std::sort(stages.begin(), stages.end());
  stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
  return stages;
}

/// The steps at which the next stage of life begins.
std::vector<int> switches_of(const EvaluationRules& rules) {
  std::vector<int> stages = stages_of(rules, std::vector<std::uint8_t>(rules.trials.size(), 1));
  if (!stages.empty()) stages.pop_back();
  return stages;
}

std::size_t position_of(int stage, const std::vector<int>& stages) {
  return static_cast<std::size_t>(std::lower_bound(stages.begin(), stages.end(), stage) -
                                  stages.begin());
}

/// A body, as it starts, in a scene of the rules.
struct Task {
  Fingerprint body;
  const core::Scene* scene;
  bool operator==(const Task&) const = default;
};
struct TaskHash {
  std::size_t operator()(const Task& task) const {
    return FingerprintHash{}(task.body) ^ std::hash<const core::Scene*>{}(task.scene);
  }
};
using Outcomes = std::unordered_map<Task, core::Outcome, TaskHash>;

/// What is known of a network.
struct Known {
  Evaluated result;
  /// [distinct stages of the trials that run, ascending]; empty once its tasks are final.
  std::vector<core::Extraction> bodies;
  std::vector<std::vector<Task>> tasks;  ///< [trials][starts] that give its outcomes; of a trial
                                         ///< without a body none
};

/// A task that is to be simulated, and where its body comes from.
struct Run {
  Task task;
  const core::Body* body;
  const Trial* trial;
  int start;
};

}  // namespace

EvaluationSeconds& EvaluationSeconds::operator+=(const EvaluationSeconds& other) {
  develop += other.develop;
  extract += other.extract;
  locomotion += other.locomotion;
  return *this;
}

EvaluationSeconds EvaluationSeconds::operator-(const EvaluationSeconds& other) const {
  return {develop - other.develop, extract - other.extract, locomotion - other.locomotion};
}

EvaluationWork& EvaluationWork::operator+=(const EvaluationWork& other) {
  individuals += other.individuals;
  developed += other.developed;
  bodies += other.bodies;
  simulated += other.simulated;
  return *this;
}

class Evaluator::Implementation {
 public:
  Implementation(EvaluationRules rules, int threads, CheckedLinks* checked)
      : rules_(std::move(rules)),
        threads_(core::thread_count(threads)),
        checked_(checked),
        switches_(switches_of(rules_)),
        renews_(std::any_of(rules_.trials.begin(), rules_.trials.end(),
                            [](const Trial& trial) { return trial.starts_renew; })) {}

  std::vector<Evaluated> evaluate(Lives lives, const std::vector<std::uint8_t>& run_trial,
                                  int generation);
  Evaluated evaluate_fully(const std::vector<core::Network>& life, int generation);

  EvaluationRules rules_;
  EvaluationWork work_;
  EvaluationSeconds seconds_;

 private:
  std::vector<Known> grow(Lives lives, const std::vector<std::uint8_t>& run_trial);
  void check_links(Lives lives, const std::vector<int>& stages);
  void run_bodies(std::span<Known* const> all, int generation, Outcomes& outcomes);
  std::vector<Task> tasks_of(const core::Body& body, const Trial& trial, int generation) const;
  void simulate(std::span<const Run> runs, int generation, Outcomes& outcomes) const;

  int threads_;
  CheckedLinks* checked_;
  std::vector<int> switches_;
  bool renews_;  ///< a trial renews its starts
  // Of the last call, and the trials it ran.
  std::unordered_map<Fingerprint, Known, FingerprintHash> known_;
  Outcomes outcomes_;
  std::vector<std::uint8_t> known_trials_;
};

std::vector<Evaluated> Evaluator::Implementation::evaluate(
    Lives lives, const std::vector<std::uint8_t>& run_trial, int generation) {
  assert(run_trial.size() == rules_.trials.size());
  if (run_trial != known_trials_) known_.clear();
  // Taken out, so that what is known is gone and not half moved away if something throws.
  auto previous = std::exchange(known_, {});
  known_trials_ = run_trial;
  work_ = {};

  Stopwatch watch;
  std::vector<Fingerprint> prints(lives.size());
  parallel_for<Schedule::dynamic>(lives.size(), threads_,
                                  [&](std::size_t n) { prints[n] = fingerprint(lives[n]); });
  seconds_.develop += watch.lap();

  std::unordered_map<Fingerprint, Known, FingerprintHash> current;
  Outcomes outcomes;
  for (std::size_t next = 0; next < prints.size();) {
    std::vector<Known*> distinct, unknown;
    std::vector<std::vector<core::Network>> fresh;
    for (; next < prints.size() && distinct.size() < most_at_once; ++next) {
      const auto [entry, is_first] = current.try_emplace(prints[next]);
      if (!is_first) continue;
      distinct.push_back(&entry->second);
      if (const auto known = previous.find(prints[next]); known != previous.end()) {
        entry->second = std::move(known->second);
      } else {
        unknown.push_back(&entry->second);
        fresh.push_back(lives[next]);
      }
    }
    std::vector<Known> grown = grow(fresh, run_trial);
    for (std::size_t n = 0; n < grown.size(); ++n) *unknown[n] = std::move(grown[n]);
    run_bodies(distinct, generation, outcomes);
  }
  outcomes_ = std::move(outcomes);

  std::vector<Evaluated> results;
  for (const Fingerprint& print : prints) {
    const Known& known = current.at(print);
    results.push_back(known.result);
    for (const auto& starts : known.tasks) work_.bodies += signed_size(starts);
  }
  work_.individuals = signed_size(lives);
  known_ = std::move(current);
  return results;
}

Evaluated Evaluator::Implementation::evaluate_fully(const std::vector<core::Network>& life,
                                                    int generation) {
  const EvaluationWork work = work_;  // this one is nobody's generation
  std::vector<Known> grown = grow({&life, 1}, std::vector<std::uint8_t>(rules_.trials.size(), 1));
  Known* const all[] = {&grown.front()};
  Outcomes outcomes;
  run_bodies(all, generation, outcomes);
  work_ = work;
  return std::move(grown.front().result);
}

void Evaluator::Implementation::check_links(Lives lives, const std::vector<int>& stages) {
  const std::vector<core::LinkCheck> checks =
      core::check_links(lives, switches_, rules_.development, stages, threads_);
  for (std::size_t i = 0; i < checks.size(); ++i) {
    if (!checks[i].ok()) {
      throw std::runtime_error("network " + std::to_string(i) +
                               " of those developed: " + difference_text(checks[i]));
    }
    ++checked_->developments;
    checked_->renewals += checks[i].renewals;
    checked_->links += checks[i].links;
  }
}

/// Develops individuals that are all different. No outcome yet.
std::vector<Known> Evaluator::Implementation::grow(Lives lives,
                                                   const std::vector<std::uint8_t>& run_trial) {
  const std::size_t count = lives.size(), trials = rules_.trials.size();
  const std::vector<int> stages = stages_of(rules_, run_trial);
  const std::size_t stage_count = stages.size();

  Stopwatch watch;
  const std::vector<std::vector<core::Embryo>> embryos =
      core::develop(lives, switches_, rules_.development, stages, threads_);
  if (checked_ != nullptr) check_links(lives, stages);
  work_.developed += static_cast<std::int64_t>(count);
  seconds_.develop += watch.lap();

  std::vector<Known> all(count);
  for (Known& one : all) one.bodies.resize(stage_count);
  parallel_for<Schedule::dynamic>(count * stage_count, threads_, [&](std::size_t i) {
    const std::size_t n = i / stage_count, stage = i % stage_count;
    all[n].bodies[stage] = core::extract_body(embryos[n][stage], rules_.min_cells);
  });
  parallel_for<Schedule::dynamic>(count, threads_, [&](std::size_t i) {
    const std::vector<TrialDescriptors> described =
        describe_stages(rules_, stages, embryos[i], all[i].bodies);
    Evaluated& result = all[i].result;
    result.stages.resize(trials);
    result.descriptors.resize(trials);
    result.trials.resize(trials);
    result.evaluated = run_trial;
    for (std::size_t t = 0; t < trials; ++t) {
      core::Outcome& outcome = result.trials[t];
      outcome.status = core::Status::empty;
      if (run_trial[t] == 0) continue;
      const std::size_t stage = position_of(rules_.trials[t].stage, stages);
      const core::Embryo& embryo = embryos[i][stage];
      result.stages[t] = {embryo.cell_count(), embryo.created, embryo.died};
      outcome.status = all[i].bodies[stage].status;
      result.descriptors[t] = described[stage];
    }
    const core::Embryo& last = embryos[i].back();
    result.created = last.created;
    result.died = last.died;
    if (last.created > rules_.created_limit) {
      result.penalty = rules_.created_penalty;
    }
  });
  seconds_.extract += watch.lap();
  return all;
}

std::vector<Task> Evaluator::Implementation::tasks_of(const core::Body& body, const Trial& trial,
                                                      int generation) const {
  std::vector<Task> tasks;
  const core::Scene* const scene = &rules_.scene_of(trial);
  for (int s = 0; s < trial.starts; ++s) {
    tasks.push_back({is_displaced(trial, s)
                         ? fingerprint(start_of(body, trial, s, rules_.seed, generation))
                         : fingerprint(body),
                     scene});
  }
  return tasks;
}

/// Runs the bodies of `all` from the starts of a generation, as far as neither `outcomes` nor the
/// last call knows their outcome, and completes their results. Adds the outcomes of their tasks.
void Evaluator::Implementation::run_bodies(std::span<Known* const> all, int generation,
                                           Outcomes& outcomes) {
  const std::size_t trials = rules_.trials.size();
  const auto body_of = [&](const Known& one, std::size_t trial) -> const core::Body* {
    const auto& ran = one.result.evaluated;
    if (one.bodies.empty() || ran[trial] == 0) return nullptr;
    const std::vector<int> stages = stages_of(rules_, ran);
    const core::Extraction& extraction =
        one.bodies[position_of(rules_.trials[trial].stage, stages)];
    return extraction.status == core::Status::ok ? &extraction.body : nullptr;
  };

  Stopwatch watch;
  parallel_for<Schedule::dynamic>(all.size(), threads_, [&](std::size_t i) {
    Known& one = *all[i];
    one.tasks.resize(trials);
    for (std::size_t t = 0; t < trials; ++t) {
      if (const core::Body* body = body_of(one, t)) {
        one.tasks[t] = tasks_of(*body, rules_.trials[t], generation);
      }
    }
  });
  seconds_.extract += watch.lap();

  std::vector<Run> runs;  // of different bodies or scenes
  std::unordered_set<Task, TaskHash> running;
  for (const Known* one : all) {
    for (std::size_t t = 0; t < trials; ++t) {
      for (std::size_t s = 0; s < one->tasks[t].size(); ++s) {
        const Task& task = one->tasks[t][s];
        if (outcomes.contains(task)) continue;
        if (const auto known = outcomes_.find(task); known != outcomes_.end()) {
          outcomes.insert(*known);
        } else if (running.insert(task).second) {
          runs.push_back({task, body_of(*one, t), &rules_.trials[t], static_cast<int>(s)});
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
      one->result.trials[t] = combine_starts(starts, rules_.trials[t].starts_combine);
      describe_motion(one->result.descriptors[t], one->result.trials[t]);
    }
    if (!renews_) one->bodies = {};
  }
  work_.simulated += signed_size(runs);
  seconds_.locomotion += watch.lap();
}

void Evaluator::Implementation::simulate(std::span<const Run> runs, int generation,
                                         Outcomes& outcomes) const {
  std::vector<core::Body> displaced(runs.size());
  std::vector<core::LocomotionTask> tasks(runs.size());
  parallel_for<Schedule::dynamic>(runs.size(), threads_, [&](std::size_t n) {
    const auto& [task, body, trial, start] = runs[n];
    tasks[n] = {body, task.scene};
    if (!is_displaced(*trial, start)) return;
    displaced[n] = start_of(*body, *trial, start, rules_.seed, generation);
    tasks[n].body = &displaced[n];
  });
  const core::LocomotionOptions options{rules_.precision, rules_.method, threads_};
  const std::vector<core::Outcome> computed = core::simulate(tasks, options);
  for (std::size_t n = 0; n < runs.size(); ++n) outcomes.emplace(runs[n].task, computed[n]);
}

Evaluator::Evaluator(EvaluationRules rules, int threads, CheckedLinks* checked)
    : implementation_(std::make_unique<Implementation>(std::move(rules), threads, checked)) {}

Evaluator::~Evaluator() = default;

std::vector<Evaluated> Evaluator::evaluate(std::span<const core::Network> networks,
                                           const std::vector<std::uint8_t>& run_trial,
                                           int generation) {
  std::vector<std::vector<core::Network>> lives;
  for (const core::Network& network : networks) lives.push_back({network});
  return implementation_->evaluate(lives, run_trial, generation);
}

std::vector<Evaluated> Evaluator::evaluate(Lives lives, const std::vector<std::uint8_t>& run_trial,
                                           int generation) {
  return implementation_->evaluate(lives, run_trial, generation);
}

Evaluated Evaluator::evaluate_fully(const core::Network& network, int generation) {
  return implementation_->evaluate_fully({network}, generation);
}

Evaluated Evaluator::evaluate_fully(const std::vector<core::Network>& life, int generation) {
  return implementation_->evaluate_fully(life, generation);
}

const EvaluationRules& Evaluator::rules() const { return implementation_->rules_; }
EvaluationWork Evaluator::work() const { return implementation_->work_; }
EvaluationSeconds Evaluator::seconds() const { return implementation_->seconds_; }

}  // namespace metamorph::evolve
