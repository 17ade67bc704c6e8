// Novelty, its archive, and the behaviour it compares.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "evolve/search/novelty.h"
#include "metamorph/searches.h"
#include "tests/evolve/search_setup.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using tests::setup_of;

Evaluation behaving(std::vector<double> descriptors, double factor = 1) {
  return {{0}, std::move(descriptors), factor};
}

TEST(Novelty, OfTheOnlyOneIsTheGivenValue) {
  EXPECT_THAT(novelty(std::vector<std::vector<double>>{{}, {1, 2}}, {}, 15, 0.7, 1),
              ElementsAre(0, 0.7));
  EXPECT_THAT(novelty(std::vector<std::vector<double>>{{}, {}}, {}, 15, 0.7, 1), ElementsAre(0, 0));
}

TEST(Novelty, ScoresBeforeItArchivesAndAppliesTheFactorLast) {
  SearchSetup setup = setup_of("novelty", {1}, 100);
  setup.settings.values["neighbours"] = 1;
  const auto search = make_search(setup);
  // The third is as far from the first as the second is: were the second archived before the third
  // is scored, it would be its own nearest neighbour's double.
  const std::vector<Evaluation> all = {behaving({0, 0}), behaving({3, 4}, 0.1), behaving({}),
                                       behaving({3, 4.5})};
  const std::int64_t first = search->ask().lineage[0].id;
  const Told told = search->tell(all);
  EXPECT_THAT(told.scores, ElementsAre(5, 0.1 * 0.5, 0, 0.5));
  const std::size_t archive = 5, sizes = 6;
  ASSERT_EQ(search->tables()[archive].name, "archive");
  ASSERT_EQ(told.rows[archive].size(), 1u);
  EXPECT_EQ(told.rows[archive][0],
            (Row{std::int64_t{0}, first, std::int64_t{0}, 5.0, "[0.0,0.0]"}));
  EXPECT_EQ(told.rows[sizes][0],
            (Row{std::int64_t{0}, std::int64_t{1}, std::int64_t{1}, 1.0, std::int64_t{0}}));
  // Next time the archived one is a neighbour, of its own copy too.
  EXPECT_THAT(search->tell(all).scores, ElementsAre(0, 0.1 * 0.5, 0, 0.5));
}

// Runs update_archive on novelties alone, of behaviours that all differ.
class Archive {
 public:
  explicit Archive(bool per_generation = false) {
    settings.archive_per_generation = per_generation;
    state.archive_threshold = 1;
  }
  void generation(const std::vector<double>& novelties) {
    std::vector<std::vector<double>> behaviours;
    for (const double n : novelties) {
      behaviours.push_back(n < 0 ? std::vector<double>{} : std::vector<double>{n, next_++});
    }
    generation(novelties, behaviours);
  }
  void generation(const std::vector<double>& novelties,
                  const std::vector<std::vector<double>>& behaviours) {
    const std::vector<std::int64_t> ids(novelties.size(), 0);
    update_archive(settings, state, behaviours, novelties, ids, ++count_);
  }
  NoveltySettings settings;
  NoveltyState state;

 private:
  int count_ = 0;
  double next_ = 0;
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

TEST(ArchiveRules, PerGenerationARowIsWhatAGenerationAdds) {
  Archive archive(true);
  std::vector<double> novelties;
  for (int i = 0; i < 8; ++i) novelties.insert(novelties.end(), {2, 0.5, -1});
  archive.generation(novelties);  // eight, with others between
  EXPECT_EQ(archive.state.archive_threshold, 1);
  archive.generation({2});  // a row of its own
  EXPECT_EQ(archive.state.archive_threshold, 1);
  novelties.push_back(2);
  archive.generation(novelties);  // nine
  EXPECT_EQ(archive.state.archive_threshold, 1.1);
}

TEST(ArchiveRules, RefusesCopiesUnlessTold) {
  for (const bool copies : {false, true}) {
    Archive archive;
    archive.settings.archive_copies = copies;
    archive.generation({2, 2, 2, 2}, {{1, 2}, {3, 4}, {1, 2}, {1, 2.5}});
    EXPECT_EQ(archive.state.archive.size(), copies ? 4u : 3u);
    EXPECT_EQ(archive.state.copies, 1);
    // A refused copy ends the row as whoever is not added does.
    EXPECT_EQ(archive.state.added_in_a_row, copies ? 4 : 1);
    archive.generation({2}, {{3, 4}});
    EXPECT_EQ(archive.state.archive.size(), copies ? 5u : 3u);
    EXPECT_EQ(archive.state.copies, 1);
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

TEST(BehaviourGroups, AreLevelledToTheSameVariance) {
  const std::vector<std::vector<double>> behaviours = {{0, 0, 10}, {}, {2, 0, 30}, {4, 6, 20}};
  const Groups groups = {0, 0, 1};
  // Of 0, 2, 4 the variance is 8/3, of 0, 0, 6 it is 8, of 10, 30, 20 it is 200/3.
  const std::vector<double> variances = group_variances(behaviours, groups);
  ASSERT_EQ(variances.size(), 2u);
  EXPECT_NEAR(variances[0], 8.0 / 3 + 8, 1e-14);
  EXPECT_NEAR(variances[1], 200.0 / 3, 1e-13);
  std::vector<std::vector<double>> levelled = behaviours;
  const std::vector<double> factors = levelling_factors(variances);
  for (auto& behaviour : levelled) {
    for (std::size_t d = 0; d < behaviour.size(); ++d) {
      behaviour[d] *= factors[static_cast<std::size_t>(groups[d])];
    }
  }
  const std::vector<double> after = group_variances(levelled, groups);
  EXPECT_NEAR(after[0], after[1], 1e-12);
  EXPECT_NEAR(after[0] + after[1], variances[0] + variances[1], 1e-12);
  EXPECT_THAT(levelling_factors(std::vector<double>{0, 0}), ElementsAre(1, 1));
  EXPECT_THAT(group_variances(std::vector<std::vector<double>>{{}, {}}, groups), ElementsAre(0, 0));
}

// Two trials, the second a hundred times as wide: as they are, the first decides nothing.
TEST(Novelty, ScaledBehaviourHearsEveryTrial) {
  for (const bool scaled : {false, true}) {
    SearchSetup setup = setup_of("novelty", {1, 2}, 100);
    setup.problem.descriptors = {{"a.x", 0, -9, 9}, {"b.x", 1, -9, 9}};
    setup.settings.values["neighbours"] = 1;
    setup.settings.values["behaviour_scaled"] = scaled;
    const auto search = make_search(setup);
    const std::vector<Evaluation> four = {
        {{0, 0}, {0, 0}, 1}, {{0, 0}, {0, 300}, 1}, {{0, 0}, {3, 100}, 1}, {{0, 0}, {0, 100}, 1}};
    const std::vector<double> scores = search->tell(four).scores;
    // Nearest to the third is the fourth: 3 apart in the narrow trial.
    const double narrow = 27.0 / 16, wide = 11875;  // variances of 0, 0, 3, 0 and 0, 300, 100, 100
    const double factor = scaled ? std::sqrt((narrow + wide) / 2 / narrow) : 1;
    EXPECT_NEAR(scores[2], std::min(3 * factor, std::hypot(3 * factor, scaled ? 1e9 : 100)), 1e-9);
  }
}

}  // namespace
}  // namespace metamorph::evolve
