#include "metamorph/search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "evolve/search/novelty.h"
#include "evolve/search/progressive.h"
#include "metamorph/evaluator.h"
#include "metamorph/searches.h"
#include "tests/evolve/random_genomes.h"
#include "tests/evolve/search_setup.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using testing::test_stream;
using tests::setup_of;

Evaluation evaluation(std::vector<double> objectives, double factor = 1) {
  return {std::move(objectives), {}, factor};
}

TEST(EvaluationOf, HasAllDistancesAndAllFinalPositionsOrNone) {
  Evaluated one;
  one.penalty = 0.1;
  one.evaluated = {1, 1};
  one.trials.resize(2);
  one.trials[0].distance = 7;
  one.trials[0].mean_position = {2, 3};
  one.trials[1].distance = 8;
  one.trials[1].mean_position = {4, 5};
  const Evaluation whole = evaluation_of(one);
  EXPECT_THAT(whole.objectives, ElementsAre(7, 8));
  EXPECT_THAT(whole.descriptors, ElementsAre(2, 3, 4, 5));
  EXPECT_EQ(whole.factor, 0.1);
  for (const core::Status status : core::all_statuses) {
    one.trials[1].status = status;
    const bool moved = status == core::Status::ok || status == core::Status::not_settled;
    EXPECT_EQ(evaluation_of(one).descriptors.empty(), !moved) << core::name(status);
  }
  one.trials[1].status = core::Status::ok;
  one.evaluated[1] = 0;
  EXPECT_TRUE(evaluation_of(one).descriptors.empty());
  one.evaluated[1] = 1;
  one.trials[0].mean_position[1] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(evaluation_of(one).descriptors.empty());
}

TEST(Root, IsWithinRounding) {
  for (int n = 1; n <= 16; ++n) {
    EXPECT_EQ(root(0, n), 0);
    for (const double x : {1.0, 2.0, 3.0, 0.5}) {
      double power = 1;
      for (int i = 0; i < n; ++i) power *= x;
      EXPECT_NEAR(root(power, n), x, 0x1p-52 * x) << n;
    }
    for (const double x : {1e-300, 0.1, 7.0, 1e300}) {
      // Rounding of the n - 1 products is what Newton's last step sees, a root divides it by n.
      EXPECT_NEAR(root(x, n), std::pow(x, 1.0 / n),
                  4e-16 * (2 + std::abs(std::log(x))) * std::pow(x, 1.0 / n))
          << x << " " << n;
    }
  }
}

TEST(GeometricMean, OfAnyNumberOfObjectives) {
  EXPECT_EQ(geometric_mean(evaluation({4, 9})), 6);
  EXPECT_EQ(geometric_mean(evaluation({4, 9}, 0.5)), 3);
  EXPECT_EQ(geometric_mean(evaluation({4, 0})), 0);
  EXPECT_EQ(geometric_mean(evaluation({7})), 7);
  EXPECT_EQ(geometric_mean(evaluation({1, 8, 27})), 6);
}

TEST(ProgressiveWeight, AtTheBordersOfTwoStages) {
  for (const int length : {3, 30, 999, 2000, 2001}) {
    for (int g = 0; g < length; ++g) {
      const double w = progressive_weight(1, 2, g, length);
      const double third = length / 3.0;
      // eq 7 in plain arithmetic, off by rounding only.
      const double expected = g < third ? 0 : g >= 2 * third ? 1 : (g - third) / third;
      ASSERT_NEAR(w, expected, 1e-15 * length);
      ASSERT_EQ(w == 0, 3 * g <= length);
      ASSERT_EQ(w == 1, 3 * g >= 2 * length);
      ASSERT_EQ(progressive_weight(0, 2, g, length), 1);
    }
  }
  EXPECT_EQ(progressive_weight(1, 2, 1500, 3000), 0.5);
}

TEST(ProgressiveWeight, LetsStageAfterStageIn) {
  for (int g = 0; g < 50; ++g) {  // five parts of ten generations
    EXPECT_EQ(progressive_weight(1, 3, g, 50), std::clamp((g - 10) / 10.0, 0.0, 1.0)) << g;
    EXPECT_EQ(progressive_weight(2, 3, g, 50), std::clamp((g - 30) / 10.0, 0.0, 1.0)) << g;
  }
}

/// The scores of four individuals when they are what a search is told in a generation; in all
/// before they are told nothing good.
std::vector<double> score(const std::string& kind, const std::vector<int>& stages,
                          const std::vector<Evaluation>& four, int generation, int generations) {
  const auto search = make_search(setup_of(kind, stages, generations));
  const std::vector<Evaluation> none(4, evaluation(std::vector<double>(stages.size(), 0.0)));
  while (search->generation() < generation) search->tell(none);
  return search->tell(four).scores;
}

TEST(Progressive, MeasuresAStageFromWhereItsWeightBeginsToRise) {
  const std::vector<Evaluation> none(4, evaluation({0, 0, 0, 0}));
  const auto search = make_search(setup_of("progressive", {5, 5, 7, 9}, 50));
  const auto simple = make_search(setup_of("simple", {5, 5, 7, 9}, 50));
  for (int g = 0; g < 50; ++g) {
    const std::uint8_t second = g >= 10, third = g >= 30;
    EXPECT_THAT(search->ask().measured, ElementsAre(1, 1, second, third)) << g;
    EXPECT_THAT(simple->ask().measured, ElementsAre(1, 1, 1, 1));
    search->tell(none);
    simple->tell(none);
  }
}

TEST(Progressive, RestartsRecordsExactlyWhileAWeightChanges) {
  // Fitness falls with the weight, so that a record that is kept is never met again.
  const std::vector<Evaluation> same(4, evaluation({2, 0.5}));
  const auto search = make_search(setup_of("progressive", {1, 2}, 30));
  for (int g = 0; g < 30; ++g) {
    const Told told = search->tell(same);
    const std::size_t species = 2, stagnant = 5;
    ASSERT_EQ(search->tables()[species].columns[stagnant].name, "stagnant");
    std::int64_t most = 0;
    for (const Row& row : told.rows[species]) {
      most = std::max(most, std::get<std::int64_t>(row[stagnant]));
    }
    // A row tells how a species stood before its generation: the weight changes in 11 to 20.
    EXPECT_EQ(most == 0, g < 2 || (g > 11 && g <= 21)) << g;
  }
}

TEST(Score, SimpleAndProgressive) {
  const std::vector<Evaluation> all = {evaluation({4, 9}, 0.1), evaluation({4, 0}),
                                       evaluation({16, 0}), evaluation({0, 1})};
  const double tenth = 0.1;
  EXPECT_THAT(score("simple", {1, 2}, all, 0, 30), ElementsAre(6 * tenth, 0, 0, 0));
  EXPECT_THAT(score("progressive", {1, 2}, all, 9, 30), ElementsAre(2 * tenth, 2, 4, 0));
  EXPECT_THAT(score("progressive", {1, 2}, all, 15, 30),
              ElementsAre(std::sqrt(4 * 5.0) * tenth, std::sqrt(4 * 0.5), std::sqrt(16 * 0.5), 0));
  EXPECT_THAT(score("progressive", {1, 2}, all, 20, 30), ElementsAre(6 * tenth, 0, 0, 0));
}

TEST(Score, ProgressiveOfThreeStages) {
  const std::vector<Evaluation> all = {evaluation({8, 0, 0}), evaluation({1, 8, 0}),
                                       evaluation({1, 8, 27}), evaluation({0, 9, 9})};
  EXPECT_THAT(score("progressive", {1, 2, 3}, all, 9, 50), ElementsAre(2, 1, 1, 0));
  EXPECT_THAT(score("progressive", {1, 2, 3}, all, 25, 50), ElementsAre(0, 2, 2, 0));
  EXPECT_THAT(score("progressive", {1, 2, 3}, all, 40, 50), ElementsAre(0, 0, 6, 0));
}

TEST(Score, RefusesWhatDoesNotFitTheProblem) {
  const auto search = make_search(setup_of("simple", {1, 2}, 3));
  EXPECT_THROW(search->tell(std::vector<Evaluation>(3, evaluation({1, 1}))), std::invalid_argument);
  EXPECT_THROW(search->tell(std::vector<Evaluation>(4, evaluation({1}))), std::invalid_argument);
  EXPECT_THROW(search->tell(std::vector<Evaluation>(4, {{1, 1}, {1, 2, 3}, 1})),
               std::invalid_argument);
}

TEST(Search, OfEveryKindGoesOnFromWhatItSavedAndItsTables) {
  for (const SearchKind& kind : search_kinds()) {
    SCOPED_TRACE(kind.name);
    const SearchSetup setup = setup_of(std::string(kind.name), {1, 2}, 9);
    const auto whole = make_search(setup);
    auto pieces = make_search(setup);
    const std::vector<Table> tables = whole->tables();
    std::vector<std::vector<Row>> rows(tables.size());
    const auto rows_of = [&](const Table& table) {
      std::size_t t = 0;
      while (tables[t].name != table.name) ++t;
      return rows[t];
    };
    for (int g = 0; g < 9; ++g) {
      std::vector<Evaluation> four;
      for (int i = 0; i < 4; ++i) {
        four.push_back({{1.0 + i, 2.0 + g}, {3.0 * i, 5.0 * g * (i + 1)}, 1});
      }
      four[1].descriptors.clear();
      const Told a = whole->tell(four), b = pieces->tell(four);
      EXPECT_EQ(a.scores, b.scores);
      EXPECT_EQ(a.rows, b.rows);
      ASSERT_EQ(a.rows.size(), rows.size());
      for (std::size_t t = 0; t < rows.size(); ++t) {
        rows[t].insert(rows[t].end(), a.rows[t].begin(), a.rows[t].end());
      }
      const auto next = make_search(setup);
      next->load(pieces->save(), rows_of);
      EXPECT_EQ(next->save(), whole->save());
      EXPECT_EQ(next->ask().genomes, whole->ask().genomes);
      EXPECT_EQ(next->ask().lineage, whole->ask().lineage);
      pieces = make_search(setup);
      pieces->load(next->save(), rows_of);
    }
    EXPECT_THROW(make_search(setup)->load({}, [](const Table&) { return std::vector<Row>(); }),
                 std::runtime_error);
  }
}

TEST(MakeSearch, RefusesWhatCannotBeASearch) {
  const auto refusal = [](auto change) {
    SearchSetup setup = setup_of("novelty", {1}, 10);
    change(setup);
    try {
      make_search(setup);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("made");
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(refusal([](SearchSetup&) {}), "made");
  EXPECT_EQ(refusal([](SearchSetup& s) { s.neat.population = 0; }),
            "neat.population: expected a number from 1 to 1000000");
  EXPECT_EQ(refusal([](SearchSetup& s) { s.neat.hidden_nodes = -1; }),
            "neat.hidden_nodes: expected a number from 0 to 10000");
  EXPECT_EQ(refusal([](SearchSetup& s) { s.neat.severe = std::nan(""); }),
            "neat.severe: expected a number from 0 to 1");
  EXPECT_EQ(refusal([](SearchSetup& s) { s.settings.values["neighbours"] = 0; }),
            "search.neighbours: expected a number from 1 to 1000000");
  EXPECT_THAT(refusal([](SearchSetup& s) { s.settings.values["neighbours"] = 1.5; }),
              HasSubstr("search.neighbours: expected a value of the type"));
  EXPECT_EQ(refusal([](SearchSetup& s) { s.settings.values["neighbors"] = 1; }),
            "search.neighbors: expected a setting of some search");
  EXPECT_THAT(
      refusal([](SearchSetup& s) { s.settings.kind = "noveltie"; }),
      HasSubstr("search.kind: expected one of simple, progressive, novelty, map-elites, nslc, "
                "dns, nsga2"));
  EXPECT_EQ(refusal([](SearchSetup& s) { s.shape.outputs.clear(); }),
            "shape.outputs: expected one output or more, each once");
  EXPECT_EQ(refusal([](SearchSetup& s) { s.shape.inputs.pop_back(); }),
            "shape.inputs: expected inputs, each once, the bias among them");
  EXPECT_THAT(refusal([](SearchSetup& s) { s.problem.objectives.clear(); }),
              HasSubstr("problem.objectives: expected one at least"));
  EXPECT_EQ(refusal([](SearchSetup& s) {
              s.settings.values["behaviour"] = std::vector<std::string>{"o.x", "o.z"};
            }),
            "search.behaviour: expected none but o.x, o.y (\"o.z\" is unknown)");
  // All at once, a line each.
  EXPECT_EQ(refusal([](SearchSetup& s) {
              s.neat.population = 0;
              s.shape.outputs.clear();
            }),
            "neat.population: expected a number from 1 to 1000000\n"
            "shape.outputs: expected one output or more, each once");
}

// Who is better than its parents, who is dead, and what became of species, from scores given by
// hand.
TEST(NeatTables, TellHowChildrenCameToBeAndWhatBecameOfThem) {
  SearchSetup setup = setup_of("simple", {1}, 10);
  setup.neat.population = 50;
  const auto search = make_search(setup);
  const std::size_t origins = 3, changes = 4;
  ASSERT_EQ(search->tables()[origins].name, "origins");
  ASSERT_EQ(search->tables()[changes].name, "species_changes");
  std::set<std::int64_t> alive;
  for (int g = 0; g < 10; ++g) {
    // Everybody is as good as the generation is late, so that all but copies of dead ones are
    // better than their parents; the last three are dead.
    std::vector<Evaluation> all(50, evaluation({g + 1.0}));
    for (std::size_t i = 47; i < 50; ++i) all[i].objectives[0] = 0;
    const Told told = search->tell(all);
    std::int64_t children = 0, better = 0, dead = 0;
    for (const Row& row : told.rows[origins]) {
      EXPECT_EQ(std::get<std::int64_t>(row[0]), g);
      EXPECT_EQ(std::get<std::string>(row[1]) == "first", g == 0);
      children += std::get<std::int64_t>(row[3]);
      better += std::get<std::int64_t>(row[4]);
      dead += std::get<std::int64_t>(row[5]);
    }
    EXPECT_EQ(children, 50);
    EXPECT_EQ(better, g == 0 ? 0 : 47);
    EXPECT_EQ(dead, 3);
    const auto apply_changes = [&](int generation) {
      for (const Row& row : told.rows[changes]) {
        if (std::get<std::int64_t>(row[0]) != generation) continue;
        const auto id = std::get<std::int64_t>(row[1]);
        if (std::get<std::string>(row[2]) == "founded") {
          EXPECT_TRUE(alive.insert(id).second);
        } else {
          EXPECT_EQ(alive.erase(id), 1u);
        }
      }
    };
    if (g == 0) apply_changes(0);
    std::set<std::int64_t> members;
    for (const Row& row : told.rows[2]) members.insert(std::get<std::int64_t>(row[1]));
    EXPECT_EQ(alive, members);
    apply_changes(g + 1);
  }
}

}  // namespace
}  // namespace metamorph::evolve
