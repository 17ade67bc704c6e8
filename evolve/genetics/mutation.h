#pragma once

#include "evolve/genetics/population.h"
#include "metamorph/random.h"

namespace metamorph::evolve {

enum class MutationKind { none, weights, add_link, add_node, remove_link };

/// A structural change that needs innovation numbers. Children are bred in parallel without them;
/// the numbers are given afterwards, in order of the children (innovations.h).
struct StructuralChange {
  MutationKind kind = MutationKind::none;  ///< none, add_link or add_node
  int from = 0, to = 0;                    ///< the new link, or the link to split
  double weight = 0;                       ///< of a new link
  bool operator==(const StructuralChange&) const = default;
};

/// Mutates a sound genome by exactly one kind of mutation, drawn by roulette over the four rates;
/// one that is impossible for this genome is drawn again. Weights and removed links are changed in
/// place; an added link or node is left in `change`. Returns the kind, or none where no kind with
/// a rate above 0 is possible.
///
/// - weights: with probability settings.severe all are drawn anew as in the seed genome, else each
///   moves by settings.weight_change * triangular; within +-settings.weight_limit.
/// - add link: a uniformly drawn pair among all that are not linked and would close no cycle.
/// - add node: splits a uniformly drawn link that does not come from the bias.
/// - remove link: any but the last one; hidden nodes left without any link go with it.
MutationKind mutate(Genome& genome, StructuralChange& change, const NeatSettings& settings,
                    RandomStream& stream);

}  // namespace metamorph::evolve
