#include <cstddef>
#include <string>

#include "metamorph/development.h"

namespace metamorph::core {
namespace {

template <class Signal>
std::string listed(const std::vector<Signal>& signals) {
  std::string text;
  for (const Signal signal : signals) {
    if (!text.empty()) text += ", ";
    text += name(signal);
  }
  return text;
}

}  // namespace

std::string check(const Network& network, const DevelopmentRules& rules) {
  const auto text = [](auto number) { return std::to_string(number); };
  if (network.inputs != static_cast<int>(rules.inputs.size())) {
    return "inputs: " + text(network.inputs) + ": expected " + text(rules.inputs.size()) + " (" +
           listed(rules.inputs) + ")";
  }
  if (network.output.size() != rules.outputs.size()) {
    return "output: " + text(network.output.size()) + " slots: expected " +
           text(rules.outputs.size()) + " (" + listed(rules.outputs) + ")";
  }
  const std::size_t links = network.source.size();
  if (network.first_link.empty() || network.first_link.front() != 0 ||
      network.first_link.back() < 0 ||
      static_cast<std::size_t>(network.first_link.back()) != links) {
    return "first_link: expected to go from 0 to the number of links, " + text(links);
  }
  if (network.weight.size() != links) {
    return "weight: " + text(network.weight.size()) + " values: expected one for each of " +
           text(links) + " links";
  }
  for (int n = 0; n < network.node_count(); ++n) {
    const auto node = static_cast<std::size_t>(n);
    const int first = network.first_link[node], end = network.first_link[node + 1];
    if (end < first || static_cast<std::size_t>(end) > links) {
      return "first_link[" + text(n + 1) + "]: " + text(end) + ": expected from " + text(first) +
             " to " + text(links);
    }
    for (int l = first; l < end; ++l) {
      const int source = network.source[static_cast<std::size_t>(l)];
      if (source >= 0 && source < network.inputs + n) continue;
      return "source[" + text(l) + "]: " + text(source) + ": expected an input or an earlier node" +
             " of node " + text(n) + ", below " + text(network.inputs + n);
    }
  }
  for (std::size_t o = 0; o < network.output.size(); ++o) {
    const int slot = network.output[o];
    if (slot >= 0 && slot < network.inputs + network.node_count()) continue;
    return "output[" + text(o) + "]: " + text(slot) + ": expected a slot below " +
           text(network.inputs + network.node_count());
  }
  return {};
}

}  // namespace metamorph::core
