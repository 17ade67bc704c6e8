#include "evolve/evaluation/starts.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "evolve/evaluation/displaced.h"
#include "evolve/evaluation/fingerprint.h"
#include "evolve/run/audit.h"
#include "evolve/run/run_reader.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"
#include "metamorph/locomotion.h"
#include "tests/bodies.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"
#include "tests/outcomes.h"

namespace metamorph::evolve {
namespace {

using core::Status;
using testing::HasSubstr;
using tests::contents;
using tests::networks_of;
using tests::run_in_pieces;
using tests::run_whole;
using tests::TemporaryDirectory;
using tests::text_of;
using tests::tiny_experiment;

constexpr StartsCombine rules[] = {StartsCombine::mean, StartsCombine::median,
                                   StartsCombine::least};

/// The larva runs once, the adult from several starts.
Experiment with_starts(Experiment e, int starts, bool renew) {
  Trial& adult = e.trials[1];
  adult.starts = starts;
  adult.starts_renew = renew;
  return e;
}

Experiment tiny_with_starts(const std::string& kind, int generations, bool renew) {
  return with_starts(tiny_experiment(kind, generations), 3, renew);
}

core::Outcome outcome(Status status, double distance, double x = 0, int steps = 0) {
  core::Outcome o;
  o.status = status;
  o.distance = distance;
  o.mean_position = {x, -x};
  o.steps = steps;
  return o;
}

TEST(CombineStarts, OfOneItIsThatOneToTheBit) {
  for (const core::Outcome& one :
       {outcome(Status::ok, 0.1, 0.7, 5), outcome(Status::not_settled, 3, -1, 6),
        outcome(Status::inverted, 0, 2, 7)}) {
    for (const StartsCombine rule : rules) {
      EXPECT_EQ(text_of(combine_starts(std::array{one}, rule)), text_of(one));
    }
  }
}

TEST(CombineStarts, RanksByDistance) {
  // `steps` says which one it is.
  const std::array starts = {outcome(Status::ok, 8, 80, 0), outcome(Status::ok, 2, 20, 1),
                             outcome(Status::not_settled, 4, 40, 2), outcome(Status::ok, 6, 60, 3)};
  const core::Outcome least = combine_starts(starts, StartsCombine::least);
  EXPECT_EQ(text_of(least), text_of(starts[1]));
  const core::Outcome median = combine_starts(starts, StartsCombine::median);
  EXPECT_EQ(text_of(median), text_of(starts[2]));  // of 4 and 6 the lower
  const core::Outcome mean = combine_starts(starts, StartsCombine::mean);
  EXPECT_EQ(mean.status, Status::not_settled);  // the rest is that of the median
  EXPECT_EQ(mean.steps, 2);
  EXPECT_EQ(mean.distance, 5);
  EXPECT_EQ(mean.mean_position[0], 50);
  EXPECT_EQ(mean.mean_position[1], -50);
  EXPECT_EQ(combine_starts(std::span(starts).first(3), StartsCombine::median).steps, 2);
}

TEST(CombineStarts, MeansAreOfWhatDescribesTheGaitToo) {
  std::array starts = {outcome(Status::ok, 8), outcome(Status::speed, 0), outcome(Status::ok, 2),
                       outcome(Status::ok, 5)};
  for (std::size_t s = 0; s < starts.size(); ++s) {
    starts[s].height = static_cast<double>(s);  // 0, 2 and 3 did not fail
    starts[s].stance = static_cast<double>(s) / 10;
    starts[s].gait_frequency = static_cast<double>(s) / 100;
  }
  const core::Outcome mean = combine_starts(starts, StartsCombine::mean);
  EXPECT_DOUBLE_EQ(mean.height, 5.0 / 3);
  EXPECT_DOUBLE_EQ(mean.stance, 0.5 / 3);
  EXPECT_DOUBLE_EQ(mean.gait_frequency, 0.05 / 3);
  EXPECT_EQ(combine_starts(starts, StartsCombine::median).height, 2);
}

TEST(CombineStarts, AFailureCountsNothing) {
  const std::array starts = {outcome(Status::ok, 6, 60, 0), outcome(Status::ok, 0, 30, 1),
                             outcome(Status::speed, 0, 999, 2), outcome(Status::ok, 3, 0, 3)};
  EXPECT_EQ(combine_starts(starts, StartsCombine::least).status, Status::speed);
  EXPECT_EQ(combine_starts(starts, StartsCombine::least).distance, 0);
  // The failure is ranked below the start that ran and went nowhere.
  EXPECT_EQ(combine_starts(starts, StartsCombine::median).steps, 1);
  const core::Outcome mean = combine_starts(starts, StartsCombine::mean);
  EXPECT_EQ(mean.status, Status::ok);
  EXPECT_EQ(mean.distance, 9.0 / 4);
  EXPECT_EQ(mean.mean_position[0], 30);  // of three
}

TEST(CombineStarts, WhereTheMedianFailsTheBodyDoes) {
  const std::array starts = {outcome(Status::ok, 6, 60, 0), outcome(Status::collapsed, 0, 5, 1),
                             outcome(Status::speed, 0, 7, 2), outcome(Status::ok, 9, 90, 3)};
  for (const StartsCombine rule : rules) {
    const core::Outcome combined = combine_starts(starts, rule);
    EXPECT_TRUE(core::is_failure(combined.status));
    EXPECT_EQ(combined.distance, 0);
  }
  // Of equals the earlier first.
  EXPECT_EQ(combine_starts(starts, StartsCombine::least).steps, 1);
  EXPECT_EQ(combine_starts(starts, StartsCombine::mean).steps, 2);
}

TEST(StartOf, TheFirstIsTheBodyAsItIsUnlessRenewed) {
  const core::Body body = tests::disc_body(19);
  Trial trial;
  EXPECT_EQ(fingerprint(start_of(body, trial, 0, 1, 5)), fingerprint(body));
  EXPECT_NE(fingerprint(start_of(body, trial, 1, 1, 5)), fingerprint(body));
  trial.starts_renew = true;
  EXPECT_NE(fingerprint(start_of(body, trial, 0, 1, 5)), fingerprint(body));
}

TEST(StartOf, DependsOnSeedAndStartAndWhereRenewedOnTheGeneration) {
  const core::Body body = tests::disc_body(19);
  Trial kept, renewed;
  renewed.starts_renew = true;
  const auto print = [&](const Trial& trial, int start, std::uint64_t seed, int generation) {
    return fingerprint(start_of(body, trial, start, seed, generation));
  };
  for (const Trial& trial : {kept, renewed}) {
    EXPECT_EQ(print(trial, 1, 1, 3), print(trial, 1, 1, 3));
    EXPECT_NE(print(trial, 1, 1, 3), print(trial, 2, 1, 3));
    EXPECT_NE(print(trial, 1, 1, 3), print(trial, 1, 2, 3));
  }
  EXPECT_EQ(print(kept, 1, 1, 3), print(kept, 1, 1, 4));
  EXPECT_NE(print(renewed, 1, 1, 3), print(renewed, 1, 1, 4));
}

TEST(StartOf, MovesNodesByTheirIndexWithinTheDisplacement) {
  const core::Body small = tests::disc_body(19), large = tests::disc_body(61);
  Trial trial;
  trial.start_displacement = 0.25;
  const core::Body a = start_of(small, trial, 1, 1, 0), b = start_of(large, trial, 1, 1, 0);
  double largest = 0;
  for (std::size_t i = 0; i < large.x.size(); ++i) {
    for (const double move : {b.x[i] - large.x[i], b.y[i] - large.y[i]}) {
      EXPECT_LE(std::abs(move), 0.25 * (1 + 1e-12));
      largest = std::max(largest, std::abs(move));
    }
    if (i >= small.x.size()) continue;
    EXPECT_NEAR(a.x[i] - small.x[i], b.x[i] - large.x[i], 1e-12);
    EXPECT_NEAR(a.y[i] - small.y[i], b.y[i] - large.y[i], 1e-12);
  }
  EXPECT_GT(largest, 0.2);  // of 122 draws
  EXPECT_EQ(b.rest_length, large.rest_length);
  EXPECT_EQ(b.rest_area, large.rest_area);
}

class StartsOfAGeneration : public testing::Test {
 protected:
  std::vector<Genome> genomes_ = [] {
    NeatSettings settings = tiny_experiment("simple", 2).neat;
    settings.population = 60;  // few genomes without a history have a body
    return first_generation(settings, 5).genomes;
  }();
  const std::vector<std::uint8_t> both_ = {1, 1};

  static std::vector<std::string> adults_of(const std::vector<Evaluated>& results) {
    std::vector<std::string> texts;
    for (const Evaluated& one : results) texts.push_back(text_of(one.trials[1]));
    return texts;
  }
  std::vector<std::string> fresh(const Experiment& e, int generation) const {
    return adults_of(Evaluator(rules_of(e), 1).evaluate(networks_of(genomes_), both_, generation));
  }
};

TEST_F(StartsOfAGeneration, AreRunAndCombinedAsTheTrialSays) {
  core::LocomotionOptions one_thread;
  one_thread.threads = 1;
  for (const bool renew : {false, true}) {
    for (const StartsCombine rule : rules) {
      Experiment e = tiny_with_starts("simple", 2, renew);
      e.trials[1].starts_combine = rule;
      const std::vector<std::string> results = fresh(e, 4);
      int moving = 0;
      for (std::size_t i = 0; i < genomes_.size(); ++i) {
        const core::Network network = compile(genomes_[i]);
        const std::vector<int> stage = {e.trials[1].stage};
        const auto embryo = core::develop({&network, 1}, e.development, stage, 1).front().front();
        const core::Extraction adult = core::extract_body(embryo, e.min_cells);
        if (adult.status != Status::ok) continue;
        std::vector<core::Outcome> outcomes;
        for (int s = 0; s < 3; ++s) {
          const core::Body body = start_of(adult.body, e.trials[1], s, e.seed, 4);
          const core::LocomotionTask task = {&body, &e.scene_of(e.trials[1])};
          outcomes.push_back(core::simulate({&task, 1}, one_thread).front());
        }
        EXPECT_EQ(results[i], text_of(combine_starts(outcomes, rule)));
        ++moving;
      }
      EXPECT_GE(moving, 5);
    }
  }
}

TEST_F(StartsOfAGeneration, ThatStayAreKnownToTheNext) {
  const Experiment e = tiny_with_starts("simple", 2, false);
  Evaluator evaluator(rules_of(e), 1);
  const auto first = evaluator.evaluate(networks_of(genomes_), both_, 0);
  EXPECT_GT(evaluator.work().simulated, 0);
  const auto second = evaluator.evaluate(networks_of(genomes_), both_, 1);
  EXPECT_EQ(evaluator.work().developed, 0);
  EXPECT_EQ(evaluator.work().simulated, 0);
  EXPECT_EQ(adults_of(second), adults_of(first));
  EXPECT_EQ(adults_of(second), fresh(e, 1));
}

TEST_F(StartsOfAGeneration, ThatAreRenewedAreRunAgainWithoutDevelopingAgain) {
  const Experiment e = tiny_with_starts("simple", 2, true);
  Evaluator evaluator(rules_of(e), 1);
  const auto first = evaluator.evaluate(networks_of(genomes_), both_, 0);
  const std::int64_t all = evaluator.work().simulated;
  std::int64_t larvae = 0, adults = 0;
  for (const Evaluated& one : first) {
    larvae += one.trials[0].cells > 0;
    adults += one.trials[1].cells > 0;
  }
  EXPECT_GT(adults, 0);
  EXPECT_EQ(all, larvae + 3 * adults);  // every start is counted
  // Thrice, as what is kept for the next generation must last beyond it.
  for (int generation = 1; generation <= 3; ++generation) {
    const auto later = evaluator.evaluate(networks_of(genomes_), both_, generation);
    EXPECT_EQ(evaluator.work().developed, 0);
    EXPECT_EQ(evaluator.work().simulated, 3 * adults);  // the larvae are known
    EXPECT_EQ(evaluator.work().bodies, all);
    EXPECT_NE(adults_of(later), adults_of(first));
    EXPECT_EQ(adults_of(later), fresh(e, generation));
  }
  // In the same generation once more nothing is new.
  evaluator.evaluate(networks_of(genomes_), both_, 3);
  EXPECT_EQ(evaluator.work().simulated, 0);
}

TEST_F(StartsOfAGeneration, OfEqualBodiesAreRunOnce) {
  const std::size_t n = genomes_.size();
  const std::vector<Genome> again = genomes_;
  genomes_.insert(genomes_.end(), again.begin(), again.end());
  for (const bool renew : {false, true}) {
    const Experiment e = tiny_with_starts("simple", 2, renew);
    Evaluator evaluator(rules_of(e), 1);
    const auto results = adults_of(evaluator.evaluate(networks_of(genomes_), both_, 7));
    EXPECT_EQ(evaluator.work().simulated * 2, evaluator.work().bodies);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(results[i], results[i + n]);
  }
}

// More simulations than are made at a time give what each body gives by itself.
TEST_F(StartsOfAGeneration, MayBeMany) {
  Experiment e = with_starts(tiny_experiment("simple", 2), 900, true);
  for (NamedScene& named : e.scenes) {
    named.scene.run_steps = 2;
    named.scene.settle_quiet_steps = 0;
    named.scene.settle_max_steps = 2;
  }
  Evaluator evaluator(rules_of(e), 2);
  const auto together = adults_of(evaluator.evaluate(networks_of(genomes_), both_, 1));
  EXPECT_GT(evaluator.work().simulated, 4096);
  for (std::size_t i = 0; i < genomes_.size(); ++i) {
    const Evaluated alone = Evaluator(rules_of(e), 1).evaluate_fully(compile(genomes_[i]), 1);
    EXPECT_EQ(together[i], text_of(alone.trials[1]));
  }
}

TEST(RunWithStarts, InterruptedAnywhereAndResumedIsTheSame) {
  const TemporaryDirectory directory;
  for (const std::string kind : {"simple", "progressive"}) {
    const std::string name = kind;
    const Experiment e = tiny_with_starts(kind, 6, true);
    run_whole(directory.path() / (name + "-whole"), e);
    const auto expected = contents(directory.path() / (name + "-whole"));
    for (const std::vector<int>& stops :
         {std::vector{1}, std::vector{3}, std::vector{1, 2, 3, 4, 5}}) {
      const auto pieces = directory.path() / fmt::format("{}-{}-{}", name, stops[0], stops.size());
      run_in_pieces(pieces, e, stops);
      EXPECT_EQ(contents(pieces), expected);
    }
  }
}

TEST(RunWithStarts, OtherStartsAreAnotherRun) {
  const TemporaryDirectory directory;
  const auto outcomes = [&](const std::string& name, const Experiment& e) {
    run_whole(directory.path() / name, e);
    return contents(directory.path() / name)["outcomes"];
  };
  const Experiment one = tiny_experiment("simple", 1);
  const auto as_it_is = outcomes("one", one);
  const auto renewed = outcomes("renewed", with_starts(one, 1, true));
  EXPECT_NE(as_it_is, renewed);
  EXPECT_NE(as_it_is, outcomes("three", with_starts(one, 3, false)));
  Experiment far = with_starts(one, 1, true);
  far.trials[1].start_displacement = 0.01;
  EXPECT_NE(renewed, outcomes("far", far));
}

// The best lives on as a copy, so its genome is seen again.
TEST(RunWithStarts, TheBestIsTriedAgainWhereStartsAreRenewed) {
  const TemporaryDirectory directory;
  for (const bool renew : {false, true}) {
    const auto path = directory.path() / (renew ? "renewed" : "kept");
    run_whole(path, with_starts(tiny_experiment("simple", 5), 1, renew));
    const RunReader reader(path);
    int stays = 0, same = 0;
    for (int g = 1; g < 5; ++g) {
      const Champion before = reader.champion(g - 1), now = reader.champion(g);
      if (now.genome != before.genome || now.distances[1] == 0) continue;
      ++stays;
      same += now.distances[1] == before.distances[1];
    }
    EXPECT_GT(stays, 0);
    EXPECT_EQ(same, renew ? 0 : stays);
  }
}

TEST(RunWithStarts, ReportsEveryStartAsAnEvaluation) {
  struct Counter : Reporter {
    std::int64_t evaluations = 0;
    void generation_done(const GenerationReport& report) override {
      evaluations += report.evaluations;
    }
  };
  const TemporaryDirectory directory;
  Counter counter;
  Record record(directory.path() / "run", tiny_with_starts("simple", 2, true), 1);
  run(record, {1, {}, {&counter}});
  EXPECT_EQ(counter.evaluations, 2 * 12 * (1 + 3));
}

// Progressive search runs no adults at first, but the best one's for the record.
TEST(RunWithStarts, AnAdultRunForTheRecordHasTheStartsOfItsGeneration) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "run";
  const Experiment e = tiny_with_starts("progressive", 9, true);
  run_whole(path, e);
  const RunReader reader(path);
  int moving = 0;
  for (const int generation : {1, 2}) {
    const Champion champion = reader.champion(generation);
    const Evaluated again =
        Evaluator(rules_of(e), 1).evaluate_fully(compile(champion.genome), generation);
    EXPECT_EQ(again.trials[1].distance, champion.distances[1]);
    moving += champion.distances[1] > 0;
  }
  EXPECT_GT(moving, 0);
}

TEST(RunWithStarts, AnAuditReplaysEveryChampionFromTheStartsOfItsGeneration) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "run";
  run_whole(path, tiny_with_starts("simple", 5, true));
  const RunReader reader(path);
  AuditOptions options;
  options.nearby_starts = 2;
  const RunAudit audited = audit(reader, options);
  EXPECT_EQ(audited.other_bits, 0);
  EXPECT_EQ(audited.champions.size(), 5u);  // each generation has results of its own
  for (const ChampionAudit& champion : audited.champions) {
    for (const TrialAudit& trial : champion.trials) EXPECT_TRUE(trial.same_bits);
    EXPECT_EQ(champion.trials[0].nearby.starts, 0);  // water
  }
  options.from = 4;
  options.nearby_in_water = true;
  const RunAudit last = audit(reader, options);
  ASSERT_EQ(last.champions.size(), 1u);
  EXPECT_EQ(last.champions[0].champion.generation, 4);
  EXPECT_EQ(last.champions[0].trials[0].nearby.starts, 2);
  options.from = 5;
  EXPECT_THAT(tests::lines_of([&] { audit(reader, options); }),
              testing::ElementsAre(HasSubstr("--from 5: expected a generation")));
}

}  // namespace
}  // namespace metamorph::evolve
