#include "metamorph/genome.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace metamorph::evolve {

namespace {

std::string_view kind_name(NodeKind kind) {
  switch (kind) {
    case NodeKind::input:
      return "input";
    case NodeKind::output:
      return "output";
    case NodeKind::hidden:
      break;
  }
  return "hidden";
}

template <std::size_t Count>
bool contains(const std::array<int, Count>& ids, int id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

// Position of a node among the ascending ids, or -1.
int position(const Genome& genome, int id) {
  const auto at =
      std::lower_bound(genome.nodes.begin(), genome.nodes.end(), id,
                       [](const NodeGene& node, int wanted) { return node.id < wanted; });
  return at != genome.nodes.end() && at->id == id ? static_cast<int>(at - genome.nodes.begin())
                                                  : -1;
}

// The links as positions of nodes, grouped by the node they leave: those of node n are
// link[first[n]] .. link[first[n + 1] - 1], in order of innovation.
struct Adjacency {
  std::vector<int> from, to;  // [links], -1 where the end is missing
  std::vector<int> first;     // [nodes + 1]
  std::vector<int> link;      // [links]
};

Adjacency outgoing_links(const Genome& genome) {
  const std::size_t nodes = genome.nodes.size();
  Adjacency graph;
  graph.first.assign(nodes + 1, 0);
  graph.from.reserve(genome.links.size());
  graph.to.reserve(genome.links.size());
  for (const LinkGene& link : genome.links) {
    int from = position(genome, link.from);
    const int to = position(genome, link.to);
    if (to < 0) from = -1;
    graph.from.push_back(from);
    graph.to.push_back(to);
    if (from >= 0) ++graph.first[static_cast<std::size_t>(from) + 1];
  }
  for (std::size_t n = 0; n < nodes; ++n) graph.first[n + 1] += graph.first[n];
  graph.link.resize(static_cast<std::size_t>(graph.first[nodes]));
  std::vector<int> next(graph.first.begin(), graph.first.end() - 1);
  for (std::size_t l = 0; l < genome.links.size(); ++l) {
    if (graph.from[l] < 0) continue;
    graph.link[static_cast<std::size_t>(next[static_cast<std::size_t>(graph.from[l])]++)] =
        static_cast<int>(l);
  }
  return graph;
}

// One topological sweep: positions of nodes in an order in which every link points forward, and the
// depth of each. Nodes on or behind a cycle are missing from the order.
struct Sweep {
  std::vector<int> order;
  std::vector<int> depth;  // [nodes]
};

Sweep sweep(const Adjacency& graph) {
  const std::size_t nodes = graph.first.size() - 1;
  Sweep result;
  result.depth.assign(nodes, 0);
  std::vector<int> waiting(nodes, 0);
  for (std::size_t l = 0; l < graph.to.size(); ++l) {
    if (graph.from[l] >= 0) ++waiting[static_cast<std::size_t>(graph.to[l])];
  }
  result.order.reserve(nodes);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (waiting[n] == 0) result.order.push_back(static_cast<int>(n));
  }
  for (std::size_t done = 0; done < result.order.size(); ++done) {
    const std::size_t n = static_cast<std::size_t>(result.order[done]);
    for (int e = graph.first[n]; e < graph.first[n + 1]; ++e) {
      const std::size_t l = static_cast<std::size_t>(graph.link[static_cast<std::size_t>(e)]);
      const std::size_t to = static_cast<std::size_t>(graph.to[l]);
      result.depth[to] = std::max(result.depth[to], result.depth[n] + 1);
      if (--waiting[to] == 0) result.order.push_back(static_cast<int>(to));
    }
  }
  return result;
}

// What a person calls an input or output.
std::string signal_name(int id) {
  for (const auto& [signal, name, meaning] : core::input_signals) {
    if (node_id(signal) == id) return std::string(name);
  }
  for (const auto& [signal, name, meaning] : core::output_signals) {
    if (node_id(signal) == id) return std::string(name);
  }
  return id > first_free_output ? fmt::format("free input {}", first_free_input - id)
                                : fmt::format("free output {}", first_free_output - id);
}

// The paper's first, then in the order in which they came to be.
std::string names_of(std::vector<int> ids) {
  std::sort(ids.begin(), ids.end(), [](int a, int b) {
    return std::pair(a < 0, std::abs(a)) < std::pair(b < 0, std::abs(b));
  });
  std::vector<std::string> names;
  for (const int id : ids) names.push_back(signal_name(id));
  return fmt::format("{}", fmt::join(names, ", "));
}

// "inputs 0-5, -1 (neighbours), outputs 6-12, hidden from 13 on": the paper's in one range.
std::string known_ids() {
  const auto listed = [](std::string_view kind, const auto& signals, const auto& ids,
                         std::size_t of_paper) {
    std::string text = fmt::format("{} {}-{}", kind, ids[0], ids[of_paper - 1]);
    for (std::size_t i = of_paper; i < ids.size(); ++i) {
      text += fmt::format(", {} ({})", ids[i], signals[i].name);
    }
    return text;
  };
  return fmt::format(
      "{}, {}, free inputs {} to {}, free outputs {} to {}, hidden from {} on",
      listed("inputs", core::input_signals, input_ids, core::paper_inputs().size()),
      listed("outputs", core::output_signals, output_ids, core::paper_outputs().size()),
      first_free_input, first_free_output + 1, first_free_output, least_id, first_hidden);
}

void check_nodes(const Genome& genome, std::vector<std::string>& faults) {
  for (std::size_t n = 0; n < genome.nodes.size(); ++n) {
    const NodeGene& node = genome.nodes[n];
    if (const auto kind = kind_of(node.id); !kind) {
      faults.push_back(fmt::format("node {}: {} with this id is unknown: expected {}", node.id,
                                   kind_name(node.kind), known_ids()));
    } else if (node.kind != *kind) {
      faults.push_back(fmt::format("node {}: kind is {}: expected {}", node.id,
                                   kind_name(node.kind), known_ids()));
    }
    if (n > 0 && genome.nodes[n - 1].id >= node.id) {
      faults.push_back(fmt::format("node {}: follows node {}, but ids must ascend", node.id,
                                   genome.nodes[n - 1].id));
    }
  }
  for (const NodeKind kind : {NodeKind::input, NodeKind::output}) {
    if (std::none_of(genome.nodes.begin(), genome.nodes.end(),
                     [&](const NodeGene& node) { return node.kind == kind; })) {
      faults.push_back(fmt::format("nodes: no {} among them: expected one", kind_name(kind)));
    }
  }
}

void check_links(const Genome& genome, const std::set<int>& ids, std::vector<std::string>& faults) {
  std::map<std::pair<int, int>, std::vector<Stages>> joined;
  for (std::size_t l = 0; l < genome.links.size(); ++l) {
    const LinkGene& link = genome.links[l];
    const std::string name = fmt::format("link {} ({} -> {})", link.innovation, link.from, link.to);
    if (link.innovation < 0) faults.push_back(name + ": the innovation number is negative");
    if (l > 0 && genome.links[l - 1].innovation >= link.innovation) {
      faults.push_back(fmt::format("{}: follows innovation {}, but innovation numbers must ascend",
                                   name, genome.links[l - 1].innovation));
    }
    for (const int end : {link.from, link.to}) {
      if (!ids.contains(end)) faults.push_back(fmt::format("{}: there is no node {}", name, end));
    }
    if (kind_of(link.from) == NodeKind::output) faults.push_back(name + ": leaves an output");
    if (kind_of(link.to) == NodeKind::input) faults.push_back(name + ": enters an input");
    if (!std::isfinite(link.weight)) faults.push_back(name + ": the weight is not finite");
    const Stages& stages = link.stages;
    if (stages.first < 0 || stages.last < stages.first) {
      faults.push_back(name + ": the first of its stages is negative or after the last");
    }
    std::vector<Stages>& others = joined[{link.from, link.to}];
    if (std::any_of(others.begin(), others.end(),
                    [&](const Stages& other) { return other.overlaps(stages); })) {
      faults.push_back(name + ": a second link between the same nodes");
    }
    others.push_back(stages);
  }
}

// Names the nodes of one cycle, if there is any.
void check_cycles(const Genome& genome, std::vector<std::string>& faults) {
  const Adjacency graph = outgoing_links(genome);
  const Sweep swept = sweep(graph);
  if (swept.order.size() == genome.nodes.size()) return;
  std::vector<bool> swept_over(genome.nodes.size(), false);
  for (const int n : swept.order) swept_over[static_cast<std::size_t>(n)] = true;
  // Every node left has a predecessor that is left: walking backwards must meet itself.
  std::vector<int> source(genome.nodes.size(), -1);
  for (std::size_t l = 0; l < graph.to.size(); ++l) {
    if (graph.from[l] < 0 || swept_over[static_cast<std::size_t>(graph.from[l])]) continue;
    source[static_cast<std::size_t>(graph.to[l])] = graph.from[l];
  }
  std::vector<bool> visited(genome.nodes.size(), false);
  int at =
      static_cast<int>(std::find(swept_over.begin(), swept_over.end(), false) - swept_over.begin());
  while (!visited[static_cast<std::size_t>(at)]) {
    visited[static_cast<std::size_t>(at)] = true;
    at = source[static_cast<std::size_t>(at)];
  }
  const int id = genome.nodes[static_cast<std::size_t>(at)].id;
  std::string path = std::to_string(id);
  for (int n = source[static_cast<std::size_t>(at)];; n = source[static_cast<std::size_t>(n)]) {
    path.insert(0, fmt::format("{} -> ", genome.nodes[static_cast<std::size_t>(n)].id));
    if (n == at) break;
  }
  faults.push_back("links close a cycle: " + path);
}

}  // namespace

std::optional<NodeKind> kind_of(int id) {
  if (id >= first_hidden) return NodeKind::hidden;
  if (contains(output_ids, id)) return NodeKind::output;
  if (contains(input_ids, id)) return NodeKind::input;
  if (id <= first_free_input && id > first_free_output) return NodeKind::input;
  if (id <= first_free_output && id >= least_id) return NodeKind::output;
  return std::nullopt;
}

ControlShape free_shape(int inputs, int outputs) {
  for (const int count : {inputs, outputs}) {
    if (count < 1 || count > free_signals) {
      throw std::invalid_argument(fmt::format("free_shape({}, {}): expected from 1 to {} of each",
                                              inputs, outputs, free_signals));
    }
  }
  ControlShape shape({}, {});
  for (int i = 0; i < inputs; ++i) shape.inputs.push_back(first_free_input - i);
  shape.inputs.push_back(bias_input);
  for (int o = 0; o < outputs; ++o) shape.outputs.push_back(first_free_output - o);
  return shape;
}

std::vector<std::string> check(const Genome& genome) {
  std::vector<std::string> faults;
  check_nodes(genome, faults);
  std::set<int> ids;
  for (const NodeGene& node : genome.nodes) ids.insert(node.id);
  check_links(genome, ids, faults);
  const bool searchable = std::adjacent_find(genome.nodes.begin(), genome.nodes.end(),
                                             [](const NodeGene& a, const NodeGene& b) {
                                               return a.id >= b.id;
                                             }) == genome.nodes.end();
  if (searchable) check_cycles(genome, faults);
  return faults;
}

std::vector<std::string> misfits(const Genome& genome, const ControlShape& shape) {
  std::vector<std::string> lines;
  const auto compare = [&](NodeKind kind, std::string_view what, const std::vector<int>& expected) {
    std::vector<int> ids;
    bool fits = true;
    for (const NodeGene& node : genome.nodes) {
      if (node.kind != kind) continue;
      ids.push_back(node.id);
      fits &= std::find(expected.begin(), expected.end(), node.id) != expected.end();
    }
    if (!fits)
      lines.push_back(
          fmt::format("{}: {}: expected none but {}", what, names_of(ids), names_of(expected)));
  };
  compare(NodeKind::input, "inputs", shape.inputs);
  compare(NodeKind::output, "outputs", shape.outputs);
  return lines;
}

bool is_separated(const Genome& genome) {
  return std::any_of(genome.links.begin(), genome.links.end(),
                     [](const LinkGene& link) { return link.stages != Stages{}; });
}

core::Network compile(const Genome& genome, const ControlShape& shape) {
  const Adjacency graph = outgoing_links(genome);
  const Sweep swept = sweep(graph);
  const std::size_t nodes = genome.nodes.size();
  if (std::find(graph.from.begin(), graph.from.end(), -1) != graph.from.end() ||
      swept.order.size() != nodes || !misfits(genome, shape).empty() || is_separated(genome)) {
    throw std::invalid_argument(
        "compile: expected a sound genome that fits the shape and is the same in all stages");
  }

  // Backwards along the order: which nodes reach an output.
  std::vector<bool> useful(nodes, false);
  int deepest = 0;
  for (auto n = swept.order.rbegin(); n != swept.order.rend(); ++n) {
    const std::size_t node = static_cast<std::size_t>(*n);
    deepest = std::max(deepest, swept.depth[node]);
    bool reaches = genome.nodes[node].kind == NodeKind::output;
    for (int e = graph.first[node]; e < graph.first[node + 1] && !reaches; ++e) {
      const std::size_t l = static_cast<std::size_t>(graph.link[static_cast<std::size_t>(e)]);
      reaches = useful[static_cast<std::size_t>(graph.to[l])];
    }
    useful[node] = reaches;
  }

  // Counting sort by depth; nodes of one depth stay in order of id. Slots follow this order.
  std::vector<int> first_of_depth(static_cast<std::size_t>(deepest) + 2, 0);
  const auto computed = [&](std::size_t n) {
    return useful[n] && genome.nodes[n].kind != NodeKind::input;
  };
  for (std::size_t n = 0; n < nodes; ++n) {
    if (computed(n)) ++first_of_depth[static_cast<std::size_t>(swept.depth[n]) + 1];
  }
  for (std::size_t d = 1; d < first_of_depth.size(); ++d)
    first_of_depth[d] += first_of_depth[d - 1];
  const int count = first_of_depth.back();
  core::Network network;
  network.inputs = static_cast<int>(shape.inputs.size());
  std::vector<int> slot(nodes, -1);
  for (std::size_t i = 0; i < shape.inputs.size(); ++i) {
    const int n = position(genome, shape.inputs[i]);
    if (n >= 0) slot[static_cast<std::size_t>(n)] = static_cast<int>(i);
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    if (computed(n)) {
      slot[n] = network.inputs + first_of_depth[static_cast<std::size_t>(swept.depth[n])]++;
    }
  }

  // Incoming links of every slot, in order of innovation because the genome lists them so.
  network.first_link.assign(static_cast<std::size_t>(count) + 1, 0);
  const auto target = [&](std::size_t l) {
    return slot[static_cast<std::size_t>(graph.to[l])] - network.inputs;
  };
  for (std::size_t l = 0; l < genome.links.size(); ++l) {
    if (target(l) >= 0) ++network.first_link[static_cast<std::size_t>(target(l)) + 1];
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    network.first_link[n + 1] += network.first_link[n];
  }
  std::vector<int> next(network.first_link.begin(), network.first_link.end() - 1);
  network.source.resize(static_cast<std::size_t>(network.first_link.back()));
  network.weight.resize(network.source.size());
  for (std::size_t l = 0; l < genome.links.size(); ++l) {
    if (target(l) < 0) continue;
    const std::size_t at = static_cast<std::size_t>(next[static_cast<std::size_t>(target(l))]++);
    network.source[at] = slot[static_cast<std::size_t>(graph.from[l])];
    network.weight[at] = static_cast<float>(genome.links[l].weight);
  }
  for (const int output : shape.outputs) {
    const int n = position(genome, output);
    if (n >= 0) {
      network.output.push_back(slot[static_cast<std::size_t>(n)]);
      continue;
    }
    network.output.push_back(network.inputs + network.node_count());
    network.first_link.push_back(network.first_link.back());  // a node without links
  }
  return network;
}

std::vector<core::Network> compile_stages(const Genome& genome, const ControlShape& shape,
                                          int stages) {
  if (!is_separated(genome)) return {compile(genome, shape)};
  std::vector<core::Network> networks;
  for (int stage = 0; stage < stages; ++stage) {
    Genome expressed{genome.nodes, {}};
    for (LinkGene link : genome.links) {
      if (!link.stages.contains(stage)) continue;
      link.stages = {};
      expressed.links.push_back(link);
    }
    networks.push_back(compile(expressed, shape));
  }
  return networks;
}

}  // namespace metamorph::evolve
