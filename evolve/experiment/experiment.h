#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "evolve/genetics/population.h"
#include "evolve/search/search.h"
#include "metamorph/development.h"
#include "metamorph/locomotion.h"
#include "metamorph/scene.h"

namespace metamorph::evolve {

/// How the outcomes of a trial's starts become one (evolve/run/starts.h).
enum class StartsCombine { mean, median, least };

/// One evaluation of an individual: the body it has at a stage of development, in one scene, from
/// one start or from several a hair apart. On land a gait may have several outcomes, and which one
/// comes is decided by how the body happened to come to rest: of many bodies run once, a search
/// keeps those that were lucky.
struct Trial {
  std::string name;                  ///< larva, adult, swim, walk, ...
  int stage = 600;                   ///< development step at which the body is taken
  std::string scene;                 ///< name of one of the experiment's scenes
  int starts = 1;                    ///< times the body is run
  double start_displacement = 1e-3;  ///< d, of every node, in x and in y, at most
  StartsCombine starts_combine = StartsCombine::mean;
  bool starts_renew = false;  ///< every generation has other starts: what lives on tries again
};

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

/// An experiment as data (MODEL section 7): everything that decides the outcome of a run.
struct Experiment {
  std::string name;
  int generations = 2000;
  std::uint64_t seed = 1;
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
};

}  // namespace metamorph::evolve
