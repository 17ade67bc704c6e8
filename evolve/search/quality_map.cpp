#include "evolve/search/quality_map.h"

#include <cstddef>
#include <nlohmann/json.hpp>

#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

Niches niches_of(const SearchSetup& setup) {
  const int count = setup.settings.get<int>("niches");
  const std::vector<int> bins = bins_of(setup);
  return count == 0 ? Niches::grid(bins)
                    : Niches::centroidal(count, static_cast<int>(bins.size()),
                                         core::thread_count(setup.threads));
}

}  // namespace

QualityMap::QualityMap(const SearchSetup& setup)
    : axes_(axes_of(setup)), niches_(niches_of(setup)) {}

std::optional<int> QualityMap::niche_of(const Evaluation& evaluation) const {
  const std::vector<double> position = position_on(axes_, evaluation);
  if (position.empty()) return std::nullopt;
  return niches_.niche_of(position);
}

std::vector<Table> QualityMap::tables() const {
  using Type = Table::Type;
  return {{"qd",
           {{"generation", Type::integer},
            {"filled", Type::integer},
            {"niches", Type::integer},
            {"coverage", Type::real},
            {"qd_score", Type::real},
            {"best", Type::real},
            {"mean_quality", Type::real},
            {"entered", Type::integer}},
           1},
          {"centroids", {{"niche", Type::integer}, {"centre", Type::text}}, 1}};
}

std::vector<std::vector<Row>> QualityMap::rows(int generation,
                                               const std::map<int, double>& qualities,
                                               int entered) const {
  std::vector<double> in_order;
  for (const auto& [niche, quality] : qualities) in_order.push_back(quality);
  const MapWorth worth = map_worth(in_order, niches());
  std::vector<std::vector<Row>> rows(2);
  rows[0].push_back({std::int64_t{generation}, std::int64_t{worth.filled}, std::int64_t{niches()},
                     worth.coverage, worth.qd_score, worth.best, worth.mean,
                     std::int64_t{entered}});
  if (generation > 0) return rows;
  const std::vector<double>& centres = niches_.centres();
  for (std::size_t c = 0; c < centres.size(); c += axes_.size()) {
    std::vector<double> centre;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      centre.push_back(axes_[a].low + centres[c + a] * (axes_[a].high - axes_[a].low));
    }
    rows[1].push_back({static_cast<std::int64_t>(c / axes_.size()), nlohmann::json(centre).dump()});
  }
  return rows;
}

}  // namespace metamorph::evolve
