#include "evolve/genetics/genome.h"

#include <algorithm>
#include <map>

namespace metamorph::evolve {

core::Network compile(const Genome& genome) {
  // Incoming links of every computed node, in order of innovation.
  std::map<int, std::vector<const LinkGene*>> incoming;
  std::map<int, int> slot;  // node id -> value slot, once it has one
  for (const NodeGene& node : genome.nodes) {
    if (node.kind == NodeKind::input) {
      slot[node.id] = node.id;
    } else {
      incoming[node.id];
    }
  }
  for (const LinkGene& link : genome.links) incoming[link.to].push_back(&link);

  core::Network network;
  // Repeatedly take the lowest id whose sources all have a slot. The genome has no cycle, so every
  // round takes at least one.
  while (!incoming.empty()) {
    const auto ready = std::find_if(incoming.begin(), incoming.end(), [&](const auto& entry) {
      return std::all_of(entry.second.begin(), entry.second.end(),
                         [&](const LinkGene* link) { return slot.contains(link->from); });
    });
    for (const LinkGene* link : ready->second) {
      network.source.push_back(slot.at(link->from));
      network.weight.push_back(static_cast<float>(link->weight));
    }
    slot[ready->first] = core::network_inputs + network.node_count();
    network.first_link.push_back(static_cast<int>(network.source.size()));
    incoming.erase(ready);
  }
  for (int o = 0; o < core::network_outputs; ++o) {
    network.output[static_cast<std::size_t>(o)] = slot.at(core::network_inputs + o);
  }
  return network;
}

}  // namespace metamorph::evolve
