#include "evolve/run/run.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "evolve/run/run_reader.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::contents;
using tests::lines_of;
using tests::run_in_pieces;
using tests::run_whole;
using tests::TemporaryDirectory;
using tests::tiny_experiment;
using tests::tiny_newt;

const std::string kinds[] = {"simple", "progressive", "novelty"};

TEST(Run, RecordsWhatItWasAskedFor) {
  const TemporaryDirectory directory;
  for (const std::string& kind : kinds) {
    const auto path = directory.path() / kind;
    const Experiment e = tiny_experiment(kind, 6);
    const RunSummary summary = run_whole(path, e);
    EXPECT_EQ(summary.generations_done, 6);
    EXPECT_FALSE(summary.interrupted);
    EXPECT_GT(summary.best.eq6, 0);  // somebody lives and moves, or these tests would say little
    auto tables = contents(path);
    EXPECT_EQ(tables["generations"].size(), 6u);
    EXPECT_EQ(tables["champions"].size(), 6u);
    EXPECT_EQ(tables["individuals"].size(), 6u * 12u);
    EXPECT_EQ(tables["checkpoint"].size(), 1u);
    EXPECT_FALSE(tables["species"].empty());
    EXPECT_EQ(tables["archive"].empty(), kind != "novelty");
    // Progressive search runs larvae only in its first third, and one adult for the record.
    const std::size_t all = 6 * 12 * 2;
    EXPECT_EQ(tables["outcomes"].size(), kind == "progressive" ? all - 2 * 11 : all);
    // Whatever has a body is described, and what moved is described in full.
    Database database(path / "run.db", Database::Mode::read);
    Statement rows(database,
                   "SELECT count(*), count(d.cells), sum(d.cells = o.body_cells), "
                   "sum((o.status IN ('ok', 'not_settled')) != (d.stance IS NOT NULL)), "
                   "count(d.growth) FROM outcomes o LEFT JOIN descriptors d "
                   "USING (generation, position, trial) WHERE o.body_cells > 0");
    ASSERT_TRUE(rows.step());
    EXPECT_EQ(rows.integer(0), static_cast<std::int64_t>(tables["descriptors"].size()));
    EXPECT_EQ(rows.integer(1), rows.integer(0));
    EXPECT_EQ(rows.integer(2), rows.integer(0));
    EXPECT_EQ(rows.integer(3), 0);
    EXPECT_GT(rows.integer(4), 0);
  }
}

TEST(Run, ThreeStagesOfLifeOnOneAndTwoThreadsAndInterrupted) {
  const TemporaryDirectory directory;
  for (const std::string& kind : kinds) {
    const Experiment e = tiny_newt(kind, 10);
    const auto path = directory.path() / (kind + "-whole");
    const RunSummary summary = run_whole(path, e, 1);
    EXPECT_EQ(summary.best.distances.size(), 3u);
    run_whole(directory.path() / (kind + "-threads"), e, 2);
    run_in_pieces(directory.path() / (kind + "-pieces"), e, {1, 4, 5});
    const auto expected = contents(path);
    EXPECT_EQ(contents(directory.path() / (kind + "-threads")), expected);
    EXPECT_EQ(contents(directory.path() / (kind + "-pieces")), expected);
    // Progressive search: two parts without the adult, two without the newt beside that; of each
    // of these generations one is completed for the record.
    const std::size_t all = 10 * 12 * 3, without = 2 * 11 + 6 * 11;
    EXPECT_EQ(expected.at("outcomes").size(), kind == "progressive" ? all - without : all);

    Database database(path / "run.db", Database::Mode::read);
    Statement rows(database,
                   "SELECT from_stage, to_stage, sum(from_cells + born - died != to_cells), "
                   "min(born), min(died) FROM metamorphosis GROUP BY 1, 2 ORDER BY 1");
    for (const auto& [from, to] : {std::pair{120, 210}, std::pair{210, 300}}) {
      ASSERT_TRUE(rows.step());
      EXPECT_EQ(rows.integer(0), from);
      EXPECT_EQ(rows.integer(1), to);
      EXPECT_EQ(rows.integer(2), 0);  // cells are conserved
      EXPECT_GE(rows.integer(3), 0);
      EXPECT_GE(rows.integer(4), 0);
    }
    EXPECT_FALSE(rows.step());
  }
}

TEST(Run, WithGenesOfStagesOnOneAndTwoThreadsAndInterrupted) {
  const TemporaryDirectory directory;
  for (const Separation separation : {Separation::partial, Separation::full}) {
    for (const std::string& kind : kinds) {
      Experiment e = tiny_newt(kind, 6);
      e.neat.separation = separation;
      e.neat.move_gene = 1;
      const std::string name =
          kind + std::string(separation_names[static_cast<std::size_t>(separation)].name);
      const auto path = directory.path() / (name + "-whole");
      run_whole(path, e, 1);
      run_whole(directory.path() / (name + "-threads"), e, 2);
      run_in_pieces(directory.path() / (name + "-pieces"), e, {1, 4});
      const auto expected = contents(path);
      EXPECT_EQ(contents(directory.path() / (name + "-threads")), expected);
      EXPECT_EQ(contents(directory.path() / (name + "-pieces")), expected);

      // Every choice of stages has its row in every generation, and at first all is as it was sown.
      const bool full = separation == Separation::full;
      Database database(path / "run.db", Database::Mode::read);
      Statement rows(database,
                     "SELECT generation, first, last, links FROM gene_stages ORDER BY 1, 2, 3");
      double moved = 0;
      for (int g = 0; g < 6; ++g) {
        const std::vector<std::pair<int, int>> choices =
            full ? std::vector<std::pair<int, int>>{{0, 0}, {1, 1}, {2, 2}}
                 : std::vector<std::pair<int, int>>{{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}};
        for (const auto& [first, last] : choices) {
          ASSERT_TRUE(rows.step());
          EXPECT_EQ(rows.integer(0), g);
          EXPECT_EQ(rows.integer(1), first);
          EXPECT_EQ(rows.integer(2), last);
          const bool sown = full || last - first == 2;
          if (g == 0) {
            EXPECT_EQ(rows.real(3), sown ? 6 * 8 + 8 * 7 + 7 : 0);
          }
          if (!sown) moved += rows.real(3);
        }
      }
      EXPECT_FALSE(rows.step());
      EXPECT_EQ(moved > 0, !full);
    }
  }
}

TEST(Run, HasNoTableOfStagesWithoutSeparation) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "plain";
  run_whole(path, tiny_experiment("simple", 1));
  EXPECT_FALSE(contents(path).contains("gene_stages"));
}

TEST(Run, CheckingLinksChangesNoBit) {
  const TemporaryDirectory directory;
  const Experiment e = tiny_experiment("progressive", 3);
  run_whole(directory.path() / "unchecked", e);
  Record record(directory.path() / "checked", e, 1);
  CheckedLinks checked;
  run(record, {2, {}, {}, &checked});
  EXPECT_EQ(contents(directory.path() / "unchecked"), contents(directory.path() / "checked"));
  // Elites keep their results: somewhat fewer developments than individuals.
  EXPECT_GT(checked.developments, 2 * 12);
  EXPECT_GT(checked.renewals, checked.developments);
  EXPECT_GT(checked.links, checked.renewals);
}

TEST(Run, ChosenStepsKeepTheBits) {
  const TemporaryDirectory directory;
  Experiment e = tiny_experiment("simple", 4);
  for (NamedScene& named : e.scenes)
    named.scene.step = named.scene.settle_step = core::automatic_step;
  run_whole(directory.path() / "1", e, 1);
  run_whole(directory.path() / "2", e, 2);
  run_in_pieces(directory.path() / "pieces", e, {2});
  const auto expected = contents(directory.path() / "1");
  EXPECT_EQ(contents(directory.path() / "2"), expected);
  EXPECT_EQ(contents(directory.path() / "pieces"), expected);
  run_whole(directory.path() / "fixed", tiny_experiment("simple", 4));
  EXPECT_NE(contents(directory.path() / "fixed")["outcomes"], expected.at("outcomes"));
}

TEST(Run, CountsStepsNearTheirLimit) {
  const TemporaryDirectory directory;
  Experiment e = tiny_experiment("simple", 2);
  EXPECT_EQ(run_whole(directory.path() / "default", e).near_step_limit, 0);
  // From the margin to the limit it is a tenth, these steps are 6 to 8 % apart: a larva with a
  // limit between 0.28 and 0.4, as there is in every population, is near it in one of them at
  // least.
  int near = 0;
  for (int percent = 26; percent <= 40; percent += 2) {
    for (NamedScene& named : e.scenes) {
      if (!named.scene.ground) named.scene.step = percent / 100.0;
    }
    const auto path = directory.path() / std::to_string(percent);
    near += run_whole(path, e).near_step_limit;
  }
  EXPECT_GT(near, 0);
  EXPECT_LE(near, 8 * 2 * 12);
}

TEST(Run, SeedsGiveOtherRuns) {
  const TemporaryDirectory directory;
  run_whole(directory.path() / "a", tiny_experiment("simple", 2, 1));
  run_whole(directory.path() / "b", tiny_experiment("simple", 2, 2));
  EXPECT_NE(contents(directory.path() / "a")["champions"],
            contents(directory.path() / "b")["champions"]);
}

TEST(Run, InterruptedAnywhereAndResumedIsTheSame) {
  const TemporaryDirectory directory;
  for (const std::string& kind : kinds) {
    const std::string name = kind;
    const Experiment e = tiny_experiment(kind, 6);
    const auto whole = directory.path() / (name + "-whole");
    run_whole(whole, e);
    const auto expected = contents(whole);
    for (int stop = 0; stop < 6; ++stop) {
      const auto pieces = directory.path() / (name + "-" + std::to_string(stop));
      run_in_pieces(pieces, e, {stop});
      EXPECT_EQ(contents(pieces), expected) << "stopped after " << stop;
    }
    const auto every = directory.path() / (name + "-every");
    run_in_pieces(every, e, {1, 2, 3, 4, 5});
    EXPECT_EQ(contents(every), expected);
  }
}

TEST(Run, ExtendedIsTheSameAsAskedForAtFirst) {
  const TemporaryDirectory directory;
  for (const std::string kind : {"simple", "novelty"}) {
    const std::string name = kind;
    run_whole(directory.path() / (name + "-long"), tiny_experiment(kind, 6));
    run_whole(directory.path() / name, tiny_experiment(kind, 3));
    {
      const std::unique_ptr<Record> record = Record::resume(directory.path() / name, 1);
      check_new_generations(record->experiment(), 3, 6);
      record->change_generations(6);
      run(*record, {1, {}, {}});
    }
    EXPECT_EQ(contents(directory.path() / name), contents(directory.path() / (name + "-long")));
  }
}

TEST(Run, RefusesGenerationsThatContradictTheRun) {
  const Experiment simple = tiny_experiment("simple", 6);
  EXPECT_NO_THROW(check_new_generations(simple, 3, 3));
  EXPECT_NO_THROW(check_new_generations(simple, 3, 60));
  EXPECT_THAT(lines_of([&] { check_new_generations(simple, 3, 2); }),
              ElementsAre(HasSubstr("--generations 2: expected at least 3")));
  const Experiment progressive = tiny_experiment("progressive", 6);
  EXPECT_NO_THROW(check_new_generations(progressive, 3, 6));
  EXPECT_THAT(lines_of([&] { check_new_generations(progressive, 3, 9); }),
              ElementsAre(HasSubstr("--generations 9: expected 6: progressive")));
}

TEST(Run, ResumingAFinishedRunChangesNothing) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  run_whole(path, tiny_experiment("simple", 2));
  const auto before = contents(path);
  {
    const std::unique_ptr<Record> record = Record::resume(path, 1);
    EXPECT_EQ(run(*record, {1, {}, {}}).generations_done, 2);
  }
  EXPECT_EQ(contents(path), before);
}

// A run that may not go on is left as it was: not even a session is written.
TEST(Run, ARefusalToGoOnIsNotRecorded) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  run_whole(path, tiny_experiment("simple", 2));
  const std::string before = tests::text_of(path / "run.db");
  const auto refuse = [](Record& record) {
    throw InputError(fmt::format("not after {}", record.generations_done()));
  };
  EXPECT_THAT(lines_of([&] { Record::resume(path, 1, refuse); }), ElementsAre("not after 2"));
  EXPECT_TRUE(tests::text_of(path / "run.db") == before);
  Record::resume(path, 1, [](Record&) {});
  EXPECT_FALSE(tests::text_of(path / "run.db") == before);
}

TEST(Run, ChampionsReplayToTheRecordedBits) {
  const TemporaryDirectory directory;
  for (const std::string& kind : kinds) {
    const auto path = directory.path() / kind;
    run_whole(path, tiny_experiment(kind, 6));
    const RunReader reader(path);
    const Experiment e = reader.experiment();
    Evaluator evaluator(rules_of(e), 1);
    for (int generation = 0; generation < 6; ++generation) {
      const Champion champion = reader.champion(generation);
      const Evaluated again = evaluator.evaluate_fully(compile(champion.genome), generation);
      EXPECT_EQ(geometric_mean(evaluation_of(again)), champion.eq6) << generation;
      for (std::size_t t = 0; t < e.trials.size(); ++t) {
        EXPECT_EQ(again.trials[t].distance, champion.distances[t]);
        EXPECT_EQ(core::name(again.trials[t].status), champion.statuses[t]);
      }
    }
    // The best of the run is the best of its champions.
    double best = 0;
    for (int generation = 0; generation < 6; ++generation) {
      best = std::max(best, reader.champion(generation).eq6);
    }
    EXPECT_EQ(reader.best().eq6, best);
  }
}

TEST(Run, CellsBetweenStagesBalance) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  run_whole(path, tiny_experiment("novelty", 4));
  Database database(path / "run.db", Database::Mode::read);
  Statement rows(database,
                 "SELECT count(*), sum(from_cells + born - died != to_cells), sum(born), "
                 "min(born), min(died) FROM metamorphosis");
  rows.step();
  EXPECT_EQ(rows.integer(0), 4 * 12);
  EXPECT_EQ(rows.integer(1), 0);  // cells are conserved
  EXPECT_GT(rows.integer(2), 0);
  EXPECT_GE(rows.integer(3), 0);
  EXPECT_GE(rows.integer(4), 0);
}

TEST(Run, AnotherInputIsInheritedAndThreadsAndPausesChangeNoBit) {
  const TemporaryDirectory directory;
  Experiment e = tiny_experiment("simple", 4);
  e.development.inputs.push_back(core::Input::neighbours);
  run_whole(directory.path() / "1", e, 1);
  run_whole(directory.path() / "2", e, 2);
  run_in_pieces(directory.path() / "pieces", e, {2});
  EXPECT_EQ(contents(directory.path() / "1"), contents(directory.path() / "2"));
  EXPECT_EQ(contents(directory.path() / "1"), contents(directory.path() / "pieces"));
  const RunReader run(directory.path() / "1");
  EXPECT_EQ(run.experiment().development.inputs, e.development.inputs);
  const Genome champion = run.champion(3).genome;
  EXPECT_EQ(champion.nodes.front(), (NodeGene{node_id(core::Input::neighbours), NodeKind::input}));
  EXPECT_TRUE(std::any_of(champion.links.begin(), champion.links.end(),
                          [](const LinkGene& link) { return link.from == -1; }));
}

TEST(Generation, BestIsByEq6ThenScoreThenPosition) {
  EXPECT_EQ(best_position({1, 3, 2}, {9, 0, 9}), 1u);
  EXPECT_EQ(best_position({0, 0, 0}, {1, 2, 2}), 1u);
  EXPECT_EQ(best_position({5, 5}, {1, 1}), 0u);
}

}  // namespace
}  // namespace metamorph::evolve
