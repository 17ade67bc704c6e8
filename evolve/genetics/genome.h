#pragma once

#include <vector>

#include "core/network.h"

namespace metamorph::evolve {

enum class NodeKind { input, output, hidden };

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
/// Invariants: nodes ascending by id; links ascending by innovation; no two links join the same
/// pair; no cycle; no link into an input, none out of an output.
struct Genome {
  std::vector<NodeGene> nodes;
  std::vector<LinkGene> links;
  bool operator==(const Genome&) const = default;
};

/// Flattens a genome for inference. Hidden nodes and outputs are ordered topologically, ties by id;
/// the links of a node are summed in order of innovation.
core::Network compile(const Genome& genome);

}  // namespace metamorph::evolve
