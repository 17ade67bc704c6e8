#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "evolve/experiment/experiment.h"

namespace metamorph::evolve {

/// Wall-clock seconds by phase.
struct PhaseSeconds {
  EvaluationSeconds evaluation;
  double search = 0, record = 0;

  static constexpr std::array<std::string_view, 5> names = {"develop", "extract", "locomotion",
                                                            "search", "record"};
  std::array<double, 5> values() const {
    return {evaluation.develop, evaluation.extract, evaluation.locomotion, search, record};
  }
  double total() const;
  PhaseSeconds& operator+=(const PhaseSeconds& other);
};

/// What came of one generation: everything the record and the reporters need.
struct GenerationResult {
  int generation = 0;
  Asked asked;                                ///< the individuals that were evaluated
  std::vector<Evaluated> individuals;         ///< [population]
  std::vector<double> scores;                 ///< [population] by the search's rule
  std::vector<double> eq6;                    ///< [population] geometric mean of the distances
  std::size_t champion = 0;                   ///< position of the best by eq 6
  std::vector<std::vector<Row>> search_rows;  ///< [tables of the search]
  EvaluationWork work;
};

/// Evaluations by status, for one trial or for all (trial -1); trials that were not run are left
/// out.
std::array<int, core::status_count> count_statuses(const GenerationResult& result, int trial = -1);

/// Evaluations, each start counted; trials that were not run are left out.
std::int64_t count_evaluations(const Experiment& experiment, const GenerationResult& result);

/// Evaluations whose step came closer to its limit than the margin (metamorph/stability.h).
int count_near_step_limit(const GenerationResult& result);

/// Position of the highest eq 6; ties go to the higher score, then to the lower position.
std::size_t best_position(const std::vector<double>& eq6, const std::vector<double>& scores);

}  // namespace metamorph::evolve
