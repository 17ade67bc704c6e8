#pragma once

#include "evolve/experiment/experiment.h"

namespace metamorph::evolve {

/// About how many bytes a run of this experiment holds at its peak with so many individuals (above
/// 0) on so many threads (above 0), as it begins: genomes grow, and with them their part. From what
/// is kept, counted: of every individual
///
/// - its genome: parents and children, of searches with a pool twice, and as the list of numbers
///   that becomes the checkpoint, 16 bytes each;
/// - what came of every trial, and of every start;
/// - where a trial renews its starts, the body of every stage with as many cells as may live;
///
/// and of at most Evaluator::most_at_once at a time embryos and bodies, with as many cells as may
/// live, and what simulates them. Rises with the population.
double memory_estimate(const Experiment& experiment, int population, int threads);

}  // namespace metamorph::evolve
