#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "metamorph/outcome.h"

namespace metamorph::evolve {

enum class SearchKind { simple, progressive, novelty };

/// Settings of the three searches (MODEL section 6).
struct SearchSettings {
  SearchKind kind = SearchKind::simple;
  int neighbours = 15;             ///< k of eq 8
  double archive_threshold = 1.0;  ///< d, at the start
  double archive_floor = 0.05;     ///< d
  int archive_many = 8;            ///< more additions than this in a row raise the threshold
  int archive_idle = 50;           ///< generations without an addition lower it
  double archive_raise = 1.1;
  double archive_lower = 0.9;
};

/// One individual's results: one outcome per trial of the experiment (a trial is a stage end and a
/// scene; "larva" and "adult" in a metamorphic experiment, in this order).
struct Evaluation {
  std::vector<core::Outcome>
      trials;  ///< [trials]; a trial not evaluated has status empty, distance 0
  std::vector<std::uint8_t> evaluated;  ///< [trials] 0: this trial was not run (progressive, early)
  int created = 1;  ///< cells ever created in the whole development that was run
  int died = 0;
  double penalty = 1;  ///< factor on the fitness for creating too many cells
};

/// An entry of the novelty archive.
struct ArchiveEntry {
  std::int64_t individual = 0;
  int generation = 0;
  double novelty = 0;
  std::vector<double> behaviour;  ///< [2 * trials]
  bool operator==(const ArchiveEntry&) const = default;
};

/// What a search remembers between generations: plain data, part of the checkpoint.
struct SearchState {
  std::vector<ArchiveEntry> archive;
  double archive_threshold = 0;
  int added_in_a_row = 0;
  int idle_generations = 0;
  bool operator==(const SearchState&) const = default;
};

SearchState initial_state(const SearchSettings& settings);

/// Geometric mean of the trials' distances times the penalty: eq 6 for two trials, the distance
/// itself for one.
double scalar_fitness(const Evaluation& evaluation);

/// w(g) of eq 7: 0 before a third of the generations, 1 from two thirds on, linear between.
double progressive_weight(int generation, int generations);

/// True if generation g of the search evaluates trial t for the whole population.
bool evaluates_trial(SearchKind kind, int trial, int generation, int generations);

/// True while species records must restart (progressive, weight changing).
bool restarts_records(SearchKind kind, int generation, int generations);

/// Scores a generation by the search's rule and updates its memory: one score >= 0 per individual.
/// `individuals` are the ids that go with the evaluations; all have the same one or two trials
/// (std::invalid_argument otherwise). The penalty multiplies every score. The same bits for any
/// thread count.
/// - simple: scalar_fitness().
/// - progressive: eq 7; scalar_fitness() where there is one trial only.
/// - novelty: eq 8 among the population and the archive as it was before this generation. Whoever
///   fails, is empty, has no body or was not evaluated in a trial scores 0, is nobody's neighbour
///   and stays out of the archive. The archive takes novelties as they are before the penalty. With
///   fewer than k others the mean is over all of them; the only one there is scores the threshold.
std::vector<double> score_generation(const SearchSettings& settings, SearchState& state,
                                     std::span<const Evaluation> evaluations,
                                     std::span<const std::int64_t> individuals, int generation,
                                     int generations, int threads);

}  // namespace metamorph::evolve
