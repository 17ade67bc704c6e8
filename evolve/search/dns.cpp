// Dominated novelty search (Bahlmann et al. 2025): far from all who are fitter.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "evolve/search/map_survival.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

/// The competition fitness of an individual is its distance to those that are fitter. Scores: c /
/// (1 + c) of it, 1 for the fittest, whose it is infinite. Whoever has no behaviour scores 0 and
/// stands behind all others.
class Dns : public MapSurvival {
 public:
  explicit Dns(const SearchSetup& setup)
      : MapSurvival(setup),
        neighbours_(setup.settings.get<int>("fitter_neighbours")),
        threads_(core::thread_count(setup.threads)) {}

  Judgement judge(std::span<const Member> pool) override {
    const auto [all, from] = placed(pool);
    const std::vector<double> distances = distances_to_fitter(all, neighbours_, threads_);
    std::vector<double> fitness(pool.size(), -1.0);
    for (std::size_t i = 0; i < all.size(); ++i) fitness[from[i]] = distances[i];

    Judgement judgement;
    for (const double c : fitness) {
      judgement.scores.push_back(c < 0 ? 0 : std::isinf(c) ? 1 : c / (1 + c));
    }
    judgement.order.resize(pool.size());
    std::iota(judgement.order.begin(), judgement.order.end(), std::size_t{0});
    std::stable_sort(judgement.order.begin(), judgement.order.end(),
                     [&](std::size_t a, std::size_t b) { return fitness[a] > fitness[b]; });
    return judgement;
  }

  int tournament() const override { return 1; }

 private:
  int neighbours_, threads_;
};

std::unique_ptr<Search> make(const SearchSetup& setup) {
  return std::make_unique<PoolSearch>(setup, std::make_unique<Dns>(setup));
}

}  // namespace

SearchKind dns_search() {
  std::vector<Setting> settings = axis_settings();
  settings.push_back({"fitter_neighbours", 3, 1, 1e6, "k of dominated novelty search"});
  return {"dns",
          "the distance to those that are fitter (dominated novelty search)",
          std::move(settings),
          make,
          axis_faults,
          nullptr,
          true};
}

}  // namespace metamorph::evolve
