#include "metamorph/variation.h"

#include <algorithm>

namespace metamorph::evolve {

namespace {

void insert_link(Genome& genome, const LinkGene& link) {
  const auto at = std::lower_bound(
      genome.links.begin(), genome.links.end(), link,
      [](const LinkGene& a, const LinkGene& b) { return a.innovation < b.innovation; });
  genome.links.insert(at, link);
}

void insert_node(Genome& genome, int id) {
  const auto at = std::lower_bound(genome.nodes.begin(), genome.nodes.end(), id,
                                   [](const NodeGene& node, int key) { return node.id < key; });
  genome.nodes.insert(at, {id, NodeKind::hidden});
}

}  // namespace

Innovations::Innovations(int& next_innovation, int& next_node)
    : next_innovation_(next_innovation), next_node_(next_node) {}

int Innovations::link_number(const Link& link) {
  const auto [entry, is_new] = links_.try_emplace(link, next_innovation_);
  if (is_new) ++next_innovation_;
  return entry->second;
}

Innovations::Split Innovations::split_numbers(const Link& link) {
  const auto [entry, is_new] =
      splits_.try_emplace(link, Split{next_node_, next_innovation_, next_innovation_ + 1});
  if (is_new) {
    ++next_node_;
    next_innovation_ += 2;
  }
  return entry->second;
}

void Innovations::apply(const StructuralChange& change, const NeatSettings& settings,
                        Genome& genome) {
  const Link where = {change.from, change.to, change.stages};
  if (change.kind == MutationKind::add_link) {
    insert_link(genome, {link_number(where), change.from, change.to, change.weight, change.stages});
  } else if (change.kind == MutationKind::add_node) {
    const auto old = std::find_if(
        genome.links.begin(), genome.links.end(),
        [&](const LinkGene& link) { return Link(link.from, link.to, link.stages) == where; });
    const double weight = old->weight;
    genome.links.erase(old);
    const Split split = split_numbers(where);
    insert_node(genome, split.node);
    insert_link(genome, {split.in, change.from, split.node,
                         std::min(settings.node_weight, settings.weight_limit), change.stages});
    insert_link(genome, {split.out, split.node, change.to, weight, change.stages});
  }
}

}  // namespace metamorph::evolve
