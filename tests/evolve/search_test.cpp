#include "evolve/search/search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "evolve/search/novelty.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::test_stream;

core::Outcome moved(double distance, double x = 0, double y = 0) {
  core::Outcome outcome;
  outcome.distance = distance;
  outcome.mean_position = {x, y};
  return outcome;
}

core::Outcome with_status(core::Status status) {
  core::Outcome outcome;
  outcome.status = status;
  return outcome;
}

Evaluation evaluation(std::vector<core::Outcome> trials, double penalty = 1) {
  Evaluation result;
  result.evaluated.assign(trials.size(), 1);
  result.trials = std::move(trials);
  result.penalty = penalty;
  return result;
}

TEST(ScalarFitness, IsTheGeometricMeanTimesThePenalty) {
  EXPECT_EQ(scalar_fitness(evaluation({moved(4), moved(9)})), 6);
  EXPECT_EQ(scalar_fitness(evaluation({moved(4), moved(9)}, 0.5)), 3);
  EXPECT_EQ(scalar_fitness(evaluation({moved(4), moved(0)})), 0);
  EXPECT_EQ(scalar_fitness(evaluation({moved(7)})), 7);
}

TEST(ProgressiveWeight, AtTheBorders) {
  for (const int length : {3, 30, 999, 2000, 2001}) {
    for (int g = 0; g < length; ++g) {
      const double w = progressive_weight(g, length);
      const double third = length / 3.0;
      // eq 7 in plain arithmetic, off by rounding only.
      const double expected = g < third ? 0 : g >= 2 * third ? 1 : (g - third) / third;
      ASSERT_NEAR(w, expected, 1e-15 * length);
      ASSERT_EQ(w == 0, 3 * g <= length);
      ASSERT_EQ(w == 1, 3 * g >= 2 * length);
    }
  }
  EXPECT_EQ(progressive_weight(1500, 3000), 0.5);
}

TEST(Progressive, EvaluatesAdultsFromTheFirstThirdOn) {
  for (const int g : {0, 9, 10, 29}) {
    EXPECT_TRUE(evaluates_trial(SearchKind::progressive, 0, g, 30));
    EXPECT_EQ(evaluates_trial(SearchKind::progressive, 1, g, 30), g >= 10);
    EXPECT_TRUE(evaluates_trial(SearchKind::simple, 1, g, 30));
    EXPECT_TRUE(evaluates_trial(SearchKind::novelty, 1, g, 30));
  }
}

TEST(Progressive, RestartsRecordsExactlyWhileTheWeightChanges) {
  for (int g = 0; g < 30; ++g) {
    EXPECT_EQ(restarts_records(SearchKind::progressive, g, 30), g > 10 && g <= 20) << g;
    EXPECT_FALSE(restarts_records(SearchKind::simple, g, 30));
    EXPECT_FALSE(restarts_records(SearchKind::novelty, g, 30));
  }
}

std::vector<double> score(SearchKind kind, const std::vector<Evaluation>& evaluations,
                          int generation, int generations) {
  SearchSettings settings;
  settings.kind = kind;
  SearchState state = initial_state(settings);
  const std::vector<std::int64_t> ids(evaluations.size(), 0);
  return score_generation(settings, state, evaluations, ids, generation, generations, 1);
}

TEST(Score, SimpleAndProgressive) {
  Evaluation larva_only = evaluation({moved(16), with_status(core::Status::empty)});
  larva_only.evaluated[1] = 0;
  const std::vector<Evaluation> all = {evaluation({moved(4), moved(9)}, 0.1),
                                       evaluation({moved(4), moved(0)}), larva_only};
  const double tenth = 0.1;
  EXPECT_THAT(score(SearchKind::simple, all, 0, 30), ElementsAre(6 * tenth, 0, 0));
  EXPECT_THAT(score(SearchKind::progressive, all, 9, 30), ElementsAre(2 * tenth, 2, 4));
  EXPECT_THAT(score(SearchKind::progressive, all, 15, 30),
              ElementsAre(std::sqrt(4 * 5.0) * tenth, std::sqrt(4 * 0.5), std::sqrt(16 * 0.5)));
  EXPECT_THAT(score(SearchKind::progressive, all, 20, 30), ElementsAre(6 * tenth, 0, 0));
  EXPECT_THAT(score(SearchKind::progressive, {evaluation({moved(7)})}, 3, 30), ElementsAre(7));
}

TEST(Score, RefusesMixedTrials) {
  EXPECT_THROW(
      score(SearchKind::simple, {evaluation({moved(1)}), evaluation({moved(1), moved(1)})}, 0, 1),
      std::invalid_argument);
}

TEST(Behaviour, IsAllFinalPositionsOrNothing) {
  EXPECT_THAT(behaviour(evaluation({moved(1, 2, 3), moved(1, 4, 5)})), ElementsAre(2, 3, 4, 5));
  EXPECT_THAT(behaviour(evaluation({moved(1, 2, 3)})), ElementsAre(2, 3));
  EXPECT_THAT(behaviour(evaluation({with_status(core::Status::not_settled)})), ElementsAre(0, 0));
  for (const core::Status status : core::all_statuses) {
    if (status == core::Status::ok || status == core::Status::not_settled) continue;
    EXPECT_THAT(behaviour(evaluation({moved(1, 2, 3), with_status(status)})), IsEmpty());
  }
  Evaluation partly = evaluation({moved(1, 2, 3), moved(1, 4, 5)});
  partly.evaluated[1] = 0;
  EXPECT_THAT(behaviour(partly), IsEmpty());
}

TEST(Novelty, OfTheOnlyOneIsTheGivenValue) {
  EXPECT_THAT(novelty(std::vector<std::vector<double>>{{}, {1, 2}}, {}, 15, 0.7, 1),
              ElementsAre(0, 0.7));
  EXPECT_THAT(novelty(std::vector<std::vector<double>>{{}, {}}, {}, 15, 0.7, 1), ElementsAre(0, 0));
}

TEST(Novelty, ScoresBeforeItArchivesAndAppliesThePenaltyLast) {
  SearchSettings settings;
  settings.kind = SearchKind::novelty;
  settings.neighbours = 1;
  SearchState state = initial_state(settings);
  // The third is as far from the first as the second is: were the second archived before the third
  // is scored, it would be its own nearest neighbour's double.
  const std::vector<Evaluation> all = {
      evaluation({moved(0, 0, 0)}), evaluation({moved(0, 3, 4)}, 0.1),
      evaluation({with_status(core::Status::inverted)}), evaluation({moved(0, 3, 4.5)})};
  const std::vector<std::int64_t> ids = {40, 41, 42, 43};
  const std::vector<double> scores = score_generation(settings, state, all, ids, 6, 100, 1);
  EXPECT_THAT(scores, ElementsAre(5, 0.1 * 0.5, 0, 0.5));
  ASSERT_EQ(state.archive.size(), 1u);
  EXPECT_EQ(state.archive[0], (ArchiveEntry{40, 6, 5, {0, 0}}));
  // Next time the archived one is a neighbour, of its own copy too.
  EXPECT_THAT(score_generation(settings, state, all, ids, 7, 100, 1),
              ElementsAre(0, 0.1 * 0.5, 0, 0.5));
}

// Runs update_archive on novelties alone.
class Archive {
 public:
  void generation(const std::vector<double>& novelties) {
    std::vector<std::vector<double>> behaviours;
    for (const double n : novelties) {
      behaviours.push_back(n < 0 ? std::vector<double>{} : std::vector<double>{n, 0});
    }
    const std::vector<std::int64_t> ids(novelties.size(), 0);
    update_archive(settings, state, behaviours, novelties, ids, ++count_);
  }
  SearchSettings settings;
  SearchState state = initial_state(settings);

 private:
  int count_ = 0;
};

TEST(ArchiveRules, TakesOnlyWhatIsAboveTheThreshold) {
  Archive archive;
  archive.generation({0.5, 1.0, 1.0001, 3});
  ASSERT_EQ(archive.state.archive.size(), 2u);
  EXPECT_EQ(archive.state.archive[0].novelty, 1.0001);
  EXPECT_EQ(archive.state.archive_threshold, 1);
}

TEST(ArchiveRules, MoreThanEightInARowRaiseTheThreshold) {
  Archive archive;
  archive.generation(std::vector<double>(8, 2));
  EXPECT_EQ(archive.state.archive_threshold, 1);
  archive.generation({2});  // the row goes on: the ninth
  EXPECT_EQ(archive.state.archive_threshold, 1.1);
  EXPECT_EQ(archive.state.added_in_a_row, 0);
  // The raised threshold holds for whoever follows in the same generation.
  Archive within;
  std::vector<double> novelties(9, 2);
  novelties.push_back(1.05);
  within.generation(novelties);
  EXPECT_EQ(within.state.archive.size(), 9u);
  // 18 in a row raise it twice.
  Archive twice;
  twice.generation(std::vector<double>(18, 2));
  EXPECT_EQ(twice.state.archive_threshold, 1.1 * 1.1);
}

TEST(ArchiveRules, WhoeverIsNotAddedEndsTheRow) {
  for (const double between : {0.5, -1.0}) {  // too near, and one that failed
    Archive archive;
    std::vector<double> novelties(8, 2);
    novelties.push_back(between);
    novelties.insert(novelties.end(), 8, 2);
    archive.generation(novelties);
    EXPECT_EQ(archive.state.archive.size(), 16u);
    EXPECT_EQ(archive.state.archive_threshold, 1);
    EXPECT_EQ(archive.state.added_in_a_row, 8);
  }
}

TEST(ArchiveRules, FiftyIdleGenerationsLowerTheThresholdToItsFloor) {
  Archive archive;
  for (int g = 0; g < 49; ++g) archive.generation({0.5});
  EXPECT_EQ(archive.state.archive_threshold, 1);
  archive.generation({0.5});
  EXPECT_EQ(archive.state.archive_threshold, 0.9);
  EXPECT_EQ(archive.state.idle_generations, 0);
  for (int g = 0; g < 49; ++g) archive.generation({0.5});
  archive.generation({0.95});  // an addition starts the count anew
  EXPECT_EQ(archive.state.archive_threshold, 0.9);
  EXPECT_EQ(archive.state.idle_generations, 0);
  for (int g = 0; g < 50 * 60; ++g) archive.generation({0.01});
  EXPECT_EQ(archive.state.archive_threshold, 0.05);
}

}  // namespace
}  // namespace metamorph::evolve
