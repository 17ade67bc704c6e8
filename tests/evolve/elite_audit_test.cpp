#include "evolve/run/elite_audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

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

/// A short run of map-elites, made once, and a copy of its record for every test.
class EliteAuditTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = std::make_unique<TemporaryDirectory>();
    Experiment e = tiny_experiment("map-elites", 5);
    e.search.values["axes"] = std::vector<std::string>{"adult.x"};
    e.search.values["axis_low"] = std::vector<double>{-1};
    e.search.values["axis_high"] = std::vector<double>{1};
    run_whole(made_->path() / "run", e);
  }
  static void TearDownTestSuite() { made_.reset(); }

  EliteAuditTest() { std::filesystem::copy(made_->path() / "run", path()); }

  std::filesystem::path path() const { return directory_.path() / "run"; }

  static std::unique_ptr<TemporaryDirectory> made_;
  TemporaryDirectory directory_;
};

std::unique_ptr<TemporaryDirectory> EliteAuditTest::made_;

EliteAuditOptions options(int starts, double displacement, int threads) {
  EliteAuditOptions result;
  result.starts = starts;
  result.displacement = displacement;
  result.threads = threads;
  return result;
}

TEST_F(EliteAuditTest, FromStartsThatDoNotDifferTheMapIsAsRecorded) {
  const MapAudit audited = audit_elites(RunReader(path()), options(2, 0, 1));
  EXPECT_EQ(audited.niches, 20);
  ASSERT_GT(audited.elites.size(), 1u);
  double sum = 0;
  for (const EliteAudit& elite : audited.elites) {
    EXPECT_EQ(elite.corrected, elite.recorded);
    sum += elite.recorded;
  }
  EXPECT_NEAR(audited.qd_score, sum, 1e-14 * sum);
  EXPECT_EQ(audited.corrected, audited.qd_score);
  EXPECT_EQ(audited.fallen, 0);
  // As the search told of its map last.
  Database database(path() / "run.db", Database::Mode::read);
  Statement last(database, "SELECT qd_score, filled FROM qd WHERE generation = 4");
  ASSERT_TRUE(last.step());
  EXPECT_EQ(last.real(0), audited.qd_score);
  EXPECT_EQ(last.integer(1), static_cast<std::int64_t>(audited.elites.size()));
}

TEST_F(EliteAuditTest, FreshStartsGiveOtherDistancesAndTheSameForAnyThreads) {
  const RunReader run(path());
  const MapAudit one = audit_elites(run, options(3, 1e-2, 1));
  const MapAudit two = audit_elites(run, options(3, 1e-2, 2));
  int other = 0;
  ASSERT_EQ(one.elites.size(), two.elites.size());
  for (std::size_t e = 0; e < one.elites.size(); ++e) {
    EXPECT_EQ(one.elites[e].corrected, two.elites[e].corrected);
    other += one.elites[e].corrected != one.elites[e].recorded ? 1 : 0;
  }
  EXPECT_GT(other, 0);
}

TEST_F(EliteAuditTest, TellsWhoFallsBelowHalf) {
  // What is recorded three times too high is found at a third of it.
  tests::falsify(path(), "UPDATE elites SET quality = quality * 3 WHERE quality > 0");
  const MapAudit audited = audit_elites(RunReader(path()), options(1, 0, 1));
  int living = 0;
  for (const EliteAudit& elite : audited.elites) living += elite.recorded > 0 ? 1 : 0;
  EXPECT_GT(living, 0);
  EXPECT_EQ(audited.fallen, living);
  EXPECT_NEAR(audited.corrected, audited.qd_score / 3, 1e-12);
}

TEST_F(EliteAuditTest, IsACommand) {
  const MapAudit audited = audit_elites(RunReader(path()), options(2, 1e-3, 1));
  const auto told = run_program(directory_.path(), "audit run --elites 2 --json --threads 1");
  ASSERT_EQ(told.exit_code, 0) << told.err;
  std::istringstream text(told.out);
  std::vector<Json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
  ASSERT_EQ(lines.size(), audited.elites.size() + 1);
  EXPECT_EQ(lines[0].at("corrected"), audited.elites[0].corrected);
  EXPECT_EQ(lines.back().at("qd_score"), audited.qd_score);
  EXPECT_EQ(lines.back().at("corrected_qd_score"), audited.corrected);
  const auto table = run_program(directory_.path(), "audit run --elites 2 --threads 1");
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("of 20 niches filled; QD score "));
  // The other commands take such a run as any other.
  for (const std::string command : {"info run", "info run --json", "export run --table elites",
                                    "export run --champion best", "audit run --champions 1"}) {
    const auto other = run_program(directory_.path(), command);
    EXPECT_EQ(other.exit_code, 0) << command << ": " << other.err;
    EXPECT_FALSE(other.out.empty()) << command;
  }
  EXPECT_THAT(run_program(directory_.path(), "info run").out, HasSubstr("of 20 niches filled"));
}

TEST_F(EliteAuditTest, ARunWithoutElitesGetsALine) {
  run_whole(directory_.path() / "simple", tiny_experiment("simple", 1));
  EXPECT_THAT(lines_of([&] { audit_elites(RunReader(directory_.path() / "simple"), {}); }),
              ElementsAre(HasSubstr("has no table elites: expected a run of map-elites")));
  tests::falsify(path(), "DELETE FROM elites");
  EXPECT_THAT(lines_of([&] { audit_elites(RunReader(path()), {}); }),
              ElementsAre(HasSubstr("no niche is filled yet")));
}

}  // namespace
}  // namespace metamorph::evolve
