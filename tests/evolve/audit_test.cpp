#include "evolve/run/audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "evolve/run/nearby_starts.h"
#include "metamorph/body.h"
#include "tests/evolve/files.h"
#include "tests/evolve/program.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::Json;
using tests::lines_of;
using tests::run_program;
using tests::run_whole;
using tests::TemporaryDirectory;
using tests::tiny_experiment;

/// A short run, made once, and a copy of its record for every test.
class Audit : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = std::make_unique<TemporaryDirectory>();
    run_whole(made_->path() / "run", tiny_experiment("simple", 6));
  }
  static void TearDownTestSuite() { made_.reset(); }

  Audit() { std::filesystem::copy(made_->path() / "run", path()); }

  std::filesystem::path path() const { return directory_.path() / "run"; }
  void change(const std::string& sql) const { tests::falsify(path(), sql); }

  static std::unique_ptr<TemporaryDirectory> made_;
  TemporaryDirectory directory_;
};

std::unique_ptr<TemporaryDirectory> Audit::made_;

TEST_F(Audit, AReplayGivesTheRecordedBits) {
  const RunReader run(path());
  const RunAudit audited = audit(run, {});
  EXPECT_EQ(audited.other_bits, 0);
  EXPECT_EQ(audited.distinct, static_cast<int>(audited.champions.size()));
  ASSERT_FALSE(audited.champions.empty());
  EXPECT_EQ(audited.champions.back().champion.eq6, run.best().eq6);
  for (const ChampionAudit& champion : audited.champions) {
    EXPECT_TRUE(champion.same_bits);
    EXPECT_EQ(champion.replay_eq6, champion.champion.eq6);
    EXPECT_EQ(champion.deviation, champion.replay_deviation);
  }
  EXPECT_EQ(confirmed_within(audited, 1, false), audited.distinct);
  EXPECT_EQ(confirmed_within(audited, -1, true), 0);
}

TEST_F(Audit, AChampionThatStaysIsAuditedOnce) {
  // Elites are kept, so eq 6 of the champions of a simple search never falls: equal is unchanged.
  const RunReader run(path());
  const RunAudit audited = audit(run, {});
  int changes = 1;
  for (int g = 1; g < run.generations_done(); ++g) {
    if (run.champion(g).genome != run.champion(g - 1).genome) ++changes;
  }
  EXPECT_EQ(audited.distinct, changes);
}

TEST_F(Audit, KeepsTheBestOfTheGenerationsAskedFor) {
  const RunReader run(path());
  AuditOptions options;
  options.champions = 1;
  const RunAudit best = audit(run, options);
  ASSERT_EQ(best.champions.size(), 1u);
  EXPECT_EQ(best.champions[0].champion.eq6, run.best().eq6);
  options.every = 100;  // generation 0 alone
  const RunAudit first = audit(run, options);
  EXPECT_EQ(first.distinct, 1);
  EXPECT_EQ(first.champions[0].champion.individual, run.champion(0).individual);
}

// Distance earned by numerical error would show as record above reference. Over 60 paper steps no
// gait has time to part from its neighbours, so what is left is the error of the step, h^2 times a
// number of order 1 of the distance (0.04 in water, 0.01 on land), and that of the start of
// actuation on land, where settling is cut short here (60 paper steps) and first order.
TEST_F(Audit, ChampionsEarnNoDistanceFromTheStep) {
  const RunAudit audited = audit(RunReader(path()), {});
  for (const ChampionAudit& champion : audited.champions) {
    EXPECT_TRUE(champion.trials[0].compared);
    EXPECT_LT(std::abs(champion.trials[0].deviation), 0.04);
  }
}

TEST_F(Audit, TellsAFalsifiedDistance) {
  change("UPDATE outcomes SET distance = distance * 1.5 WHERE trial = 0");
  const RunAudit audited = audit(RunReader(path()), {});
  EXPECT_EQ(audited.other_bits, static_cast<int>(audited.champions.size()));
  for (const ChampionAudit& champion : audited.champions) {
    EXPECT_FALSE(champion.trials[0].same_bits);
    EXPECT_TRUE(champion.trials[1].same_bits);
    // 1.5 times a distance is a third less than it, seen from the larger one.
    EXPECT_NEAR(champion.trials[0].deviation, 1.0 / 3, 0.04);
  }
  const auto told = run_program(directory_.path(), "audit run");
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_THAT(told.out, HasSubstr("do not give the recorded numbers"));
}

TEST_F(Audit, TellsAFalsifiedFitness) {
  change("UPDATE champions SET eq6 = eq6 * (1 + 1e-15) + 1e-300 WHERE generation = 5");
  change("UPDATE champions SET eq6 = 1000 WHERE generation = 0");
  const RunAudit audited = audit(RunReader(path()), {});
  EXPECT_GE(audited.other_bits, 1);
  EXPECT_FALSE(audited.champions.front().same_bits);
  EXPECT_GT(audited.champions.front().deviation, 0.99);
}

TEST_F(Audit, ARecordedFailureIsNotHeldAgainstTheReference) {
  change("UPDATE outcomes SET distance = 0, status = 'inverted' WHERE trial = 1");
  const RunAudit audited = audit(RunReader(path()), {});
  for (const ChampionAudit& champion : audited.champions) {
    EXPECT_FALSE(champion.trials[1].compared);
    EXPECT_FALSE(champion.trials[1].same_bits);
  }
  EXPECT_EQ(audited.trials[1].recorded.count, 0);
}

TEST_F(Audit, ATrialThatWasNotRunIsLeftOut) {
  change("DELETE FROM outcomes WHERE trial = 1");
  const RunAudit audited = audit(RunReader(path()), {});
  EXPECT_EQ(audited.other_bits, 0);
  EXPECT_FALSE(audited.champions.front().trials[1].recorded);
}

TEST_F(Audit, JsonHoldsALinePerChampionAndTrialAndOneForTheRun) {
  const RunAudit audited = audit(RunReader(path()), {});
  const auto told = run_program(directory_.path(), "audit run --json --threads 1");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  std::istringstream text(told.out);
  std::vector<Json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
  ASSERT_EQ(lines.size(), 2 * audited.champions.size() + 1);
  EXPECT_EQ(lines[0].at("trial"), "larva");
  EXPECT_EQ(lines[1].at("trial"), "adult");
  EXPECT_EQ(lines[1].at("nearby").at("starts"), 4);
  EXPECT_EQ(lines[0].at("reference_distance"), audited.champions[0].trials[0].reference.distance);
  EXPECT_EQ(lines.back().at("deviation").at("worst"), audited.recorded.worst);
  EXPECT_EQ(lines.back().at("other_bits"), 0);
  EXPECT_EQ(lines.back().at("trials").at(1).at("nearby").at("disturbed_starts"),
            4 * audited.trials[1].nearby);
}

TEST_F(Audit, TableEndsWithHowFarToTrust) {
  const auto told = run_program(directory_.path(), "audit run --champions 1");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("every replay gives the recorded bits"));
  EXPECT_THAT(told.out, HasSubstr("\ntrust: the reference confirms eq 6 of "));
}

TEST_F(Audit, WrongInputGetsALine) {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"audit none", "none: no such file"},
      {"audit run --champions 0", "--champions"},
      {"audit run --every 0", "--every"},
      {"audit run --nearby -1", "--nearby"},
      {"audit", "RUN"},
  };
  for (const auto& [arguments, line] : table) {
    const auto told = run_program(directory_.path(), arguments);
    EXPECT_EQ(told.exit_code, 2) << arguments;
    ASSERT_EQ(told.err_lines().size(), 1u) << told.err;
    EXPECT_THAT(told.err, HasSubstr(line));
  }
  {
    const Record made(directory_.path() / "made", tiny_experiment("simple", 1), 1);
  }
  EXPECT_THAT(lines_of([&] { audit(RunReader(directory_.path() / "made"), {}); }),
              ElementsAre(HasSubstr("no generation is recorded yet")));
}

TEST(AuditArithmetic, DeviationIsRelativeToTheLarger) {
  EXPECT_EQ(relative_deviation(0, 0), 0);
  EXPECT_EQ(relative_deviation(2, 0), 1);
  EXPECT_EQ(relative_deviation(0, 2), -1);
  EXPECT_EQ(relative_deviation(4, 3), 0.25);
  EXPECT_EQ(relative_deviation(3, 4), -0.25);
}

TEST(AuditArithmetic, RangeOfDeviations) {
  const DeviationRange range = range_of({0.1, -0.4, 0.2});
  EXPECT_EQ(range.count, 3);
  EXPECT_EQ(range.worst, -0.4);
  EXPECT_EQ(range.median, 0.2);
  EXPECT_EQ(range.bias, 0.1);
  EXPECT_EQ(range_of({0.25, -0.75}).bias, -0.25);
  EXPECT_EQ(range_of({}).count, 0);
}

TEST(AuditArithmetic, KendallTau) {
  EXPECT_EQ(kendall_tau({}, {}), 1);
  EXPECT_EQ(kendall_tau({1, 2, 3}, {10, 20, 30}), 1);
  EXPECT_EQ(kendall_tau({1, 2, 3}, {30, 20, 10}), -1);
  EXPECT_DOUBLE_EQ(kendall_tau({1, 2, 3}, {1, 3, 2}), 1.0 / 3);  // two of three pairs agree
  // tau-b: 2 agreeing pairs, 1 tied in a; sqrt(2 * 3).
  EXPECT_DOUBLE_EQ(kendall_tau({1, 1, 2}, {1, 2, 3}), 2 / std::sqrt(6.0));
}

/// A strip of `columns` squares, cut in triangles, with a wave of phases along it.
core::Body strip(int columns) {
  core::Body body;
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j < 2; ++j) {
      body.x.push_back(i);
      body.y.push_back(j);
      body.period.push_back(20);
      body.phase.push_back(0.9 * i);
    }
  }
  for (int i = 0; i < columns; ++i) {
    body.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    body.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  core::set_rest_from_nodes(body);
  return body;
}

TEST(NearbyStarts, WaterForgetsThem) {
  // Nothing in water depends on where a body is, and springs and drag damp a change of shape: what
  // remains of it is a displacement as a whole, no larger than the change, and a turn of up to
  // displacement / length, which moves no distance.
  const NearbyStarts nearby =
      run_nearby_starts(strip(8), core::water_scene(), core::Method::drift_kick_drift, 2, 1e-6);
  EXPECT_EQ(nearby.starts, 2);
  EXPECT_EQ(nearby.failed, 0);
  EXPECT_FALSE(nearby.parted);
  EXPECT_EQ(nearby.predictable_for, 600);
  EXPECT_LT(nearby.spread, 1e-4);
  EXPECT_GT(nearby.growth, 0);
}

TEST(NearbyStarts, LandPartsThemMoreTheFartherTheyStart) {
  const core::Scene land = core::land_scene();
  const NearbyStarts near =
      run_nearby_starts(strip(8), land, core::Method::drift_kick_drift, 2, 1e-9);
  const NearbyStarts far =
      run_nearby_starts(strip(8), land, core::Method::drift_kick_drift, 2, 0.05);
  EXPECT_EQ(near.starts, 2);
  EXPECT_GT(far.spread, near.spread);
  // The mean of the changed starts lies no farther from the unchanged one than the farthest, and
  // the unchanged one is the same in both.
  EXPECT_LE(std::abs(far.mean - near.mean), far.spread + near.spread);
  EXPECT_LE(far.predictable_for, near.predictable_for);
}

TEST(NearbyStarts, AStartThatFailsHasNone) {
  core::Scene scene = core::water_scene();
  scene.step = 2;  // beyond the limit
  const NearbyStarts nearby =
      run_nearby_starts(strip(3), scene, core::Method::drift_kick_drift, 3, 1e-6);
  EXPECT_EQ(nearby.starts, 0);
}

}  // namespace
}  // namespace metamorph::evolve
