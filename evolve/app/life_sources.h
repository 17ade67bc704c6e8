#pragma once

// What `film` and `replay` show: the lives of runs' champions, of genomes, of bodies.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "evolve/app/rules_options.h"
#include "evolve/life/life.h"

namespace metamorph::evolve {

struct LifeSources {
  std::vector<std::string> sources;  ///< runs, genome and body files
  std::vector<int> generations;      ///< of runs; empty: the best of all
  int every = 0;                     ///< of runs: the best of every n-th generation; 0: not so
  RulesOptions rules;                ///< of genomes and bodies
};

/// SOURCE..., --generations, --every-generation, --experiment, --set, --scene.
void add_life_sources(CLI::App& command, LifeSources& sources);

/// Makes the lives of all sources, in order, each with its heading, and hands over each before the
/// next is made. Throws InputError: a source that is no run, genome or body, a generation that is
/// not there, an option that says nothing of a source.
void each_life(const LifeSources& sources, const LifeOptions& options,
               const std::function<void(Life)>& receive);

}  // namespace metamorph::evolve
