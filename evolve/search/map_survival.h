#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "evolve/search/local_competition.h"
#include "evolve/search/pool_search.h"
#include "evolve/search/quality_map.h"

namespace metamorph::evolve {

/// What pool searches have in common that spread their pool along axes: the record tells what the
/// pool would be worth as a map.
class MapSurvival : public Survival {
 public:
  explicit MapSurvival(const SearchSetup& setup) : map_(setup) {}

  std::vector<Table> tables() const override { return map_.tables(); }
  std::vector<std::vector<Row>> rows(int generation, std::span<const Member> living,
                                     std::span<const Member>, int entered) override {
    std::map<int, double> best;
    for (const Member& member : living) {
      const std::optional<int> niche = map_.niche_of(member.evaluation);
      if (!niche) continue;
      double& quality = best.try_emplace(*niche, member.quality).first->second;
      quality = std::max(quality, member.quality);
    }
    return map_.rows(generation, best, entered);
  }

 protected:
  Placed placed(const Member& member) const {
    return {member.id, position_on(map_.axes(), member.evaluation), member.quality};
  }
  /// Those of the pool that have a place, and where in the pool they stand.
  std::pair<std::vector<Placed>, std::vector<std::size_t>> placed(
      std::span<const Member> pool) const {
    std::vector<Placed> all;
    std::vector<std::size_t> from;
    for (std::size_t p = 0; p < pool.size(); ++p) {
      Placed one = placed(pool[p]);
      if (one.position.empty()) continue;
      all.push_back(std::move(one));
      from.push_back(p);
    }
    return {std::move(all), std::move(from)};
  }
  const QualityMap& map() const { return map_; }

 private:
  QualityMap map_;
};

}  // namespace metamorph::evolve
