#pragma once

#include <string>
#include <vector>

#include "metamorph/network.h"

namespace metamorph::evolve {

inline constexpr int bias_input = core::network_inputs - 1;
/// Hidden nodes have ids from here on; below are the inputs, then the outputs.
inline constexpr int first_hidden = core::network_inputs + core::network_outputs;

enum class NodeKind { input, output, hidden };

/// The kind that a node of this id has.
constexpr NodeKind kind_of(int id) {
  return id < core::network_inputs ? NodeKind::input
         : id < first_hidden       ? NodeKind::output
                                   : NodeKind::hidden;
}

struct NodeGene {
  int id = 0;
  NodeKind kind = NodeKind::hidden;
  bool operator==(const NodeGene&) const = default;
};

struct LinkGene {
  int innovation = 0;
  int from = 0;
  int to = 0;
  double weight = 0;
  bool operator==(const LinkGene&) const = default;
};

/// A NEAT genome. Node ids: inputs 0-5 (time, x, y, morphogen 1, morphogen 2, bias), outputs 6-12
/// (inhibit, angle, die, morphogen 1, morphogen 2, period, phase), hidden from 13 on.
/// Invariants: all inputs and outputs present; nodes ascending by id; links ascending by
/// innovation; no two links join the same pair; no cycle; no link into an input, none out of an
/// output; finite weights.
struct Genome {
  std::vector<NodeGene> nodes;
  std::vector<LinkGene> links;
  bool operator==(const Genome&) const = default;
};

/// Every violated invariant of a genome, one line each; empty for a sound one. Never fails,
/// whatever the genome holds.
std::vector<std::string> check(const Genome& genome);

/// Flattens a sound genome for inference in one topological sweep. Nodes are ordered by depth (the
/// most links on a path that ends there), ties by id; the links of a node are summed in order of
/// innovation. Hidden nodes from which no output can be reached are left out: they change nothing.
/// A hidden node without incoming links is 0.
core::Network compile(const Genome& genome);

}  // namespace metamorph::evolve
