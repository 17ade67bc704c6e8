// Simple search: the geometric mean of the objectives (eq 6).

#include "evolve/search/neat_search.h"

namespace metamorph::evolve {
namespace {

class Simple : public Scorer {
 public:
  std::vector<double> score(const PopulationState&,
                            std::span<const Evaluation> evaluations) override {
    std::vector<double> scores;
    for (const Evaluation& evaluation : evaluations) scores.push_back(geometric_mean(evaluation));
    return scores;
  }
};

std::unique_ptr<Search> make(const SearchSetup& setup) {
  return std::make_unique<NeatSearch>(setup, std::make_unique<Simple>());
}

}  // namespace

SearchKind simple_search() {
  return {"simple",  "the geometric mean of the distances of all trials (eq 6)", {}, make, nullptr,
          neat_notes};
}

}  // namespace metamorph::evolve
