#include "evolve/genetics/population.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "evolve/genetics/reproduction.h"
#include "evolve/genetics/species.h"
#include "metamorph/random.h"
#include "metamorph/variation.h"

namespace metamorph::evolve {

PopulationState first_generation(const NeatSettings& settings, std::uint64_t seed,
                                 const ControlShape& shape) {
  PopulationState state;
  state.seed = seed;
  state.compatibility_threshold = settings.compatibility_threshold;
  for (int i = 0; i < settings.population; ++i) {
    RandomStream stream(Purpose::initial_genome, seed, 0, static_cast<std::uint32_t>(i));
    state.genomes.push_back(seed_genome(settings, stream, shape));
    Individual individual;
    individual.id = state.next_individual++;
    state.individuals.push_back(individual);
  }
  state.next_innovation = static_cast<int>(state.genomes.front().links.size());
  state.next_node = first_hidden + settings.hidden_nodes;
  place_in_species(state, settings, 1);
  return state;
}

std::vector<EndedSpecies> next_generation(PopulationState& state, const NeatSettings& settings,
                                          std::span<const double> fitness, bool restart_records,
                                          int threads) {
  if (fitness.size() != state.genomes.size() ||
      std::any_of(fitness.begin(), fitness.end(),
                  [](double f) { return !(std::isfinite(f) && f >= 0); })) {
    throw std::invalid_argument("next_generation: one finite fitness >= 0 per genome expected");
  }
  const std::vector<std::vector<int>> ranked = ranked_members(state, fitness);
  record_best(state.species, ranked, fitness, restart_records);
  const std::vector<SpeciesPlan> plans = plan_reproduction(state, settings, fitness, ranked);
  std::vector<Child> children = breed(state, settings, fitness, plans, threads);

  Innovations innovations(state.next_innovation, state.next_node);
  std::vector<Individual> individuals;
  individuals.reserve(children.size());
  for (Child& child : children) {
    innovations.apply(child.change, settings, child.genome);
    const auto id_of = [&](int parent) {
      return parent < 0 ? -1 : state.individuals[static_cast<std::size_t>(parent)].id;
    };
    individuals.push_back(
        {state.next_individual++, id_of(child.parent_a), id_of(child.parent_b), -1, child.origin});
  }

  // A species that was given no child ends here; the others go on, represented by their champion.
  state.compatibility_threshold = adapted_threshold(
      state.compatibility_threshold, static_cast<int>(state.species.size()), settings);
  std::vector<Species> species;
  std::vector<EndedSpecies> ended;
  for (std::size_t s = 0; s < plans.size(); ++s) {
    Species& heir = state.species[s];
    if (plans[s].offspring == 0) {
      ended.push_back({heir.id, heir.stagnant >= settings.stagnation ? SpeciesEnd::stagnant
                                                                     : SpeciesEnd::outcompeted});
      continue;
    }
    heir.representative = state.genomes[static_cast<std::size_t>(ranked[s].front())];
    ++heir.age;
    species.push_back(std::move(heir));
  }
  state.species = std::move(species);
  state.individuals = std::move(individuals);
  state.genomes.resize(children.size());
  for (std::size_t c = 0; c < children.size(); ++c) {
    state.genomes[c] = std::move(children[c].genome);
  }
  ++state.generation;
  for (const int id : place_in_species(state, settings, threads)) {
    ended.push_back({id, SpeciesEnd::absorbed});
  }
  std::sort(ended.begin(), ended.end(),
            [](const EndedSpecies& a, const EndedSpecies& b) { return a.id < b.id; });
  return ended;
}

}  // namespace metamorph::evolve
