// Novelty search: who behaves as nobody did before (eq 8).

#include "evolve/search/novelty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evolve/search/nearest.h"
#include "evolve/search/neat_search.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {

std::vector<double> novelty(std::span<const std::vector<double>> behaviours,
                            std::span<const ArchiveEntry> archive, int neighbours, double alone,
                            int threads) {
  std::vector<std::size_t> with_behaviour;
  for (std::size_t i = 0; i < behaviours.size(); ++i) {
    if (!behaviours[i].empty()) with_behaviour.push_back(i);
  }
  std::vector<double> scores(behaviours.size(), 0.0);
  if (with_behaviour.empty()) return scores;

  // Coordinates one after the other, the population's first: they are the queries.
  const std::size_t dimensions = behaviours[with_behaviour.front()].size();
  const std::size_t queries = with_behaviour.size();
  const std::size_t count = queries + archive.size();
  std::vector<double> points(dimensions * count);
  for (std::size_t q = 0; q < queries; ++q) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      points[d * count + q] = behaviours[with_behaviour[q]][d];
    }
  }
  for (std::size_t a = 0; a < archive.size(); ++a) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      points[d * count + queries + a] = archive[a].behaviour[d];
    }
  }
  std::vector<double> mean(queries);
  mean_nearest_distances(points, static_cast<int>(dimensions), neighbours, threads, mean);
  for (std::size_t q = 0; q < queries; ++q) {
    scores[with_behaviour[q]] = mean[q] < 0 ? alone : mean[q];
  }
  return scores;
}

void update_archive(const NoveltySettings& settings, NoveltyState& state,
                    std::span<const std::vector<double>> behaviours,
                    std::span<const double> novelties, std::span<const std::int64_t> individuals,
                    int generation) {
  bool added = false;
  for (std::size_t i = 0; i < behaviours.size(); ++i) {
    if (behaviours[i].empty() || !(novelties[i] > state.archive_threshold)) {
      state.added_in_a_row = 0;
      continue;
    }
    state.archive.push_back({individuals[i], generation, novelties[i], behaviours[i]});
    added = true;
    if (++state.added_in_a_row > settings.archive_many) {
      state.archive_threshold *= settings.archive_raise;
      state.added_in_a_row = 0;
    }
  }
  state.idle_generations = added ? 0 : state.idle_generations + 1;
  if (state.idle_generations >= settings.archive_idle) {
    state.archive_threshold =
        std::max(state.archive_threshold * settings.archive_lower, settings.archive_floor);
    state.idle_generations = 0;
  }
}

namespace {

constexpr Table::Type integer = Table::Type::integer, real = Table::Type::real,
                      text = Table::Type::text;

/// behaviour: JSON list of the descriptors; numbers read back to the same bits.
const Table archive_table = {"archive",
                             {{"number", integer},
                              {"individual", integer},
                              {"generation", integer},
                              {"novelty", real},
                              {"behaviour", text}},
                             1};
const Table archive_sizes = {"archive_sizes",
                             {{"generation", integer},
                              {"archive_added", integer},
                              {"archive_size", integer},
                              {"archive_threshold", real}},
                             1};

/// Whoever fails, is empty, has no body or was not measured has no behaviour: it scores 0, is
/// nobody's neighbour and stays out of the archive. Novelty is measured against the archive as it
/// was before the generation, and the archive takes it as it is before the factor.
class Novelty : public Scorer {
 public:
  Novelty(const NoveltySettings& settings, int threads) : settings_(settings), threads_(threads) {
    state_.archive_threshold = settings.archive_threshold;
  }

  std::vector<double> score(const PopulationState& population,
                            std::span<const Evaluation> evaluations) override {
    std::vector<std::vector<double>> behaviours;
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      behaviours.push_back(evaluations[i].descriptors);
      ids.push_back(population.individuals[i].id);
    }
    generation_ = population.generation;
    recorded_ = state_.archive.size();
    std::vector<double> scores = novelty(behaviours, state_.archive, settings_.neighbours,
                                         state_.archive_threshold, threads_);
    update_archive(settings_, state_, behaviours, scores, ids, generation_);
    for (std::size_t i = 0; i < scores.size(); ++i) scores[i] *= evaluations[i].factor;
    return scores;
  }

  std::vector<Table> tables() const override { return {archive_table, archive_sizes}; }

  std::vector<std::vector<Row>> rows() const override {
    std::vector<std::vector<Row>> rows(2);
    const std::size_t size = state_.archive.size();
    for (std::size_t n = recorded_; n < size; ++n) {
      const auto& [individual, generation, novelty, behaviour] = state_.archive[n];
      rows[0].push_back({static_cast<std::int64_t>(n), individual, std::int64_t{generation},
                         novelty, nlohmann::json(behaviour).dump()});
    }
    rows[1].push_back({std::int64_t{generation_}, static_cast<std::int64_t>(size - recorded_),
                       static_cast<std::int64_t>(size), state_.archive_threshold});
    return rows;
  }

  nlohmann::json save() const override {
    return {{"archive_size", state_.archive.size()},
            {"archive_threshold", state_.archive_threshold},
            {"added_in_a_row", state_.added_in_a_row},
            {"idle_generations", state_.idle_generations}};
  }

  void load(const nlohmann::json& state, const Search::RowsOf& rows) override {
    NoveltyState loaded;
    state.at("archive_threshold").get_to(loaded.archive_threshold);
    state.at("added_in_a_row").get_to(loaded.added_in_a_row);
    state.at("idle_generations").get_to(loaded.idle_generations);
    for (const Row& row : rows(archive_table)) {
      loaded.archive.push_back(
          {std::get<std::int64_t>(row[1]), static_cast<int>(std::get<std::int64_t>(row[2])),
           std::get<double>(row[3]),
           nlohmann::json::parse(std::get<std::string>(row[4])).get<std::vector<double>>()});
    }
    if (loaded.archive.size() != state.at("archive_size").get<std::size_t>()) {
      throw std::runtime_error("table archive holds " + std::to_string(loaded.archive.size()) +
                               " entries: expected " + state.at("archive_size").dump());
    }
    state_ = std::move(loaded);
  }

 private:
  NoveltySettings settings_;
  int threads_;
  NoveltyState state_;
  int generation_ = 0;
  std::size_t recorded_ = 0;  ///< entries of the archive before the generation scored last
};

NoveltySettings settings_of(const SearchSettings& s) {
  NoveltySettings result;
  result.neighbours = s.integer("neighbours");
  result.archive_threshold = s.real("archive_threshold");
  result.archive_floor = s.real("archive_floor");
  result.archive_many = s.integer("archive_many");
  result.archive_idle = s.integer("archive_idle");
  result.archive_raise = s.real("archive_raise");
  result.archive_lower = s.real("archive_lower");
  return result;
}

std::unique_ptr<Search> make(const SearchSetup& setup) {
  return std::make_unique<NeatSearch>(
      setup,
      std::make_unique<Novelty>(settings_of(setup.settings), core::thread_count(setup.threads)));
}

std::vector<Contradiction> contradictions(const SearchSetup& setup) {
  const NoveltySettings s = settings_of(setup.settings);
  if (s.archive_floor <= s.archive_threshold) return {};
  return {{"search.archive_floor",
           fmt::format("at most search.archive_threshold = {}", s.archive_threshold)}};
}

}  // namespace

SearchKind novelty_search() {
  const NoveltySettings d;
  constexpr double no_limit = 1e9;  // upper end of ranges that have no natural one
  return {"novelty",
          "the distance to the nearest behaviours there were (eq 8)",
          {{"neighbours", d.neighbours, 1, 1e6, "k of novelty search"},
           {"archive_threshold", d.archive_threshold, 0, no_limit, "novelty to enter, at first, d"},
           {"archive_floor", d.archive_floor, 0, no_limit, "lowest threshold, d"},
           {"archive_many", d.archive_many, 0, no_limit, "more in a row raise the threshold"},
           {"archive_idle", d.archive_idle, 1, no_limit, "generations without one that lower it"},
           {"archive_raise", d.archive_raise, 1, 1e3, "factor that raises it"},
           {"archive_lower", d.archive_lower, 0, 1, "factor that lowers it"}},
          make,
          contradictions};
}

}  // namespace metamorph::evolve
