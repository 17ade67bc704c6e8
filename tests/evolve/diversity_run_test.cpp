// Whole runs of the searches of maps and fronts.

#include <gtest/gtest.h>

#include "evolve/run/run.h"
#include "evolve/run/run_reader.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using tests::contents;
using tests::run_in_pieces;
using tests::run_whole;
using tests::TemporaryDirectory;
using tests::tiny_experiment;
using tests::tiny_newt;

const std::string kinds[] = {"map-elites", "nslc", "dns", "nsga2"};

/// Axes on which the bodies of so short runs differ.
Experiment spread(Experiment e) {
  e.search.values["axes"] = std::vector<std::string>{"larva.x", "adult.x"};
  e.search.values["axis_low"] = std::vector<double>{-1, -1};
  e.search.values["axis_high"] = std::vector<double>{1, 1};
  return e;
}

TEST(DiversityRun, InterruptedAnywhereOrLongerThanAskedForIsTheSame) {
  const TemporaryDirectory directory;
  for (const std::string& kind : kinds) {
    SCOPED_TRACE(kind);
    Experiment e = spread(tiny_experiment(kind, 5));
    e.trials[1].starts_renew = true;
    if (kind == "map-elites") e.search.values["niches"] = 50;
    const auto whole = directory.path() / (kind + "-whole");
    const RunSummary summary = run_whole(whole, e);
    EXPECT_GT(summary.best.eq6, 0);
    auto expected = contents(whole);
    EXPECT_EQ(expected["individuals"].size(), 5u * 12u);
    EXPECT_FALSE(expected["origins"].empty());
    for (const int stop : {1, 3}) {
      const auto pieces = directory.path() / (kind + std::to_string(stop));
      run_in_pieces(pieces, e, {stop});
      EXPECT_EQ(contents(pieces), expected) << "stopped after " << stop;
    }
    const auto every = directory.path() / (kind + "-every");
    run_in_pieces(every, e, {1, 2, 3, 4});
    EXPECT_EQ(contents(every), expected);

    const auto extended = directory.path() / (kind + "-extended");
    e.generations = 2;
    run_whole(extended, e);
    const std::unique_ptr<Record> record = Record::resume(extended, 1);
    check_new_generations(record->experiment(), 2, 5);
    record->change_generations(5);
    run(*record, {1, {}, {}});
    EXPECT_EQ(contents(extended), expected);
  }
}

TEST(DiversityRun, OfThreeStagesOnOneAndTwoThreads) {
  const TemporaryDirectory directory;
  for (const std::string& kind : kinds) {
    SCOPED_TRACE(kind);
    const Experiment e = spread(tiny_newt(kind, 4));
    run_whole(directory.path() / (kind + "-1"), e, 1);
    run_whole(directory.path() / (kind + "-2"), e, 2);
    EXPECT_EQ(contents(directory.path() / (kind + "-1")),
              contents(directory.path() / (kind + "-2")));
  }
}

TEST(DiversityRun, TellsTheQualityThatWasRecorded) {
  const TemporaryDirectory directory;
  run_whole(directory.path() / "map", spread(tiny_experiment("map-elites", 4)));
  Database database(directory.path() / "map" / "run.db", Database::Mode::read);
  Statement rows(database,
                 "SELECT count(*), sum(e.quality != i.eq6), sum(e.quality != i.score) FROM elites "
                 "e JOIN individuals i ON i.generation = e.generation AND i.id = e.individual");
  ASSERT_TRUE(rows.step());
  EXPECT_GT(rows.integer(0), 3);
  EXPECT_EQ(rows.integer(1), 0);
  EXPECT_EQ(rows.integer(2), 0);

  run_whole(directory.path() / "front", spread(tiny_experiment("nsga2", 4)));
  Database other(directory.path() / "front" / "run.db", Database::Mode::read);
  Statement front(other,
                  "SELECT count(*), sum(f.objective_adult != o.distance * i.penalty) FROM front f "
                  "JOIN individuals i ON i.generation = f.generation AND i.id = f.individual JOIN "
                  "outcomes o ON o.generation = i.generation AND o.position = i.position AND "
                  "o.trial = 1");
  ASSERT_TRUE(front.step());
  EXPECT_GT(front.integer(0), 0);
  EXPECT_EQ(front.integer(1), 0);
}

}  // namespace
}  // namespace metamorph::evolve
