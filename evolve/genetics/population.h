#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolve/genetics/genome.h"

namespace metamorph::evolve {

/// Settings of NEAT (MODEL section 5). Every number is a configuration entry.
struct NeatSettings {
  int population = 300;
  int hidden_nodes = 8;         ///< of the seed genome
  double initial_weight = 2.0;  ///< weights start triangular on [-this, this]
  int species_min = 5;          ///< below: the threshold falls
  int species_max = 30;         ///< above: the threshold rises
  double compatibility_threshold = 5.0;
  double compatibility_step = 0.2;
  double compatibility_floor = 0.2;
  double weight_difference_factor = 1.5;
  int young_age = 5;
  double young_bonus = 1.1;
  int old_age = 30;
  double old_factor = 1.0;
  int stagnation = 50;
  double stagnation_factor = 1e-7;
  double survival_share = 0.25;
  double crossover = 0.75;
  double mutation_after_crossover = 0.25;
  double interspecies_crossover = 0.0001;
  double multipoint = 0.75;
  double mutate_weights = 0.75;  ///< the four rates of the mutation roulette
  double add_link = 0.07;
  double add_node = 0.01;
  double remove_link = 0.01;
  double severe = 0.25;
  double weight_change = 1.0;
  double weight_limit = 8.0;
  double fitness_floor = 1e-4;
  int clone_tries = 10;  ///< times a child identical to an earlier one is bred again, at most
};

/// Who an individual is. Parent -1: none (generation 0); both equal -1 or second -1: asexual.
struct Individual {
  std::int64_t id = 0;  ///< counts individuals ever bred in the run
  std::int64_t parent_a = -1, parent_b = -1;
  int species = -1;  ///< id of the species it was placed in
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
/// a copy. Children stand in order of species, each species' champion first.
void next_generation(PopulationState& state, const NeatSettings& settings,
                     std::span<const double> fitness, bool restart_records, int threads);

}  // namespace metamorph::evolve
