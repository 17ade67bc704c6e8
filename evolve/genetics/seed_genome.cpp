#include "evolve/genetics/seed_genome.h"

#include <algorithm>

namespace metamorph::evolve {

double new_weight(const NeatSettings& settings, RandomStream& stream) {
  return std::clamp(settings.initial_weight * stream.triangular(), -settings.weight_limit,
                    settings.weight_limit);
}

Genome seed_genome(const NeatSettings& settings, RandomStream& stream) {
  Genome genome;
  const int nodes = first_hidden + settings.hidden_nodes;
  for (int id = 0; id < nodes; ++id) genome.nodes.push_back({id, kind_of(id)});
  const auto join = [&](int from, int to) {
    const int innovation = static_cast<int>(genome.links.size());
    genome.links.push_back({innovation, from, to, new_weight(settings, stream)});
  };
  for (int input = 0; input < core::network_inputs; ++input) {
    for (int hidden = first_hidden; hidden < nodes; ++hidden) join(input, hidden);
  }
  for (int hidden = first_hidden; hidden < nodes; ++hidden) {
    for (int output = core::network_inputs; output < first_hidden; ++output) join(hidden, output);
  }
  for (int output = core::network_inputs; output < first_hidden; ++output) join(bias_input, output);
  return genome;
}

}  // namespace metamorph::evolve
