// NSGA-II (Deb et al. 2002): the trials as objectives of their own, none traded for another.

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include "evolve/search/nondominated.h"
#include "evolve/search/pool_search.h"
#include "metamorph/metrics.h"

namespace metamorph::evolve {
namespace {

using enum Table::Type;

/// A column per objective, "objective_larva". Names of columns do not tell capitals from small
/// letters, those of trials do: the second of two such has its number behind it.
std::vector<Table::Column> objective_columns(const Problem& problem) {
  std::vector<Table::Column> columns;
  std::vector<std::string> taken;
  for (const Objective& objective : problem.objectives) {
    std::string name = "objective_" + objective.name, small = name;
    std::transform(small.begin(), small.end(), small.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (std::find(taken.begin(), taken.end(), small) != taken.end()) {
      name.append("_").append(std::to_string(columns.size()));
    }
    taken.push_back(std::move(small));
    columns.push_back({std::move(name), real});
  }
  return columns;
}

std::vector<double> objectives_of(const Member& member) {
  std::vector<double> objectives = member.evaluation.objectives;
  for (double& objective : objectives) objective *= member.evaluation.factor;
  return objectives;
}

/// Objectives count times the factor. Scores: 1 / (1 + number of the front among parents and
/// children), 1 for the best compromises.
class Nsga2 : public Survival {
 public:
  explicit Nsga2(const Problem& problem) : problem_(problem) {}

  Judgement judge(std::span<const Member> pool) override {
    std::vector<std::vector<double>> points;
    for (const Member& member : pool) points.push_back(objectives_of(member));
    Ranking ranking = rank(points);
    Judgement judgement;
    for (const int front : ranking.front) judgement.scores.push_back(1.0 / (1 + front));
    front_size_ =
        static_cast<std::size_t>(std::count(ranking.front.begin(), ranking.front.end(), 0));
    fronts_ = 1 + *std::max_element(ranking.front.begin(), ranking.front.end());
    crowding_.clear();
    for (std::size_t i = 0; i < front_size_; ++i) {
      crowding_.push_back(ranking.crowding[ranking.order[i]]);
    }
    judgement.order = std::move(ranking.order);
    return judgement;
  }

  int tournament() const override { return 2; }

  std::vector<Table> tables() const override {
    std::vector<Table::Column> front = {
        {"generation", integer}, {"individual", integer}, {"crowding", real}};
    for (Table::Column& column : objective_columns(problem_)) front.push_back(std::move(column));
    return {{"front", std::move(front), 2},
            {"fronts",
             {{"generation", integer},
              {"fronts", integer},
              {"front_size", integer},
              {"hypervolume", real},
              {"entered", integer}},
             1}};
  }

  std::vector<std::vector<Row>> rows(int generation, std::span<const Member> living,
                                     std::span<const Member>, int entered) override {
    std::vector<std::vector<Row>> rows(2);
    std::vector<std::vector<double>> front;
    for (std::size_t i = 0; i < std::min(front_size_, living.size()); ++i) {
      const std::vector<double>& point = front.emplace_back(objectives_of(living[i]));
      Row& row = rows[0].emplace_back(Row{std::int64_t{generation}, living[i].id, crowding_[i]});
      row.insert(row.end(), point.begin(), point.end());
    }
    const std::vector<double> nothing(problem_.objectives.size(), 0.0);
    rows[1].push_back({std::int64_t{generation}, std::int64_t{fronts_},
                       static_cast<std::int64_t>(front.size()), hypervolume(front, nothing),
                       std::int64_t{entered}});
    return rows;
  }

 private:
  Problem problem_;
  // Of the pool that was judged last.
  int fronts_ = 0;
  std::size_t front_size_ = 0;    ///< of front 0
  std::vector<double> crowding_;  ///< [front_size_], in order
};

std::unique_ptr<Search> make(const SearchSetup& setup) {
  return std::make_unique<PoolSearch>(setup, std::make_unique<Nsga2>(setup.problem));
}

}  // namespace

SearchKind nsga2_search() {
  return {"nsga2", "the distances of all trials as objectives of their own (NSGA-II)",
          {},      make,
          nullptr, nullptr,
          true};
}

}  // namespace metamorph::evolve
