#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "evolve/search/axes.h"
#include "evolve/search/niches.h"
#include "metamorph/metrics.h"

namespace metamorph::evolve {

/// The axes of a search and the niches they are cut into, and how the record tells of them.
class QualityMap {
 public:
  explicit QualityMap(const SearchSetup& setup);

  const std::vector<Axis>& axes() const { return axes_; }
  int niches() const { return niches_.count(); }
  /// None if the individual has no behaviour.
  std::optional<int> niche_of(const Evaluation& evaluation) const;

  /// `qd`, what the map is worth in every generation; `centroids`, where the centres of a map
  /// without a grid stand, in the units of its axes.
  std::vector<Table> tables() const;
  /// [tables] of a generation, from the quality in every filled niche and the number of newcomers.
  std::vector<std::vector<Row>> rows(int generation, const std::map<int, double>& qualities,
                                     int entered) const;

 private:
  std::vector<Axis> axes_;
  Niches niches_;
};

}  // namespace metamorph::evolve
