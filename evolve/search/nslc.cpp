// Novelty search with local competition (Lehman and Stanley 2011): new, and better than those that
// are like it.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "evolve/search/map_survival.h"
#include "evolve/search/nondominated.h"
#include "metamorph/random.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {

SearchKind novelty_search();

namespace {

using enum Table::Type;

/// behaviour: JSON list of the positions along the axes, 0 to 1 from end to end; numbers read back
/// to the same bits.
const Table archive_table = {"archive",
                             {{"number", integer},
                              {"individual", integer},
                              {"generation", integer},
                              {"quality", real},
                              {"behaviour", text}},
                             1};

/// Both objectives are of the k nearest along the axes, among pool and archive as it was before the
/// generation: novelty, and how many are worse. Survival as in NSGA-II. Scores: 1 / (1 + number of
/// the front), 0 of whoever has no behaviour: it stands behind all others. The archive takes a few
/// of each generation by chance, good or not, so that it says where the search has been.
class Nslc : public MapSurvival {
 public:
  explicit Nslc(const SearchSetup& setup)
      : MapSurvival(setup),
        seed_(setup.problem.seed),
        neighbours_(setup.settings.get<int>("neighbours")),
        archived_(static_cast<std::size_t>(setup.settings.get<int>("archive_random"))),
        threads_(core::thread_count(setup.threads)) {}

  Judgement judge(std::span<const Member> pool) override {
    auto [all, from] = placed(pool);
    all.insert(all.end(), archive_.begin(), archive_.end());
    const std::vector<Neighbourhood> of = neighbourhoods(all, from.size(), neighbours_, threads_);
    std::vector<std::vector<double>> points(pool.size(), {-1.0, -1.0});
    for (std::size_t i = 0; i < from.size(); ++i) {
      points[from[i]] = {of[i].novelty, static_cast<double>(of[i].worse)};
    }
    Ranking ranking = rank(points);
    Judgement judgement;
    for (std::size_t p = 0; p < pool.size(); ++p) {
      judgement.scores.push_back(points[p][0] < 0 ? 0 : 1.0 / (1 + ranking.front[p]));
    }
    judgement.order = std::move(ranking.order);
    return judgement;
  }

  int tournament() const override { return 2; }

  std::vector<Table> tables() const override {
    std::vector<Table> tables = MapSurvival::tables();
    tables.push_back(archive_table);
    return tables;
  }

  std::vector<std::vector<Row>> rows(int generation, std::span<const Member> living,
                                     std::span<const Member> children, int entered) override {
    std::vector<std::vector<Row>> rows = MapSurvival::rows(generation, living, children, entered);
    std::vector<Row>& added = rows.emplace_back();
    for (Placed& one : drawn(generation, children)) {
      added.push_back({static_cast<std::int64_t>(archive_.size()), one.id, std::int64_t{generation},
                       one.quality, nlohmann::json(one.position).dump()});
      archive_.push_back(std::move(one));
    }
    return rows;
  }

  nlohmann::json save() const override { return {{"archive_size", archive_.size()}}; }

  void load(const nlohmann::json& state, const Search::RowsOf& rows) override {
    std::vector<Placed> loaded;
    for (const Row& row : rows(archive_table)) {
      loaded.push_back(
          {std::get<std::int64_t>(row[1]),
           nlohmann::json::parse(std::get<std::string>(row[4])).get<std::vector<double>>(),
           std::get<double>(row[3])});
    }
    if (loaded.size() != state.at("archive_size").get<std::size_t>()) {
      throw std::runtime_error("table archive holds " + std::to_string(loaded.size()) +
                               " entries: expected " + state.at("archive_size").dump());
    }
    archive_ = std::move(loaded);
  }

 private:
  /// Those of the children that the archive takes, in order of their numbers.
  std::vector<Placed> drawn(int generation, std::span<const Member> children) const {
    std::vector<Placed> left, taken;
    for (const Member& child : children) {
      Placed one = placed(child);
      if (!one.position.empty()) left.push_back(std::move(one));
    }
    RandomStream stream(Purpose::archive_choice, seed_, static_cast<std::uint32_t>(generation), 0);
    while (taken.size() < archived_ && !left.empty()) {
      const auto at = left.begin() + stream.below(static_cast<std::uint32_t>(left.size()));
      taken.push_back(std::move(*at));
      left.erase(at);
    }
    std::sort(taken.begin(), taken.end(),
              [](const Placed& a, const Placed& b) { return a.id < b.id; });
    return taken;
  }

  std::uint64_t seed_;
  int neighbours_;
  std::size_t archived_;
  int threads_;
  std::vector<Placed> archive_;
};

std::unique_ptr<Search> make(const SearchSetup& setup) {
  return std::make_unique<PoolSearch>(setup, std::make_unique<Nslc>(setup));
}

}  // namespace

SearchKind nslc_search() {
  std::vector<Setting> settings = axis_settings();
  for (const Setting& setting : novelty_search().settings) {
    if (setting.name == "neighbours") settings.push_back(setting);
  }
  settings.push_back({"archive_random", 5, 0, 1e6,
                      "individuals of every generation, drawn by chance, that nslc archives"});
  return {"nslc",
          "novelty and better than the nearest (novelty search with local competition)",
          std::move(settings),
          make,
          axis_faults,
          nullptr,
          true};
}

}  // namespace metamorph::evolve
