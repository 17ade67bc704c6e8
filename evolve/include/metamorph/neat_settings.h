#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "metamorph/named.h"

namespace metamorph::evolve {

/// How far the stages of life have genes of their own. none: every link is expressed in all of
/// them; partial: at first, and mutations confine links to the stages from one on or up to one;
/// full: every link belongs to one stage.
enum class Separation { none, partial, full };
inline constexpr std::array separation_names = {
    core::Named<Separation>{Separation::none, "none"},
    core::Named<Separation>{Separation::partial, "partial"},
    core::Named<Separation>{Separation::full, "full"}};

/// Settings of NEAT (MODEL section 5). Initially the preset "standard" (bench/SEARCH.md).
struct NeatSettings {
  int population = 300;
  int hidden_nodes = 8;
  double initial_weight = 2.0;
  int species_min = 15;
  int species_max = 15;
  int species_members = 5;
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
  double mutate_weights = 0.75;
  double add_link = 0.07;
  double add_node = 0.01;
  double remove_link = 0.01;
  double move_gene = 0.07;
  Separation separation = Separation::none;
  double severe = 0.05;
  double redrawn_share = 1;
  double weight_change = 1.0;
  double moved_share = 0;
  double weight_limit = 8.0;
  double node_weight = 2;
  double fitness_floor = 1e-4;
  int clone_tries = 10;
  int stages = 1;  ///< of life; no key: the problem says it
};

/// Upper end of the ranges of settings that have no natural one.
inline constexpr double no_limit = 1e9;

/// One setting of NEAT.
struct NeatField {
  std::string_view name;  ///< of the member, and of the key that sets it in experiments
  std::variant<int NeatSettings::*, double NeatSettings::*, Separation NeatSettings::*> member;
  double paper;      ///< what the paper's search has; of a choice its value as a number
  double low, high;  ///< both ends included
  std::string_view meaning;
};

/// The one list of them: keys of experiments, their check, and the paper's values.
inline constexpr std::array neat_fields = [] {
  using N = NeatSettings;
  return std::array{
      NeatField{"population", &N::population, 300, 1, 1e6, "individuals per generation"},
      NeatField{"hidden_nodes", &N::hidden_nodes, 8, 0, 1e4, "hidden nodes of the first genomes"},
      NeatField{"initial_weight", &N::initial_weight, 2, 0, 1e6,
                "first weights are triangular up to this"},
      NeatField{"species_min", &N::species_min, 5, 1, 1e6, "fewer species: the threshold falls"},
      NeatField{"species_max", &N::species_max, 30, 1, 1e6,
                "more species: the threshold rises; both the same: it steers to that number"},
      NeatField{"species_members", &N::species_members, 0, 0, 1e6,
                "bounds both by population / this; 0: no bound"},
      NeatField{"compatibility_threshold", &N::compatibility_threshold, 5, 0, 1e6,
                "of species, at first"},
      NeatField{"compatibility_step", &N::compatibility_step, 0.2, 0, 1e6,
                "its change per generation"},
      NeatField{"compatibility_floor", &N::compatibility_floor, 0.2, 0, 1e6, "its lowest value"},
      NeatField{"weight_difference_factor", &N::weight_difference_factor, 1.5, 0, 1e6,
                "weight of the mean weight difference in the distance"},
      NeatField{"young_age", &N::young_age, 5, 0, no_limit, "species below this age get the bonus"},
      NeatField{"young_bonus", &N::young_bonus, 1.1, 0, 1e6,
                "factor on the fitness of young species"},
      NeatField{"old_age", &N::old_age, 30, 0, no_limit,
                "species above this age get the old factor"},
      NeatField{"old_factor", &N::old_factor, 1, 0, 1e6, "factor on the fitness of old species"},
      NeatField{"stagnation", &N::stagnation, 50, 1, no_limit, "generations without a new best"},
      NeatField{"stagnation_factor", &N::stagnation_factor, 1e-7, 0, 1,
                "factor on the fitness after those"},
      NeatField{"survival_share", &N::survival_share, 0.25, 0, 1,
                "share of a species that may be parents"},
      NeatField{"crossover", &N::crossover, 0.75, 0, 1, "probability of two parents"},
      NeatField{"mutation_after_crossover", &N::mutation_after_crossover, 0.25, 0, 1,
                "probability"},
      NeatField{"interspecies_crossover", &N::interspecies_crossover, 0.0001, 0, 1, "probability"},
      NeatField{"multipoint", &N::multipoint, 0.75, 0, 1,
                "probability of multipoint, else averaging"},
      NeatField{"mutate_weights", &N::mutate_weights, 0.75, 0, 1e6,
                "rate in the mutation roulette"},
      NeatField{"add_link", &N::add_link, 0.07, 0, 1e6, "rate in the mutation roulette"},
      NeatField{"add_node", &N::add_node, 0.01, 0, 1e6, "rate in the mutation roulette"},
      NeatField{"remove_link", &N::remove_link, 0.01, 0, 1e6, "rate in the mutation roulette"},
      NeatField{"move_gene", &N::move_gene, 0, 0, 1e6,
                "rate in the mutation roulette, with partial separation: a link is expressed in "
                "other stages"},
      NeatField{"separation", &N::separation, 0, 0, 2,
                "genes of one's own for the stages of life: partial lets evolution confine links "
                "to some, full gives every stage its own from the start"},
      NeatField{"severe", &N::severe, 0.25, 0, 1,
                "share of weight mutations that redraw weights instead of moving them"},
      NeatField{"redrawn_share", &N::redrawn_share, 1, 0, 1,
                "least share of the links that these redraw; see moved_share"},
      NeatField{"weight_change", &N::weight_change, 1, 0, 1e6, "largest change of a weight"},
      NeatField{"moved_share", &N::moved_share, 1, 0, 1,
                "least share of the links that a weight mutation moves: each time a share is drawn "
                "log-uniformly between it and 1; 0: from one link on"},
      NeatField{"weight_limit", &N::weight_limit, 8, 1e-6, 1000, "largest absolute weight"},
      NeatField{"node_weight", &N::node_weight, 1, 0, 1e6,
                "weight of the link into an added node; 2 keeps small signals as they were"},
      NeatField{"fitness_floor", &N::fitness_floor, 1e-4, 0, 1e6, "least fitness before sharing"},
      NeatField{"clone_tries", &N::clone_tries, 10, 0, 1e6,
                "times a child identical to an earlier one is bred again, at most"}};
}();

/// NEAT as the paper has it.
NeatSettings paper_neat_settings();

}  // namespace metamorph::evolve
