#pragma once

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

}  // namespace metamorph::evolve
