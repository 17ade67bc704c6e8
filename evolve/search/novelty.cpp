// Novelty search: who behaves as nobody did before (eq 8).

#include "evolve/search/novelty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evolve/search/nearest.h"
#include "evolve/search/neat_search.h"
#include "evolve/search/settings_check.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {

std::vector<double> group_variances(std::span<const std::vector<double>> behaviours,
                                    const Groups& groups) {
  std::vector<double> variances(groups.empty() ? 0 : static_cast<std::size_t>(groups.back()) + 1);
  for (std::size_t d = 0; d < groups.size(); ++d) {
    double sum = 0, squares = 0;
    std::size_t count = 0;
    for (const auto& behaviour : behaviours) {
      if (behaviour.empty()) continue;
      sum += behaviour[d];
      ++count;
    }
    if (count == 0) return variances;
    const double mean = sum / static_cast<double>(count);
    for (const auto& behaviour : behaviours) {
      if (!behaviour.empty()) squares += (behaviour[d] - mean) * (behaviour[d] - mean);
    }
    variances[static_cast<std::size_t>(groups[d])] += squares / static_cast<double>(count);
  }
  return variances;
}

std::vector<double> levelling_factors(std::span<const double> variances) {
  double sum = 0;
  for (const double variance : variances) sum += variance;
  const double mean = sum / static_cast<double>(variances.size());
  std::vector<double> factors;
  for (const double variance : variances) {
    factors.push_back(variance > 0 ? std::sqrt(mean / variance) : 1);
  }
  return factors;
}

std::vector<double> novelty(std::span<const std::vector<double>> behaviours,
                            std::span<const ArchiveEntry> archive, int neighbours, double alone,
                            int threads, std::span<const double> factors) {
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
  for (std::size_t d = 0; d < dimensions; ++d) {
    const double factor = factors.empty() ? 1 : factors[d];
    double* const point = points.data() + d * count;
    for (std::size_t q = 0; q < queries; ++q) point[q] = factor * behaviours[with_behaviour[q]][d];
    for (std::size_t a = 0; a < archive.size(); ++a) {
      point[queries + a] = factor * archive[a].behaviour[d];
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
  state.copies = 0;
  if (settings.archive_per_generation) state.added_in_a_row = 0;
  for (std::size_t i = 0; i < behaviours.size(); ++i) {
    bool enters = !behaviours[i].empty() && novelties[i] > state.archive_threshold;
    if (enters && !state.behaviours.insert(behaviours[i]).second) {
      ++state.copies;
      enters = settings.archive_copies;
    }
    if (!enters) {
      if (!settings.archive_per_generation) state.added_in_a_row = 0;
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

using enum Table::Type;

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
                              {"archive_threshold", real},
                              {"archive_copies", integer}},
                             1};
/// Of the variance of a generation's behaviours, before any scaling, what each trial has part in.
const Table behaviour_shares = {
    "behaviour_shares",
    {{"generation", integer}, {"objective", integer}, {"trial", text}, {"share", real}},
    2};

bool is_compared(const Descriptor& descriptor, const std::vector<std::string>& named) {
  return named.empty() ? descriptor.is_position
                       : std::find(named.begin(), named.end(), descriptor.name) != named.end();
}

/// Whoever fails, is empty, has no body or was not measured has no behaviour: it scores 0, is
/// nobody's neighbour and stays out of the archive. Novelty is measured against the archive as it
/// was before the generation, and the archive takes it as it is before the factor.
class Novelty : public Scorer {
 public:
  Novelty(NoveltySettings settings, const Problem& problem, int threads)
      : settings_(std::move(settings)), threads_(threads) {
    state_.archive_threshold = settings_.archive_threshold;
    for (std::size_t d = 0; d < problem.descriptors.size(); ++d) {
      const Descriptor& descriptor = problem.descriptors[d];
      if (!is_compared(descriptor, settings_.behaviour)) continue;
      compared_.push_back(d);
      auto known = std::find(objectives_.begin(), objectives_.end(), descriptor.objective);
      if (known == objectives_.end()) {
        known = objectives_.insert(objectives_.end(), descriptor.objective);
        trials_.push_back(problem.objectives[static_cast<std::size_t>(descriptor.objective)].name);
      }
      groups_.push_back(static_cast<int>(known - objectives_.begin()));
    }
  }

  std::vector<double> score(const PopulationState& population,
                            std::span<const Evaluation> evaluations) override {
    std::vector<std::vector<double>> behaviours;
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      std::vector<double>& behaviour = behaviours.emplace_back();
      if (!evaluations[i].descriptors.empty()) {
        for (const std::size_t d : compared_) behaviour.push_back(evaluations[i].descriptors[d]);
      }
      ids.push_back(population.individuals[i].id);
    }
    generation_ = population.generation;
    recorded_ = state_.archive.size();
    variances_ = group_variances(behaviours, groups_);
    std::vector<double> scores = novelty(behaviours, state_.archive, settings_.neighbours,
                                         state_.archive_threshold, threads_, factors(behaviours));
    update_archive(settings_, state_, behaviours, scores, ids, generation_);
    for (std::size_t i = 0; i < scores.size(); ++i) scores[i] *= evaluations[i].factor;
    return scores;
  }

  bool restarts_records(int) const override { return settings_.records_restart; }

  std::vector<Table> tables() const override {
    return {archive_table, archive_sizes, behaviour_shares};
  }

  std::vector<std::vector<Row>> rows() const override {
    std::vector<std::vector<Row>> rows(3);
    const std::size_t size = state_.archive.size();
    for (std::size_t n = recorded_; n < size; ++n) {
      const auto& [individual, generation, novelty, behaviour] = state_.archive[n];
      rows[0].push_back({static_cast<std::int64_t>(n), individual, std::int64_t{generation},
                         novelty, nlohmann::json(behaviour).dump()});
    }
    const std::int64_t generation = generation_;
    rows[1].push_back({generation, static_cast<std::int64_t>(size - recorded_),
                       static_cast<std::int64_t>(size), state_.archive_threshold,
                       std::int64_t{state_.copies}});
    double sum = 0;
    for (const double variance : variances_) sum += variance;
    for (std::size_t g = 0; g < variances_.size(); ++g) {
      rows[2].push_back({generation, std::int64_t{objectives_[g]}, trials_[g],
                         sum > 0 ? variances_[g] / sum : 0.0});
    }
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
      loaded.behaviours.insert(loaded.archive.back().behaviour);
    }
    if (loaded.archive.size() != state.at("archive_size").get<std::size_t>()) {
      throw std::runtime_error("table archive holds " + std::to_string(loaded.archive.size()) +
                               " entries: expected " + state.at("archive_size").dump());
    }
    state_ = std::move(loaded);
  }

 private:
  /// [compared descriptors]; empty where behaviours count as they are.
  std::vector<double> factors(std::vector<std::vector<double>> behaviours) const {
    if (!settings_.scaled) return {};
    for (const ArchiveEntry& entry : state_.archive) behaviours.push_back(entry.behaviour);
    const std::vector<double> of_group = levelling_factors(group_variances(behaviours, groups_));
    std::vector<double> factors;
    for (const int group : groups_) factors.push_back(of_group[static_cast<std::size_t>(group)]);
    return factors;
  }

  NoveltySettings settings_;
  int threads_;
  std::vector<std::size_t> compared_;  ///< descriptors of the problem that make a behaviour
  Groups groups_;                      ///< [compared_]
  std::vector<int> objectives_;        ///< [groups] whose descriptors they are
  std::vector<std::string> trials_;    ///< [groups] what these objectives are called
  NoveltyState state_;
  int generation_ = 0;
  std::size_t recorded_ = 0;       ///< entries of the archive before the generation scored last
  std::vector<double> variances_;  ///< [groups] of that generation
};

NoveltySettings settings_of(const SearchSettings& s) {
  NoveltySettings result;
  result.neighbours = s.get<int>("neighbours");
  result.archive_threshold = s.get<double>("archive_threshold");
  result.archive_floor = s.get<double>("archive_floor");
  result.archive_many = s.get<int>("archive_many");
  result.archive_idle = s.get<int>("archive_idle");
  result.archive_raise = s.get<double>("archive_raise");
  result.archive_lower = s.get<double>("archive_lower");
  result.archive_copies = s.get<bool>("archive_copies");
  result.archive_per_generation = s.get<bool>("archive_per_generation");
  result.records_restart = s.get<bool>("records_restart");
  result.scaled = s.get<bool>("behaviour_scaled");
  result.behaviour = s.get<std::vector<std::string>>("behaviour");
  return result;
}

std::unique_ptr<Search> make(const SearchSetup& setup) {
  return std::make_unique<NeatSearch>(
      setup, std::make_unique<Novelty>(settings_of(setup.settings), setup.problem,
                                       core::thread_count(setup.threads)));
}

std::vector<Contradiction> contradictions(const SearchSetup& setup) {
  const NoveltySettings s = settings_of(setup.settings);
  std::vector<Contradiction> found = unknown_descriptors("search.behaviour", s.behaviour, setup);
  const auto& descriptors = setup.problem.descriptors;
  if (std::none_of(descriptors.begin(), descriptors.end(),
                   [&](const Descriptor& d) { return is_compared(d, s.behaviour); }) &&
      found.empty()) {
    found.push_back({"search.kind", "a search without behaviour: the problem has no descriptor"});
  }
  if (s.archive_floor > s.archive_threshold) {
    found.push_back({"search.archive_floor",
                     fmt::format("at most search.archive_threshold = {}", s.archive_threshold)});
  }
  return found;
}

}  // namespace

SearchKind novelty_search() {
  const NoveltySettings d;
  return {
      "novelty",
      "the distance to the nearest behaviours there were (eq 8)",
      {{"neighbours", d.neighbours, 1, 1e6, "k of novelty search"},
       {"behaviour", d.behaviour, 0, 0, "descriptors that are compared; none: all final positions"},
       {"behaviour_scaled", d.scaled, 0, 0,
        "behaviour is divided by its spread so far, trial by trial"},
       {"archive_threshold", d.archive_threshold, 0, no_limit, "novelty to enter, at first, d"},
       {"archive_floor", d.archive_floor, 0, no_limit, "lowest threshold, d"},
       {"archive_many", d.archive_many, 0, no_limit, "more in a row raise the threshold"},
       {"archive_per_generation", d.archive_per_generation, 0, 0,
        "a row is what a generation adds; else whoever is not added ends it", false},
       {"archive_idle", d.archive_idle, 1, no_limit, "generations without one that lower it"},
       {"archive_raise", d.archive_raise, 1, 1e3, "factor that raises it"},
       {"archive_lower", d.archive_lower, 0, 1, "factor that lowers it"},
       {"archive_copies", d.archive_copies, 0, 0, "behaviours equal to an entry's enter, too",
        true},
       {"records_restart", d.records_restart, 0, 0,
        "species do not age: novelty falls as the archive fills", false}},
      make,
      contradictions,
      neat_notes};
}

}  // namespace metamorph::evolve
