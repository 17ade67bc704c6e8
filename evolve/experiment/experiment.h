#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evolve/genetics/population.h"
#include "metamorph/development.h"
#include "metamorph/evaluator.h"
#include "metamorph/locomotion.h"
#include "metamorph/named.h"
#include "metamorph/scene.h"
#include "metamorph/searches.h"

namespace metamorph::evolve {

/// A scene of an experiment: one of the four environments with some coefficients replaced. The
/// scene's own name is the name trials call it by.
struct NamedScene {
  std::string base = "water";  ///< water, land, land-right or slope
  core::Scene scene;
};

/// How bodies move, apart from their scene.
struct LocomotionSettings {
  core::Precision precision = core::Precision::float32;
  core::Method method = core::Method::drift_kick_drift;
};

/// What the settings of a search start from, before a file changes some: gentle mutation and
/// lasting species (bench/SEARCH.md), or what the paper has.
enum class Preset { standard, paper };
inline constexpr std::array preset_names = {core::Named<Preset>{Preset::standard, "standard"},
                                            core::Named<Preset>{Preset::paper, "paper"}};

/// An experiment as data (MODEL section 7): everything that decides the outcome of a run.
struct Experiment {
  std::string name;
  int generations = 2000;
  std::uint64_t seed = 1;
  Preset preset = Preset::standard;
  core::DevelopmentRules development;
  int created_limit = 1024;      ///< cells ever created; more cost fitness
  double created_penalty = 0.1;  ///< factor on the fitness of those above the limit
  int min_cells = 8;             ///< of a body; fewer are no body
  LocomotionSettings locomotion;
  SearchSettings search;
  NeatSettings neat;
  std::vector<NamedScene> scenes;  ///< every scene used by a trial, no other
  std::vector<Trial> trials;

  const core::Scene& scene_of(const Trial& trial) const;  ///< precondition: it exists
  std::vector<int> stages() const;  ///< the distinct stages of the trials, ascending
  /// The steps at which the later stages of life begin: all stages but the last, ascending.
  std::vector<int> metamorphoses() const;
};

/// Sets the preset and every setting of the search as it has them.
void apply(Preset preset, Experiment& experiment);

/// The networks of a genome in the stages of life that the experiment has; a single one if they are
/// the same in all.
std::vector<core::Network> networks_of(const Experiment& experiment, const Genome& genome);
/// The genome's embryos at these steps (ascending), as the experiment develops them.
std::vector<core::Embryo> embryos_of(const Experiment& experiment, const Genome& genome,
                                     std::span<const int> steps);

/// The part that an evaluator has to know.
EvaluationRules rules_of(const Experiment& experiment);
/// The part that a search has to know. `threads` 0: all.
SearchSetup search_setup_of(const Experiment& experiment, int threads);

}  // namespace metamorph::evolve
