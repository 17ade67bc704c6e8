#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "metamorph/genome.h"
#include "metamorph/named.h"
#include "metamorph/neat_settings.h"

namespace metamorph::evolve {

/// How an individual came to be: drawn for the first generation, a champion's copy, by crossover
/// alone, or by a mutation (after a crossover or not).
enum class Origin {
  first,
  copy,
  crossover,
  weights,
  redraw,
  add_link,
  add_node,
  remove_link,
  move_gene
};
inline constexpr std::array origin_names = {core::Named<Origin>{Origin::first, "first"},
                                            core::Named<Origin>{Origin::copy, "copy"},
                                            core::Named<Origin>{Origin::crossover, "crossover"},
                                            core::Named<Origin>{Origin::weights, "weights"},
                                            core::Named<Origin>{Origin::redraw, "redraw"},
                                            core::Named<Origin>{Origin::add_link, "add_link"},
                                            core::Named<Origin>{Origin::add_node, "add_node"},
                                            core::Named<Origin>{Origin::remove_link, "remove_link"},
                                            core::Named<Origin>{Origin::move_gene, "move_gene"}};

/// Who an individual is. Parent -1: none (generation 0); both equal -1 or second -1: asexual.
struct Individual {
  std::int64_t id = 0;  ///< counts individuals ever bred in the run
  std::int64_t parent_a = -1, parent_b = -1;
  int species = -1;  ///< id of the species it was placed in
  Origin origin = Origin::first;
  bool operator==(const Individual&) const = default;
};

struct Species {
  int id = 0;
  Genome representative;
  int age = 0;            ///< generations
  double best_ever = -1;  ///< highest fitness recorded
  int stagnant = 0;       ///< generations without a new best
  int size = 0;           ///< members in the present generation
  bool operator==(const Species&) const = default;
};

/// Why a species is no more: it stood still for too long, its share of the offspring rounded to
/// none, or all its children were placed elsewhere.
enum class SpeciesEnd { stagnant, outcompeted, absorbed };
inline constexpr std::array species_end_names = {
    core::Named<SpeciesEnd>{SpeciesEnd::stagnant, "stagnant"},
    core::Named<SpeciesEnd>{SpeciesEnd::outcompeted, "outcompeted"},
    core::Named<SpeciesEnd>{SpeciesEnd::absorbed, "absorbed"}};

struct EndedSpecies {
  int id = 0;
  SpeciesEnd why = SpeciesEnd::absorbed;
  bool operator==(const EndedSpecies&) const = default;
};

/// Everything that decides how a run goes on: plain data, so that a checkpoint holds all of it.
struct PopulationState {
  std::uint64_t seed = 0;
  int generation = 0;
  std::vector<Genome> genomes;          ///< [population]
  std::vector<Individual> individuals;  ///< [population]
  std::vector<Species> species;         ///< every species with a member
  std::int64_t next_individual = 0;
  int next_species = 0;
  int next_innovation = 0;
  int next_node = 0;
  double compatibility_threshold = 0;
  bool operator==(const PopulationState&) const = default;
};

/// Generation 0: the seed topology with random weights, already placed in species.
PopulationState first_generation(const NeatSettings& settings, std::uint64_t seed,
                                 const ControlShape& shape = {});

/// Breeds the next generation in place: records the fitness of the present one in its species,
/// breeds exactly settings.population children, places them in species. `fitness` finite and >= 0,
/// one per genome (std::invalid_argument otherwise). `restart_records`: every species forgets its
/// best fitness first (progressive search while its weight changes). The result depends on the
/// arguments alone; the same bits for any thread count. The fittest individual always lives on as
/// a copy. Children stand in order of species, each species' champion first. Returns the species
/// that this ended, ascending.
std::vector<EndedSpecies> next_generation(PopulationState& state, const NeatSettings& settings,
                                          std::span<const double> fitness, bool restart_records,
                                          int threads);

}  // namespace metamorph::evolve
