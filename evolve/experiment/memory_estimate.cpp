#include "evolve/experiment/memory_estimate.h"

#include <algorithm>

#include "metamorph/random.h"
#include "metamorph/variation.h"

namespace metamorph::evolve {
namespace {

// Bytes per cell, from the lists of core::Embryo and core::Body with the 3 edges and 2 triangles
// that a node of a large mesh has; and what BodyBatch has of a node, with 8 slots of 9 numbers in
// its ring, padding counted.
constexpr double of_embryo = 12 + 5 * 8 + 3 * 8 + 2 * 12;
constexpr double of_body = 4 * 8 + 2 * 12 + 3 * 8 + 3 * 8 + 2 * 8 + 4;
constexpr double of_packed_number = 8 * 9 + 20;

constexpr double of_program = 30e6, of_thread = 2e6;
constexpr double of_number = 16;  ///< of a list that becomes a checkpoint

/// Fingerprint, scene and outcome of a start, in a hash table, in the list of the individual, and
/// both once more while the next generation is evaluated.
constexpr double of_start = 2 * (2 * 40.0 + sizeof(core::Outcome));

double of_individual(const Experiment& e) {
  SearchSetup setup = search_setup_of(e, 1);
  setup.neat.stages = stage_count(setup.problem);
  RandomStream stream(Purpose::initial_genome, e.seed, 0, 0);
  const Genome first = seed_genome(setup.neat, stream, setup.shape);
  const double nodes = static_cast<double>(first.nodes.size());
  const double links = static_cast<double>(first.links.size());
  const double genome = sizeof(NodeGene) * nodes + sizeof(LinkGene) * links;
  const bool separated = e.neat.separation != Separation::none;
  const double saved = of_number * (2 * nodes + (separated ? 6 : 4) * links);
  const double described = static_cast<double>(setup.problem.descriptors.size());
  const double trials = static_cast<double>(e.trials.size());
  // In the generation's result, as the evaluator knows it, and of the one before.
  const double result =
      3 * trials * (sizeof(core::Outcome) + sizeof(TrialDescriptors) + sizeof(StageCounts)) +
      sizeof(double) * described;
  double starts = 0;
  bool renews = false;
  for (const Trial& trial : e.trials) {
    starts += trial.starts;
    renews = renews || trial.starts_renew;
  }
  double bytes = 3 * genome + saved + result + starts * of_start;
  if (renews) {
    bytes += static_cast<double>(e.stages().size()) * e.development.max_cells * of_body;
  }
  if (search_kind(e.search.kind).keeps_pool) {
    bytes += 2 * genome + saved + 2 * (sizeof(double) + of_number) * described;
  }
  return bytes;
}

}  // namespace

double memory_estimate(const Experiment& e, int population, int threads) {
  double starts = 0;
  for (const Trial& trial : e.trials) starts += trial.starts;
  const double cells = e.development.max_cells;
  const double at_once = std::min<double>(population, Evaluator::most_at_once);
  const double runs = std::min(at_once * starts, double{Evaluator::most_at_once});
  const double number = e.locomotion.precision == core::Precision::float32 ? 4 : 8;
  return of_program + of_thread * threads + population * of_individual(e) +
         at_once * static_cast<double>(e.stages().size()) * cells * (of_embryo + of_body) +
         runs * cells * (of_body + number * of_packed_number);
}

}  // namespace metamorph::evolve
