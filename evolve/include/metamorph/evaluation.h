#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace metamorph::evolve {

/// What is known of one individual after its evaluation, as rows of numbers: all that a search
/// selects by. It knows no body and no scene.
struct Evaluation {
  std::vector<double> objectives;   ///< [objectives] >= 0, more is better; 0 where not measured
  std::vector<double> descriptors;  ///< [descriptors] how it behaved; empty: it has no behaviour
  double factor = 1;                ///< on every score: what it cost
};

/// One objective of a problem.
struct Objective {
  std::string name;
  int stage = 0;  ///< age at which it is measured: a progressive search lets stage after stage in
};

/// One descriptor of a problem.
struct Descriptor {
  std::string name;
  int objective = 0;        ///< it is told of the trial behind this objective
  double low = 0;           ///< between them it is expected: the ends of a map's axis
  double high = 1;          ///< > low
  bool is_position = true;  ///< where an individual ended: what novelty compares
};

/// What the numbers of an evaluation mean, and how long the search may take.
struct Problem {
  std::vector<Objective> objectives;
  std::vector<Descriptor> descriptors;
  int generations = 1;     ///< to be done
  std::uint64_t seed = 1;  ///< of every random number of the search
};

/// The stages of life: the distinct ages at which objectives are measured.
int stage_count(const Problem& problem);

/// The non-negative n-th root of x >= 0, n > 0; the same bits on every machine.
double root(double x, int n);

/// Geometric mean of the objectives times the factor: eq 6 of the paper for two, the objective
/// itself for one. Precondition: there is an objective.
double geometric_mean(const Evaluation& evaluation);

}  // namespace metamorph::evolve
