#include "evolve/genetics/species.h"

#include <algorithm>
#include <unordered_map>

#include "core/body/parallel_for.h"
#include "evolve/genetics/distance.h"

namespace metamorph::evolve {

std::vector<std::vector<int>> ranked_members(const PopulationState& state,
                                             std::span<const double> fitness) {
  std::unordered_map<int, std::size_t> position;
  for (std::size_t s = 0; s < state.species.size(); ++s) position[state.species[s].id] = s;
  std::vector<std::vector<int>> members(state.species.size());
  for (std::size_t i = 0; i < state.individuals.size(); ++i) {
    members[position.at(state.individuals[i].species)].push_back(static_cast<int>(i));
  }
  for (std::vector<int>& of_species : members) {
    std::sort(of_species.begin(), of_species.end(), [&](int a, int b) {
      const double of_a = fitness[static_cast<std::size_t>(a)];
      const double of_b = fitness[static_cast<std::size_t>(b)];
      return of_a != of_b ? of_a > of_b : a < b;
    });
  }
  return members;
}

void record_best(std::vector<Species>& species, const std::vector<std::vector<int>>& ranked,
                 std::span<const double> fitness, bool restart_records) {
  for (std::size_t s = 0; s < species.size(); ++s) {
    if (restart_records) species[s].best_ever = -1;
    const double best = fitness[static_cast<std::size_t>(ranked[s].front())];
    if (best > species[s].best_ever) {
      species[s].best_ever = best;
      species[s].stagnant = 0;
    } else {
      ++species[s].stagnant;
    }
  }
}

SpeciesRange species_range(const NeatSettings& settings) {
  const int most = settings.species_members == 0
                       ? settings.population
                       : std::max(1, settings.population / settings.species_members);
  return {std::min(settings.species_min, most), std::min(settings.species_max, most)};
}

double adapted_threshold(double threshold, int species, const NeatSettings& settings) {
  const auto [min, max] = species_range(settings);
  if (species < min) threshold -= settings.compatibility_step;
  if (species > max) threshold += settings.compatibility_step;
  return std::max(threshold, settings.compatibility_floor);
}

std::vector<int> place_in_species(PopulationState& state, const NeatSettings& settings,
                                  int threads) {
  const std::size_t old_species = state.species.size();
  const double threshold = state.compatibility_threshold;
  std::vector<LinkArrays> representatives;
  for (const Species& species : state.species) {
    representatives.push_back(link_arrays(species.representative));
  }
  std::vector<LinkArrays> links(state.genomes.size());
  std::vector<std::size_t> place(state.genomes.size());
  const auto first_fit = [&](std::size_t genome, std::size_t from) {
    for (std::size_t s = from; s < representatives.size(); ++s) {
      if (distance(links[genome], representatives[s], settings.weight_difference_factor,
                   threshold) < threshold) {
        return s;
      }
    }
    return representatives.size();
  };
  // Founders stand behind the species that were there before, so the old ones can be searched in
  // parallel and only what fits none of them has to take its turn.
  core::parallel_for<core::Schedule::equal>(state.genomes.size(), threads, [&](std::size_t genome) {
    links[genome] = link_arrays(state.genomes[genome]);
    place[genome] = first_fit(genome, 0);
  });
  for (std::size_t i = 0; i < state.genomes.size(); ++i) {
    if (place[i] == old_species) {
      place[i] = first_fit(i, old_species);
      if (place[i] == representatives.size()) {
        representatives.push_back(links[i]);
        Species founded;
        founded.id = state.next_species++;
        founded.representative = state.genomes[i];
        state.species.push_back(std::move(founded));
      }
    }
  }
  for (Species& species : state.species) species.size = 0;
  for (std::size_t i = 0; i < state.genomes.size(); ++i) {
    state.individuals[i].species = state.species[place[i]].id;
    ++state.species[place[i]].size;
  }
  std::vector<int> empty;
  for (const Species& species : state.species) {
    if (species.size == 0) empty.push_back(species.id);
  }
  std::erase_if(state.species, [](const Species& species) { return species.size == 0; });
  return empty;
}

}  // namespace metamorph::evolve
