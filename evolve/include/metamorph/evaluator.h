#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "metamorph/descriptors.h"
#include "metamorph/development.h"
#include "metamorph/evaluation.h"
#include "metamorph/locomotion.h"
#include "metamorph/named.h"
#include "metamorph/network.h"

namespace metamorph::evolve {

/// How the outcomes of a trial's starts become one.
enum class StartsCombine { mean, median, least };
inline constexpr std::array<core::Named<StartsCombine>, 3> starts_combine_names = {
    {{StartsCombine::mean, "mean"},
     {StartsCombine::median, "median"},
     {StartsCombine::least, "least"}}};
constexpr std::string_view name(StartsCombine rule) {
  for (const auto& entry : starts_combine_names) {
    if (entry.value == rule) return entry.name;
  }
  return "";
}

/// One evaluation of an individual: the body it has at a stage of development, in one scene, from
/// one start or from several a hair apart. On land a gait may have several outcomes, and which one
/// comes is decided by how the body happened to come to rest: of many bodies run once, a search
/// keeps those that were lucky.
struct Trial {
  std::string name;                  ///< larva, adult, swim, walk, ...
  int stage = 600;                   ///< development step at which the body is taken
  std::string scene;                 ///< name of one of the scenes
  int starts = 1;                    ///< times the body is run
  double start_displacement = 1e-3;  ///< d, of every node, in x and in y, at most
  StartsCombine starts_combine = StartsCombine::mean;
  bool starts_renew = false;  ///< every generation has other starts: what lives on tries again
};

/// All that decides what becomes of a network.
struct EvaluationRules {
  core::DevelopmentRules development;
  int min_cells = 8;             ///< of a body; fewer are no body
  int created_limit = 1024;      ///< cells ever created; more cost fitness
  double created_penalty = 0.1;  ///< factor on the fitness of those above the limit
  core::Precision precision = core::Precision::float32;
  core::Method method = core::Method::drift_kick_drift;
  std::vector<core::Scene> scenes;  ///< those that trials name
  std::vector<Trial> trials;        ///< in order of life
  std::uint64_t seed = 1;           ///< of displaced starts

  const core::Scene& scene_of(const Trial& trial) const;  ///< precondition: it exists
};

/// The embryo behind a trial: what figures 15 to 18 count. All zero if the trial was not run.
struct StageCounts {
  int cells = 0;    ///< alive at the stage end
  int created = 0;  ///< born up to then, founder included
  int died = 0;
};

/// All that is known of an individual after its evaluation.
struct Evaluated {
  std::vector<core::Outcome> trials;    ///< [trials]; of one that was not run: empty, distance 0
  std::vector<std::uint8_t> evaluated;  ///< [trials] 0: this trial was not run
  std::vector<StageCounts> stages;      ///< [trials]
  std::vector<TrialDescriptors> descriptors;  ///< [trials]
  int created = 1;  ///< cells ever created in all development that was run
  int died = 0;
  double penalty = 1;  ///< factor on the fitness for creating too many cells
};

/// The numbers that a search sees: the distance of every trial as objectives; as descriptors first
/// the final mean positions (x, y) of every trial, then what else describes it in every trial
/// (metamorph/descriptors.h), then the metamorphosis that led to every trial of a later stage than
/// the first. Descriptors are empty where a trial was not run, failed, or has no body.
Evaluation evaluation_of(const Evaluated& evaluated);
/// What those numbers are called: larva, larva.x, larva.cells, adult.growth, ...
Problem problem_of(const EvaluationRules& rules, int generations);

/// Where the seconds of an evaluation went; descriptors of bodies are taken as they are extracted.
struct EvaluationSeconds {
  double develop = 0, extract = 0, locomotion = 0;
  EvaluationSeconds& operator+=(const EvaluationSeconds& other);
  EvaluationSeconds operator-(const EvaluationSeconds& other) const;
};

/// What a check of links has compared: those of developments against those of full triangulations.
struct CheckedLinks {
  std::int64_t developments = 0, renewals = 0, links = 0;
};

/// How much of a generation was computed, and how much was known already. Every start counts.
struct EvaluationWork {
  std::int64_t individuals = 0;  ///< networks that were to be developed
  std::int64_t developed = 0;    ///< of them: developed
  std::int64_t bodies = 0;       ///< bodies that were to be simulated in a scene, from a start
  std::int64_t simulated = 0;    ///< of them: simulated
  EvaluationWork& operator+=(const EvaluationWork& other);
};

/// Evaluates generations: networks to embryos, bodies, outcomes, each step one batch. Knows no
/// genome.
///
/// Identical work is done once: of equal networks (copies, or genomes that differ in what does not
/// count) one is developed, of equal bodies in the same scene (networks may differ and grow the
/// same) one is simulated, and what the previous call computed is not computed again. As results
/// depend on network, body, scene and rules alone, this changes no bit of them. It is told by
/// fingerprints, and only the last call's are kept: less than 2 KB per individual of one start.
/// (Work that was done earlier than that comes back too seldom to be kept: 0.1 to 0.6 % of
/// locomotion in runs of 100 to 200 generations.)
///
/// A trial of several starts is as many such simulations, each of a displaced copy of the body and
/// known by that copy's fingerprint: starts that every generation has are known again, renewed ones
/// are not. Where a trial renews its starts the bodies are kept as well, some 60 KB per individual,
/// so that what lives on is moved again without being developed again.
///
/// What an evaluation throws (std::bad_alloc first of all) leaves on one thread whatever the number
/// of threads; the evaluator then knows less, and goes on with the same results.
class Evaluator {
 public:
  /// So many individuals are developed, and so many simulations prepared, at a time: enough to keep
  /// threads busy, and all the memory for embryos and bodies that a generation of any size takes.
  static constexpr std::size_t most_at_once = 4096;

  /// `threads` 0: all. With `checked` (borrowed) the links of every development are checked and
  /// counted there, and a difference is thrown as std::runtime_error.
  explicit Evaluator(EvaluationRules rules, int threads = 0, CheckedLinks* checked = nullptr);
  ~Evaluator();
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  /// Evaluates the trials t with run_trial[t] != 0 (at least one), and develops no further than
  /// they need; in order of the networks. The generation decides the starts of trials that renew
  /// them, and nothing else.
  std::vector<Evaluated> evaluate(std::span<const core::Network> networks,
                                  const std::vector<std::uint8_t>& run_trial, int generation);
  /// The same of individuals that have either one network, for all of life, or one for each of its
  /// stages: the distinct stages of the trials, ascending; networks[k] controls development up to
  /// the end of stage k.
  std::vector<Evaluated> evaluate(std::span<const std::vector<core::Network>> lives,
                                  const std::vector<std::uint8_t>& run_trial, int generation);

  /// All trials of one individual, as evaluate() has them in that generation.
  Evaluated evaluate_fully(const core::Network& network, int generation);
  Evaluated evaluate_fully(const std::vector<core::Network>& life, int generation);

  const EvaluationRules& rules() const;
  EvaluationWork work() const;        ///< of the last call of evaluate()
  EvaluationSeconds seconds() const;  ///< of all calls

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace metamorph::evolve
