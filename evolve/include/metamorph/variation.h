#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "metamorph/control_shape.h"
#include "metamorph/genome.h"
#include "metamorph/neat_settings.h"
#include "metamorph/random.h"

// How genomes vary: the first ones, crossover, mutation, and the numbers of what mutation adds.

namespace metamorph::evolve {

/// Topology of generation 0: every input to every hidden node, every hidden node to every output,
/// the bias to every output; nothing else. Without hidden nodes every input leads to every output.
/// Inputs and outputs are those of the shape, the bias among them. Weights
/// triangular on +-settings.initial_weight. All seed genomes of a run share their innovation
/// numbers, 0 to links - 1. With full separation every stage has these links, of the same weights:
/// the first animats are what they are without separation, and their stages part by mutation.
Genome seed_genome(const NeatSettings& settings, RandomStream& stream,
                   const ControlShape& shape = {});

/// A weight as new links get it: triangular on +-settings.initial_weight, within the limit.
double new_weight(const NeatSettings& settings, RandomStream& stream);

/// The stages of life in which a gene may be expressed under these settings. none: all. partial:
/// all of them, those from one on, or those up to one. full: any single one.
std::vector<Stages> possible_stages(const NeatSettings& settings);

/// Crosses two sound genomes. The child has the nodes and links of the fitter one; the weight of a
/// link that both have (same innovation number) comes from either with equal chance, or is their
/// mean if `averaging`. The structure is the fitter's, the stages of its links included, so a
/// crossover cannot close a cycle.
Genome cross(const Genome& fitter, const Genome& other, bool averaging, RandomStream& stream);

enum class MutationKind { none, weights, redraw, add_link, add_node, remove_link, move_gene };

/// A structural change that needs innovation numbers. Children are bred in parallel without them;
/// the numbers are given afterwards, in order of the children (Innovations).
struct StructuralChange {
  MutationKind kind = MutationKind::none;  ///< none, add_link or add_node
  int from = 0, to = 0;                    ///< the new link, or the link to split
  double weight = 0;                       ///< of a new link
  Stages stages = {};                      ///< of that link
  bool operator==(const StructuralChange&) const = default;
};

/// Mutates a sound genome by exactly one kind of mutation, drawn by roulette over their rates;
/// one that is impossible for this genome is drawn again. Weights, stages and removed links are
/// changed in place; an added link or node is left in `change`. Returns the kind, or none where no
/// kind with a rate above 0 is possible.
///
/// - weights: each link changes with a chance that is drawn log-uniformly from a least share
///   (settings.moved_share; 0: 1 / links) to 1; if none did, one does. It moves by
///   settings.weight_change * triangular, within +-settings.weight_limit. With probability
///   settings.severe the mutation is a redraw: the links are drawn anew as in the seed genome, of
///   least share settings.redrawn_share.
/// - add link: a uniformly drawn pair among all that are not linked and would close no cycle; in
///   one of possible_stages(), drawn with the pair, in which it is not linked yet.
/// - add node: splits a uniformly drawn link that does not come from the bias; what comes of it has
///   that link's stages.
/// - remove link: any but the last one; hidden nodes left without any link go with it.
/// - move gene, with partial separation: a link gets other ones of possible_stages(), uniformly
/// among
///   all such changes after which no two links join the same pair in a stage.
MutationKind mutate(Genome& genome, StructuralChange& change, const NeatSettings& settings,
                    RandomStream& stream);

/// Gives innovation numbers and node ids to the structural changes of one generation: the same
/// change (a link between the same nodes, a split of a link between the same nodes, in the same
/// stages) gets the same numbers, a new one the next free ones.
class Innovations {
 public:
  /// Borrows the two counters of the population; they are advanced in place.
  Innovations(int& next_innovation, int& next_node);

  /// Carries out a change left by mutate(). An added node gets incoming weight
  /// settings.node_weight and the split link's weight outgoing; the split link goes. (A node is
  /// tanh(s/2) of its sum s: weight 2 passes small signals on as they are, 1 halves them.)
  void apply(const StructuralChange& change, const NeatSettings& settings, Genome& genome);

 private:
  struct Split {
    int node, in, out;  // id, innovation numbers
  };
  using Link = std::tuple<int, int, Stages>;  // from, to
  int link_number(const Link& link);
  Split split_numbers(const Link& link);

  int& next_innovation_;
  int& next_node_;
  std::map<Link, int> links_;
  std::map<Link, Split> splits_;
};

}  // namespace metamorph::evolve
