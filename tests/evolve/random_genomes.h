#pragma once

#include <cstdint>
#include <vector>

#include "evolve/genetics/population.h"
#include "metamorph/random.h"
#include "metamorph/variation.h"

namespace metamorph::evolve::testing {

inline evolve::RandomStream test_stream(std::uint32_t index) {
  return evolve::RandomStream(evolve::Purpose::test, 2016, 0, index);
}

/// Settings under which structure changes as often as weights.
inline NeatSettings restless() {
  NeatSettings settings;
  settings.mutate_weights = settings.add_link = settings.add_node = settings.remove_link = 1;
  return settings;
}

/// `count` genomes after `rounds` rounds in which each is mutated, every third after a crossover
/// with another one; calls visit(genome) for each in every round.
template <class Visit>
std::vector<Genome> wander(const NeatSettings& settings, int count, int rounds, std::uint32_t index,
                           Visit visit, const ControlShape& shape = {}) {
  evolve::RandomStream stream = test_stream(index);
  std::vector<Genome> genomes;
  for (int i = 0; i < count; ++i) genomes.push_back(seed_genome(settings, stream, shape));
  int next_innovation = static_cast<int>(genomes.front().links.size());
  int next_node = first_hidden + settings.hidden_nodes;
  for (int round = 0; round < rounds; ++round) {
    Innovations innovations(next_innovation, next_node);
    const std::vector<Genome> parents = genomes;
    for (std::size_t i = 0; i < genomes.size(); ++i) {
      if (stream.below(3) == 0) {
        const std::size_t mate = stream.below(static_cast<std::uint32_t>(count));
        genomes[i] = cross(parents[i], parents[mate], stream.chance(0.5), stream);
      }
      StructuralChange change;
      mutate(genomes[i], change, settings, stream);
      innovations.apply(change, settings, genomes[i]);
      visit(genomes[i]);
    }
  }
  return genomes;
}

inline std::vector<Genome> wander(const NeatSettings& settings, int count, int rounds,
                                  std::uint32_t index) {
  return wander(settings, count, rounds, index, [](const Genome&) {});
}

/// The paper's signals and the neighbours.
inline ControlShape with_neighbours() {
  ControlShape shape;
  shape.inputs.push_back(node_id(core::Input::neighbours));
  return shape;
}

/// All inputs and outputs of the paper, the given hidden nodes, and the given links.
inline Genome hand_made(const std::vector<int>& hidden, std::vector<LinkGene> links) {
  Genome genome;
  for (int id = 0; id < first_hidden; ++id) genome.nodes.push_back({id, *kind_of(id)});
  for (const int id : hidden) genome.nodes.push_back({id, NodeKind::hidden});
  genome.links = std::move(links);
  return genome;
}

}  // namespace metamorph::evolve::testing
