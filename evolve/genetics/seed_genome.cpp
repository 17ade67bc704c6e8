#include "evolve/genetics/seed_genome.h"

#include <algorithm>

namespace metamorph::evolve {

double new_weight(const NeatSettings& settings, RandomStream& stream) {
  return std::clamp(settings.initial_weight * stream.triangular(), -settings.weight_limit,
                    settings.weight_limit);
}

Genome seed_genome(const NeatSettings& settings, RandomStream& stream, const ControlShape& shape) {
  Genome genome;
  const int nodes = first_hidden + settings.hidden_nodes;
  for (const core::Input input : shape.inputs) {
    genome.nodes.push_back({node_id(input), NodeKind::input});
  }
  for (const core::Output output : shape.outputs) {
    genome.nodes.push_back({node_id(output), NodeKind::output});
  }
  for (int id = first_hidden; id < nodes; ++id) genome.nodes.push_back({id, NodeKind::hidden});
  std::sort(genome.nodes.begin(), genome.nodes.end(),
            [](const NodeGene& a, const NodeGene& b) { return a.id < b.id; });
  const auto join = [&](int from, int to) {
    const int innovation = static_cast<int>(genome.links.size());
    genome.links.push_back({innovation, from, to, new_weight(settings, stream)});
  };
  for (const core::Input input : shape.inputs) {
    for (int hidden = first_hidden; hidden < nodes; ++hidden) join(node_id(input), hidden);
  }
  for (int hidden = first_hidden; hidden < nodes; ++hidden) {
    for (const core::Output output : shape.outputs) join(hidden, node_id(output));
  }
  for (const core::Output output : shape.outputs) join(bias_input, node_id(output));
  return genome;
}

}  // namespace metamorph::evolve
