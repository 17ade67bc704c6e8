#include "metamorph/variation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace metamorph::evolve {

namespace {

std::uint32_t draw_below(std::size_t n, RandomStream& stream) {
  return stream.below(static_cast<std::uint32_t>(n));
}

// A share from `least` (0: from 1 / links) to 1, log-uniform to within 6 %: the logarithm to base 2
// is taken linear between powers of two, so that the bits are the same on every machine.
double drawn_share(double least, std::size_t links, RandomStream& stream) {
  const double low = least > 0 ? least : 1 / static_cast<double>(links);
  if (!(low < 1)) return 1;
  int exponent = 0;
  const double mantissa = std::frexp(1 / low, &exponent);  // [1/2, 1)
  const double octaves = stream.uniform() * (exponent - 2 + 2 * mantissa);
  const double whole = std::floor(octaves);
  return low * std::ldexp(1 + (octaves - whole), static_cast<int>(whole));
}

MutationKind mutate_weights(Genome& genome, const NeatSettings& settings, RandomStream& stream) {
  if (genome.links.empty()) return MutationKind::none;
  const bool redraw = stream.chance(settings.severe);
  const auto change = [&](LinkGene& link) {
    link.weight = redraw ? new_weight(settings, stream)
                         : std::clamp(link.weight + settings.weight_change * stream.triangular(),
                                      -settings.weight_limit, settings.weight_limit);
  };
  const double share = drawn_share(redraw ? settings.redrawn_share : settings.moved_share,
                                   genome.links.size(), stream);
  bool changed = false;
  for (LinkGene& link : genome.links) {
    if (share < 1 && !stream.chance(share)) continue;
    change(link);
    changed = true;
  }
  if (!changed) change(genome.links[draw_below(genome.links.size(), stream)]);
  return redraw ? MutationKind::redraw : MutationKind::weights;
}

// Whether a link joins the two nodes in one of the stages.
bool linked(const Genome& genome, int from, int to, const Stages& stages) {
  return std::any_of(genome.links.begin(), genome.links.end(), [&](const LinkGene& link) {
    return link.from == from && link.to == to && link.stages.overlaps(stages);
  });
}

// Whether a path of links leads from one node to another (every node reaches itself).
bool reaches(const Genome& genome, int from, int to) {
  std::vector<int> reached = {from};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    if (reached[next] == to) return true;
    for (const LinkGene& link : genome.links) {
      if (link.from == reached[next] &&
          std::find(reached.begin(), reached.end(), link.to) == reached.end()) {
        reached.push_back(link.to);
      }
    }
  }
  return false;
}

bool addable(const Genome& genome, const StructuralChange& link) {
  return !linked(genome, link.from, link.to, link.stages) && !reaches(genome, link.to, link.from);
}

bool add_link(const Genome& genome, StructuralChange& change, const NeatSettings& settings,
              RandomStream& stream) {
  std::vector<int> sources, targets;
  for (const NodeGene& node : genome.nodes) {
    if (node.kind != NodeKind::output) sources.push_back(node.id);
    if (node.kind != NodeKind::input) targets.push_back(node.id);
  }
  const std::vector<Stages> stages = possible_stages(settings);
  change.kind = MutationKind::add_link;
  // Drawing until a link fits and drawing from the list of all fitting links have the same
  // distribution. The list is long, so it is made only where few links fit.
  constexpr int quick_tries = 32;
  bool found = false;
  for (int i = 0; i < quick_tries && !found; ++i) {
    change.from = sources[draw_below(sources.size(), stream)];
    change.to = targets[draw_below(targets.size(), stream)];
    change.stages = stages.size() > 1 ? stages[draw_below(stages.size(), stream)] : stages.front();
    found = addable(genome, change);
  }
  if (!found) {
    std::vector<StructuralChange> links;
    for (const int from : sources) {
      for (const int to : targets) {
        for (const Stages& when : stages) {
          const StructuralChange link = {MutationKind::add_link, from, to, 0, when};
          if (addable(genome, link)) links.push_back(link);
        }
      }
    }
    if (links.empty()) {
      change = {};
      return false;
    }
    change = links[draw_below(links.size(), stream)];
  }
  change.weight = new_weight(settings, stream);
  return true;
}

bool add_node(const Genome& genome, StructuralChange& change, RandomStream& stream) {
  std::vector<const LinkGene*> splittable;
  for (const LinkGene& link : genome.links) {
    if (link.from != bias_input) splittable.push_back(&link);
  }
  if (splittable.empty()) return false;
  const LinkGene& link = *splittable[draw_below(splittable.size(), stream)];
  change = {MutationKind::add_node, link.from, link.to, 0, link.stages};
  return true;
}

bool remove_link(Genome& genome, RandomStream& stream) {
  if (genome.links.size() < 2) return false;
  const auto at = genome.links.begin() + draw_below(genome.links.size(), stream);
  const std::array<int, 2> ends = {at->from, at->to};
  genome.links.erase(at);
  for (const int end : ends) {
    const bool used = kind_of(end) != NodeKind::hidden ||
                      std::any_of(genome.links.begin(), genome.links.end(),
                                  [&](const LinkGene& l) { return l.from == end || l.to == end; });
    if (!used) std::erase_if(genome.nodes, [&](const NodeGene& node) { return node.id == end; });
  }
  return true;
}

bool move_gene(Genome& genome, const NeatSettings& settings, RandomStream& stream) {
  struct Move {
    std::size_t link;
    Stages to;
  };
  const std::vector<Stages> stages = possible_stages(settings);
  std::vector<Move> moves;
  for (std::size_t l = 0; l < genome.links.size(); ++l) {
    for (const Stages& to : stages) {
      if (to != genome.links[l].stages) moves.push_back({l, to});
    }
  }
  while (!moves.empty()) {  // drawn again without those that are in another link's way
    const std::size_t drawn = draw_below(moves.size(), stream);
    LinkGene& link = genome.links[moves[drawn].link];
    const Stages before = std::exchange(link.stages, moves[drawn].to);
    const auto is_in_the_way = [&](const LinkGene& other) {
      return &other != &link && other.from == link.from && other.to == link.to &&
             other.stages.overlaps(link.stages);
    };
    if (std::none_of(genome.links.begin(), genome.links.end(), is_in_the_way)) return true;
    link.stages = before;
    moves[drawn] = moves.back();
    moves.pop_back();
  }
  return false;
}

MutationKind attempt(MutationKind kind, Genome& genome, StructuralChange& change,
                     const NeatSettings& settings, RandomStream& stream) {
  if (kind == MutationKind::weights) return mutate_weights(genome, settings, stream);
  const bool done = kind == MutationKind::add_link    ? add_link(genome, change, settings, stream)
                    : kind == MutationKind::add_node  ? add_node(genome, change, stream)
                    : kind == MutationKind::move_gene ? move_gene(genome, settings, stream)
                                                      : remove_link(genome, stream);
  return done ? kind : MutationKind::none;
}

}  // namespace

MutationKind mutate(Genome& genome, StructuralChange& change, const NeatSettings& settings,
                    RandomStream& stream) {
  const bool movable = settings.separation == Separation::partial;
  std::array<std::pair<MutationKind, double>, 5> wheel = {
      {{MutationKind::weights, settings.mutate_weights},
       {MutationKind::add_link, settings.add_link},
       {MutationKind::add_node, settings.add_node},
       {MutationKind::remove_link, settings.remove_link},
       {MutationKind::move_gene, movable ? settings.move_gene : 0}}};
  // Whether a kind is possible depends on the genome alone, so taking an impossible one off the
  // wheel equals drawing again until another comes, and ends after five draws at most.
  for (;;) {
    double total = 0;
    for (const auto& [kind, rate] : wheel) total += rate;
    if (!(total > 0)) return MutationKind::none;
    double left = stream.uniform() * total;
    std::size_t drawn = 0;
    for (std::size_t k = 0; k < wheel.size(); ++k) {
      if (wheel[k].second <= 0) continue;
      drawn = k;
      left -= wheel[k].second;
      if (left < 0) break;
    }
    const MutationKind done = attempt(wheel[drawn].first, genome, change, settings, stream);
    if (done != MutationKind::none) return done;
    wheel[drawn].second = 0;
  }
}

}  // namespace metamorph::evolve
