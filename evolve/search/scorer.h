#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "evolve/genetics/population.h"
#include "metamorph/search.h"

namespace metamorph::evolve {

/// The rule by which a NEAT search turns evaluations into one fitness per individual.
class Scorer {
 public:
  virtual ~Scorer() = default;

  /// One score >= 0 per individual; updates the scorer's memory. The factor of an evaluation
  /// multiplies its score.
  virtual std::vector<double> score(const PopulationState& population,
                                    std::span<const Evaluation> evaluations) = 0;

  /// [objectives] what is to be measured in a generation; empty: all.
  virtual std::vector<std::uint8_t> measured(int /*generation*/) const { return {}; }
  /// True if the scores of a generation do not compare with those of the one before.
  virtual bool restarts_records(int /*generation*/) const { return false; }
  virtual bool is_paced() const { return false; }

  virtual std::vector<Table> tables() const { return {}; }
  /// [tables] rows that the generation that was scored last adds.
  virtual std::vector<std::vector<Row>> rows() const { return {}; }
  virtual nlohmann::json save() const;
  /// Throws nlohmann's exceptions, or std::runtime_error, if it is not what save() gave.
  virtual void load(const nlohmann::json& /*state*/, const Search::RowsOf& /*rows*/) {}
};

}  // namespace metamorph::evolve
