#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "evolve/genetics/population.h"
#include "evolve/search/scorer.h"
#include "metamorph/searches.h"

namespace metamorph::evolve {

/// For SearchKind::notes: a population that is too small for its species.
std::vector<std::string> neat_notes(const SearchSetup& setup);

/// NEAT: a population in species, bred by the scores that a scorer gives.
class NeatSearch : public Search {
 public:
  NeatSearch(const SearchSetup& setup, std::unique_ptr<Scorer> scorer);

  Asked ask() const override;
  Told tell(std::span<const Evaluation> evaluations) override;
  int generation() const override { return population_.generation; }
  bool is_paced() const override { return scorer_->is_paced(); }
  std::vector<Table> tables() const override;
  std::vector<std::uint8_t> save() const override;
  void load(std::span<const std::uint8_t> state, const RowsOf& rows) override;

 private:
  std::vector<std::uint8_t> measured() const;
  std::vector<std::vector<Row>> rows_of(const std::vector<double>& scores) const;
  std::vector<double> better_parents() const;  ///< by parents_; -1 without any
  std::vector<Row> gene_rows() const;

  NeatSettings settings_;
  Problem problem_;
  int threads_;
  std::unique_ptr<Scorer> scorer_;
  PopulationState population_;  ///< about to be evaluated
  /// Geometric means of the measured objectives of the generation before, whose ids count from
  /// first_parent_.
  std::vector<double> parents_;
  std::int64_t first_parent_ = 0;
};

}  // namespace metamorph::evolve
