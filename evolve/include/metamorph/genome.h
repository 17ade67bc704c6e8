#pragma once

#include <compare>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "metamorph/control_shape.h"
#include "metamorph/network.h"

namespace metamorph::evolve {

enum class NodeKind { input, output, hidden };

/// The kind that a node of this id has; none if no signal has the id.
std::optional<NodeKind> kind_of(int id);

struct NodeGene {
  int id = 0;
  NodeKind kind = NodeKind::hidden;
  bool operator==(const NodeGene&) const = default;
};

/// The stages of life in which a gene is expressed, first to last, counted from 0; initially all.
/// An interval: a hormone may switch a gene on, and another one switch it off for good.
struct Stages {
  static constexpr int end_of_life = std::numeric_limits<int>::max();
  int first = 0;
  int last = end_of_life;

  bool contains(int stage) const { return first <= stage && stage <= last; }
  bool overlaps(const Stages& other) const { return first <= other.last && other.first <= last; }
  auto operator<=>(const Stages&) const = default;
};

struct LinkGene {
  int innovation = 0;
  int from = 0;
  int to = 0;
  double weight = 0;
  Stages stages = {};
  bool operator==(const LinkGene&) const = default;
};

/// A NEAT genome. Nodes of inputs and outputs have the ids of control_shape.h, hidden ones count
/// from first_hidden on. Which inputs and outputs it has is its own affair; one that it lacks is as
/// good as one without links.
/// Invariants: nodes ascending by id, of the kind that the id says, at least one input and one
/// output; links ascending by innovation; no two links expressed in the same stage join the same
/// pair; no cycle, whatever the stages of its links (so that no change of their stages can close
/// one); no link into an input, none out of an output; finite weights.
struct Genome {
  std::vector<NodeGene> nodes;
  std::vector<LinkGene> links;
  bool operator==(const Genome&) const = default;
};

/// Every violated invariant of a genome, one line each; empty for a sound one. Never fails,
/// whatever the genome holds.
std::vector<std::string> check(const Genome& genome);

/// Whether some gene is not expressed in all stages of life.
bool is_separated(const Genome& genome);

/// What a genome has that a control network of this shape cannot have, one line for inputs and one
/// for outputs: what they are and what was expected. Empty if it fits.
std::vector<std::string> misfits(const Genome& genome, const ControlShape& shape);

/// Flattens a sound genome that fits a shape and is not separated for inference in one topological
/// sweep. Nodes are ordered by depth (the most links on a path that ends there), ties by id; the
/// links of a node are summed in order of innovation. Hidden nodes from which no output can be
/// reached are left out: they change nothing. A hidden node without incoming links is 0, and so is
/// an output that the genome lacks; an input that it lacks is read by nobody. Throws
/// std::invalid_argument for a cycle, a link without an end, a genome that does not fit, and for
/// one that is separated.
core::Network compile(const Genome& genome, const ControlShape& shape = {});

/// The networks of a genome in so many stages of life, the first one first: each of the genes that
/// are expressed in it. Of a genome that is not separated a single one, for all of life.
std::vector<core::Network> compile_stages(const Genome& genome, const ControlShape& shape,
                                          int stages);

}  // namespace metamorph::evolve
