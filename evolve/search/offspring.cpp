#include "evolve/search/offspring.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "evolve/genetics/reproduction.h"
#include "evolve/search/population_json.h"
#include "metamorph/random.h"

namespace metamorph::evolve {

Brood first_brood(const SearchSetup& setup) {
  PopulationState state = first_generation(setup.neat, setup.problem.seed, setup.shape);
  state.species.clear();
  state.next_species = 0;
  for (Individual& individual : state.individuals) individual.species = -1;
  return {std::move(state), std::vector<double>(state.genomes.size(), -1.0)};
}

void breed_from(std::span<const Parent> parents, const ParentChoice& choose,
                const NeatSettings& settings, int threads, Brood& brood) {
  PopulationState& state = brood.state;
  const auto mate = [&](std::size_t p) {
    return Mate{*parents[p].genome, parents[p].quality, static_cast<int>(p)};
  };
  // Draws from streams of its own, so that a child depends on its index and attempt alone.
  const auto child = [&](int index, int attempt) {
    const std::uint32_t key =
        static_cast<std::uint32_t>(attempt) * static_cast<std::uint32_t>(settings.population) +
        static_cast<std::uint32_t>(index);
    const auto stream = [&](Purpose purpose) {
      return RandomStream(purpose, state.seed, static_cast<std::uint32_t>(state.generation), key);
    };
    RandomStream choice = stream(Purpose::parent_choice);
    const std::size_t first = choose(choice);
    const std::size_t second = choice.chance(settings.crossover) ? choose(choice) : first;
    const Mate a = mate(first), b = mate(second);
    return child_of(a, second == first ? nullptr : &b, settings, stream(Purpose::crossover),
                    stream(Purpose::mutation));
  };
  std::vector<const Genome*> living;
  for (const Parent& parent : parents) living.push_back(parent.genome);
  std::vector<Child> children = breed_distinct(
      settings.population, settings.clone_tries, threads, child, [](int) { return false; }, living);

  Innovations innovations(state.next_innovation, state.next_node);
  std::vector<Individual> individuals;
  brood.parents.clear();
  for (Child& bred : children) {
    innovations.apply(bred.change, settings, bred.genome);
    const auto id_of = [&](int parent) {
      return parent < 0 ? -1 : parents[static_cast<std::size_t>(parent)].id;
    };
    individuals.push_back(
        {state.next_individual++, id_of(bred.parent_a), id_of(bred.parent_b), -1, bred.origin});
    const auto quality_of = [&](int parent) {
      return parent < 0 ? -1 : parents[static_cast<std::size_t>(parent)].quality;
    };
    brood.parents.push_back(std::max(quality_of(bred.parent_a), quality_of(bred.parent_b)));
  }
  state.individuals = std::move(individuals);
  state.genomes.resize(children.size());
  for (std::size_t c = 0; c < children.size(); ++c) {
    state.genomes[c] = std::move(children[c].genome);
  }
  ++state.generation;
}

Asked asked_of(const Brood& brood, const Problem& problem) {
  Asked asked;
  asked.generation = brood.state.generation;
  asked.genomes = brood.state.genomes;
  for (const Individual& individual : brood.state.individuals) {
    asked.lineage.push_back({individual.id, individual.parent_a, individual.parent_b});
  }
  asked.measured.assign(problem.objectives.size(), 1);
  return asked;
}

void check_told(std::span<const Evaluation> evaluations, std::size_t individuals,
                const Problem& problem) {
  const bool fit =
      evaluations.size() == individuals &&
      std::all_of(evaluations.begin(), evaluations.end(), [&](const Evaluation& e) {
        return e.objectives.size() == problem.objectives.size() &&
               (e.descriptors.empty() || e.descriptors.size() == problem.descriptors.size());
      });
  if (!fit) {
    throw std::invalid_argument(
        "tell: expected one evaluation per genome, each with the problem's objectives, and its "
        "descriptors or none");
  }
}

nlohmann::json to_json(const Brood& brood) {
  const auto& [state, parents] = brood;
  return {{"state", to_json(state)}, {"parents", parents}};
}

Brood brood_of(const nlohmann::json& json, const NeatSettings& settings, const Problem& problem) {
  Brood brood;
  auto& [state, parents] = brood;
  state = population_of(json.at("state"));
  json.at("parents").get_to(parents);
  const auto expected = static_cast<std::size_t>(settings.population);
  if (state.genomes.size() != expected || state.individuals.size() != expected ||
      parents.size() != expected || state.seed != problem.seed) {
    throw std::runtime_error("expected population " + std::to_string(expected) + ", seed " +
                             std::to_string(problem.seed));
  }
  return brood;
}

}  // namespace metamorph::evolve
