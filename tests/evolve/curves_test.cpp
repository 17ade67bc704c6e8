// What plots read from records.

#include "evolve/study/curves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "evolve/study/figure.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using tests::lines_of;
using tests::tiny_experiment;
using Path = std::filesystem::path;

const PlotKind& kind_of(std::string_view name) {
  const auto& kinds = plot_kinds();
  return *std::find_if(kinds.begin(), kinds.end(),
                       [&](const PlotKind& kind) { return kind.name == name; });
}

/// Runs of some seeds, made once for all tests.
class Curves : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    directory_ = new tests::TemporaryDirectory;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      tests::run_whole(path("simple", seed), tiny_experiment("simple", 4, seed));
    }
    tests::run_whole(path("novelty", 1), tiny_experiment("novelty", 4, 1));
    tests::run_whole(path("progressive", 1), tiny_experiment("progressive", 6, 1));
    Experiment map = tiny_experiment("map-elites", 4, 1);
    map.search.values["axes"] = std::vector<std::string>{"adult.growth", "adult.turnover"};
    tests::run_whole(path("map", 1), map);
  }
  static void TearDownTestSuite() { delete directory_; }

  static Path path(const std::string& name, std::uint64_t seed) {
    return directory_->path() / fmt::format("{}-{}", name, seed);
  }
  static std::vector<Path> simple_runs() {
    return {path("simple", 1), path("simple", 2), path("simple", 3)};
  }
  static Study study(const std::vector<Path>& runs, std::string_view kind,
                     Centre centre = Centre::mean, const std::vector<std::string>& wanted = {}) {
    return study_of(runs, kind_of(kind), centre, wanted);
  }
  /// The first column of a query of a run's record.
  static std::vector<double> query(const Path& run, const std::string& sql) {
    Database database(run / "run.db", Database::Mode::read);
    Statement select(database, sql);
    std::vector<double> values;
    while (select.step()) values.push_back(select.real(0));
    return values;
  }

 private:
  static tests::TemporaryDirectory* directory_;
};
tests::TemporaryDirectory* Curves::directory_ = nullptr;

/// The values of a curve by its name.
std::map<std::string, std::vector<double>> values_of(const Study& study) {
  std::map<std::string, std::vector<double>> values;
  for (const Curve& curve : study.curves) {
    values[curve.measure.what + " " + curve.measure.where] = curve.measure.values;
  }
  return values;
}

TEST_F(Curves, OfOneRunAreWhatItsRecordSays) {
  const std::string champion =
      "SELECT {} FROM champions c JOIN outcomes o USING (generation, position) WHERE trial = {} "
      "ORDER BY generation";
  const std::string changed =
      "SELECT b.{0} - a.{0} FROM champions c JOIN outcomes a USING (generation, position) JOIN "
      "outcomes b USING (generation, position) WHERE a.trial = 0 AND b.trial = 1 ORDER BY "
      "generation";
  const std::string trial = "SELECT {} FROM generation_trials WHERE trial = {} ORDER BY generation";
  const std::string counts =
      "SELECT 100.0 * sum(CASE WHEN status {} THEN count ELSE 0 END) / sum(count) FROM "
      "status_counts GROUP BY generation ORDER BY generation";
  const std::map<std::string, std::map<std::string, std::string>> queries = {
      {"fitness",
       {{"best ", "SELECT best_eq6 FROM generations ORDER BY generation"},
        {"mean ", "SELECT mean_eq6 FROM generations ORDER BY generation"}}},
      {"distances",
       {{"champion larva", fmt::format(fmt::runtime(trial), "champion_distance", 0)},
        {"champion adult", fmt::format(fmt::runtime(trial), "champion_distance", 1)},
        {"best larva", fmt::format(fmt::runtime(trial), "best_distance", 0)},
        {"best adult", fmt::format(fmt::runtime(trial), "best_distance", 1)},
        {"mean larva", fmt::format(fmt::runtime(trial), "mean_distance", 0)},
        {"mean adult", fmt::format(fmt::runtime(trial), "mean_distance", 1)}}},
      {"cells",
       {{"cells larva", fmt::format(fmt::runtime(champion), "cells", 0)},
        {"cells adult", fmt::format(fmt::runtime(champion), "cells", 1)}}},
      {"metamorphosis",
       {{"died ", fmt::format(fmt::runtime(changed), "died")},
        {"added ", fmt::format(fmt::runtime(changed), "created")}}},
      {"species",
       {{"species ", "SELECT species FROM populations ORDER BY generation"},
        {"threshold ", "SELECT compatibility_threshold FROM populations ORDER BY generation"}}},
      {"failures",
       {{"dead ",
         "SELECT 100.0 * sum(eq6 = 0) / count(*) FROM individuals GROUP BY generation ORDER BY "
         "generation"},
        {"no_body ", fmt::format(fmt::runtime(counts), "IN ('empty', 'no_body')")},
        {"not_settled ", fmt::format(fmt::runtime(counts), "= 'not_settled'")},
        {"failed ",
         fmt::format(fmt::runtime(counts), "NOT IN ('ok', 'not_settled', 'empty', 'no_body')")}}},
      {"time",
       {{"all ", "SELECT sum(seconds) FROM timings GROUP BY generation ORDER BY generation"},
        {"develop ", "SELECT seconds FROM timings WHERE phase = 'develop' ORDER BY generation"},
        {"extract ", "SELECT seconds FROM timings WHERE phase = 'extract' ORDER BY generation"},
        {"locomotion ",
         "SELECT seconds FROM timings WHERE phase = 'locomotion' ORDER BY generation"},
        {"search ", "SELECT seconds FROM timings WHERE phase = 'search' ORDER BY generation"},
        {"record ", "SELECT seconds FROM timings WHERE phase = 'record' ORDER BY generation"}}},
  };
  for (const auto& [kind, of_curves] : queries) {
    const Study of_one = study({path("simple", 1)}, kind);
    const auto values = values_of(of_one);
    ASSERT_EQ(values.size(), of_curves.size()) << kind;
    for (const auto& [curve, sql] : of_curves) {
      const std::vector<double> expected = query(path("simple", 1), sql);
      ASSERT_THAT(expected, SizeIs(4)) << kind << " " << curve;
      ASSERT_EQ(values.count(curve), 1u) << kind << " " << curve;
      for (std::size_t g = 0; g < 4; ++g) {
        EXPECT_DOUBLE_EQ(values.at(curve).at(g), expected[g]) << kind << " " << curve;
      }
    }
    for (const Curve& curve : of_one.curves)
      EXPECT_THAT(curve.low, SizeIs(0)) << "one run, no band";
  }
}

TEST_F(Curves, OfAnArchiveAreWhatItsRecordSays) {
  const auto novelty = values_of(study({path("novelty", 1)}, "archive"));
  EXPECT_EQ(novelty.at("size "), query(path("novelty", 1),
                                       "SELECT archive_size FROM archive_sizes "
                                       "ORDER BY generation"));
  EXPECT_EQ(novelty.at("threshold "), query(path("novelty", 1),
                                            "SELECT archive_threshold FROM archive_sizes ORDER BY "
                                            "generation"));
  const auto map = values_of(study({path("map", 1)}, "archive"));
  EXPECT_EQ(map.at("qd_score "),
            query(path("map", 1), "SELECT qd_score FROM qd ORDER BY generation"));
  EXPECT_EQ(map.at("filled "),
            query(path("map", 1), "SELECT 100 * coverage FROM qd ORDER BY generation"));
}

TEST_F(Curves, OfSeveralRunsAreTheirCentreWithinItsBand) {
  for (const Centre centre : {Centre::mean, Centre::median}) {
    const Study three = study(simple_runs(), "fitness", centre);
    ASSERT_THAT(three.experiments, SizeIs(1));
    EXPECT_THAT(three.experiments[0].seeds, ElementsAre(1, 2, 3));
    ASSERT_THAT(three.curves, SizeIs(2));
    for (std::size_t g = 0; g < 4; ++g) {
      std::vector<double> best;
      for (const Path& run : simple_runs()) {
        best.push_back(query(run, "SELECT best_eq6 FROM generations ORDER BY generation")[g]);
      }
      std::sort(best.begin(), best.end());
      const Curve& curve = three.curves[0];
      EXPECT_DOUBLE_EQ(curve.measure.values[g],
                       centre == Centre::mean ? (best[0] + best[1] + best[2]) / 3 : best[1]);
      // All three the same run happens once in nine samples: more often than what is cut off.
      EXPECT_NEAR(curve.low[g], best[0], 1e-12);
      EXPECT_NEAR(curve.high[g], best[2], 1e-12);
    }
  }
}

TEST_F(Curves, DoNotDependOnTheOrderOfTheRuns) {
  std::vector<Path> runs = simple_runs();
  runs.push_back(path("novelty", 1));
  const std::string expected = csv_of(study(runs, "distances"));
  while (std::next_permutation(runs.begin(), runs.end())) {
    ASSERT_EQ(csv_of(study(runs, "distances")), expected);
  }
}

TEST_F(Curves, GoAsFarAsAllRunsDo) {
  const tests::TemporaryDirectory here;
  Experiment longer = tiny_experiment("simple", 6, 7);
  tests::run_whole(here.path() / "long", longer);
  const Study both = study({path("simple", 2), here.path() / "long"}, "fitness");
  ASSERT_THAT(both.experiments, SizeIs(1));
  EXPECT_THAT(both.curves.at(0).measure.values, SizeIs(4));
  EXPECT_THAT(both.notes,
              ElementsAre("tiny: up to generation 3, where its shortest run ends (seed 2)"));
  EXPECT_EQ(figure_of(both, kind_of("fitness"), Centre::mean).notes, both.notes);
}

TEST_F(Curves, OfRunsWithOtherSettingsAreOnesOfTheirOwn) {
  const tests::TemporaryDirectory here;
  Experiment other = tiny_experiment("simple", 4, 1);
  other.min_cells = 9;
  tests::run_whole(here.path() / "other", other);
  const Study two = study({path("simple", 1), here.path() / "other"}, "fitness");
  ASSERT_THAT(two.experiments, SizeIs(2));
  EXPECT_THAT(two.experiments[0].label, HasSubstr("tiny ("));
  EXPECT_THAT(two.experiments[0].label, HasSubstr("min_cells=8"));
  EXPECT_THAT(two.experiments[1].label, HasSubstr("min_cells=9"));
  const Chart chart = figure_of(two, kind_of("fitness"), Centre::mean);
  ASSERT_THAT(chart.keys, SizeIs(2));
  EXPECT_NE(chart.keys[0].colour, chart.keys[1].colour);
  EXPECT_THAT(chart.panels, SizeIs(2));
  EXPECT_THAT(chart.panels[0].curves, SizeIs(2));
}

TEST_F(Curves, OfTrialsWithOtherNamesAreMatchedByScene) {
  const tests::TemporaryDirectory here;
  Experiment robust = tiny_experiment("simple", 2, 1);
  robust.name = "robust";
  robust.trials[0].name = "swim";
  robust.trials[1].name = "walk";
  robust.trials[0].stage = robust.trials[1].stage;
  tests::run_whole(here.path() / "robust", robust);
  const Study two =
      study({path("simple", 1), here.path() / "robust"}, "distances", Centre::mean, {"champion"});
  std::vector<std::string> places;
  for (const Curve& curve : two.curves) places.push_back(curve.measure.where);
  EXPECT_THAT(places, ElementsAre("water", "water", "land", "land"));

  // By itself: one stage, one embryo, one curve.
  const Study cells = study({here.path() / "robust"}, "cells");
  ASSERT_THAT(cells.curves, SizeIs(1));
  EXPECT_EQ(cells.curves[0].measure.title, "Swim, walk");
  EXPECT_THAT(lines_of([&] { study({here.path() / "robust"}, "metamorphosis"); }),
              ElementsAre(HasSubstr("one stage of life: expected a run with a metamorphosis")));
}

TEST_F(Curves, OfThreeStagesTellBothMetamorphoses) {
  const tests::TemporaryDirectory here;
  tests::run_whole(here.path() / "newt", tests::tiny_newt("simple", 2));
  const auto values = values_of(study({here.path() / "newt"}, "metamorphosis"));
  ASSERT_THAT(values, SizeIs(4));
  EXPECT_EQ(values.at("added metamorphosis 2"),
            query(here.path() / "newt",
                  "SELECT b.created - a.created FROM champions c JOIN outcomes a USING "
                  "(generation, position) JOIN outcomes b USING (generation, position) WHERE "
                  "a.trial = 1 AND b.trial = 2 ORDER BY generation"));
}

TEST_F(Curves, TellNoMeanWhereNotAllWereEvaluated) {
  // Progressive search leaves the adult out in its first third, but for the champion.
  const auto values = values_of(study({path("progressive", 1)}, "distances"));
  EXPECT_FALSE(std::isnan(values.at("champion adult").at(0)));
  EXPECT_FALSE(std::isnan(values.at("mean larva").at(0)));
  EXPECT_TRUE(std::isnan(values.at("mean adult").at(0)));
  EXPECT_FALSE(std::isnan(values.at("mean adult").at(5)));
  EXPECT_TRUE(std::isnan(values_of(study({path("progressive", 1)}, "fitness")).at("mean ").at(0)));
  const auto failures = values_of(study({path("progressive", 1)}, "failures"));
  EXPECT_TRUE(std::isnan(failures.at("dead ").at(0)));
  EXPECT_FALSE(std::isnan(failures.at("dead ").at(5)));
}

TEST_F(Curves, NeedWhatTheyShow) {
  EXPECT_THAT(lines_of([] { study({path("map", 1)}, "species"); }),
              ElementsAre(HasSubstr("search.kind = \"map-elites\": expected a run whose search "
                                    "breeds in species")));
  EXPECT_THAT(lines_of([] { study({path("simple", 1)}, "archive"); }),
              ElementsAre(HasSubstr("search.kind = \"simple\": expected a run whose search has an "
                                    "archive or a map of elites")));
  EXPECT_THAT(lines_of([] { study({path("simple", 1), path("simple", 1)}, "fitness"); }),
              ElementsAre(HasSubstr("the same experiment and seed (1)")));
  EXPECT_THAT(lines_of([] { study({path("simple", 1)}, "fitness", Centre::mean, {"worst"}); }),
              ElementsAre("--curves: worst: expected some of best, mean"));
  const tests::TemporaryDirectory here;
  {
    Record record(here.path() / "new", tiny_experiment("simple", 2), 1);
  }
  EXPECT_THAT(lines_of([&] { study({here.path() / "new"}, "fitness"); }),
              ElementsAre(HasSubstr("no generation is done yet")));
}

TEST_F(Curves, RefuseWhatIsDamaged) {
  const tests::TemporaryDirectory here;
  const Path run = here.path() / "run";
  std::filesystem::copy(path("simple", 1), run);
  {
    Database database(run / "run.db", Database::Mode::write);
    database.run("UPDATE generations SET best_eq6 = best_eq6 + 1 WHERE generation = 2");
  }
  EXPECT_THAT(lines_of([&] { study({run}, "fitness"); }),
              ElementsAre(HasSubstr("damaged: table generations, generation 2")));
  EXPECT_THAT(lines_of([&] { study({run}, "species"); }), SizeIs(0));
}

}  // namespace
}  // namespace metamorph::evolve
