#include "metamorph/variation.h"

#include <algorithm>
#include <utility>

namespace metamorph::evolve {

double new_weight(const NeatSettings& settings, RandomStream& stream) {
  return std::clamp(settings.initial_weight * stream.triangular(), -settings.weight_limit,
                    settings.weight_limit);
}

std::vector<Stages> possible_stages(const NeatSettings& settings) {
  std::vector<Stages> all;
  if (settings.separation != Separation::full) all.push_back({});
  if (settings.separation == Separation::partial) {
    for (int k = 1; k < settings.stages; ++k) all.push_back({k, Stages::end_of_life});
    for (int k = 0; k + 1 < settings.stages; ++k) all.push_back({0, k});
  }
  if (settings.separation == Separation::full) {
    for (int k = 0; k < settings.stages; ++k) all.push_back({k, k});
  }
  return all;
}

Genome seed_genome(const NeatSettings& settings, RandomStream& stream, const ControlShape& shape) {
  Genome genome;
  const int nodes = first_hidden + settings.hidden_nodes;
  for (const int input : shape.inputs) genome.nodes.push_back({input, NodeKind::input});
  for (const int output : shape.outputs) genome.nodes.push_back({output, NodeKind::output});
  for (int id = first_hidden; id < nodes; ++id) genome.nodes.push_back({id, NodeKind::hidden});
  std::sort(genome.nodes.begin(), genome.nodes.end(),
            [](const NodeGene& a, const NodeGene& b) { return a.id < b.id; });
  const auto join = [&](int from, int to) {
    const int innovation = static_cast<int>(genome.links.size());
    genome.links.push_back({innovation, from, to, new_weight(settings, stream)});
  };
  const bool layered = settings.hidden_nodes > 0;
  for (const int input : shape.inputs) {
    for (int hidden = first_hidden; hidden < nodes; ++hidden) join(input, hidden);
    if (layered || input == bias_input) continue;
    for (const int output : shape.outputs) join(input, output);
  }
  for (int hidden = first_hidden; hidden < nodes; ++hidden) {
    for (const int output : shape.outputs) join(hidden, output);
  }
  for (const int output : shape.outputs) join(bias_input, output);
  if (settings.separation == Separation::full) {
    const std::vector<LinkGene> of_one_stage = std::move(genome.links);
    genome.links.clear();
    for (const Stages& stages : possible_stages(settings)) {
      for (LinkGene link : of_one_stage) {
        link.innovation = static_cast<int>(genome.links.size());
        link.stages = stages;
        genome.links.push_back(link);
      }
    }
  }
  return genome;
}

}  // namespace metamorph::evolve
