#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "evolve/run/run.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"
#include "tests/outcomes.h"

namespace metamorph::evolve {
namespace {

using tests::contents;
using tests::networks_of;
using tests::run_whole;
using tests::TemporaryDirectory;
using tests::text_of;
using tests::tiny_experiment;

constexpr int die_output = node_id(core::Output::die);

TEST(Run, ThreadsChangeNoBit) {
  const TemporaryDirectory directory;
  for (const std::string name : {"simple", "progressive", "novelty"}) {
    const Experiment e = tiny_experiment(name, 5);
    run_whole(directory.path() / (name + "-1"), e, 1);
    run_whole(directory.path() / (name + "-2"), e, 2);
    EXPECT_EQ(contents(directory.path() / (name + "-1")),
              contents(directory.path() / (name + "-2")));
  }
}

TEST(RunWithStarts, ThreadsChangeNoBit) {
  const TemporaryDirectory directory;
  for (const bool renew : {false, true}) {
    const std::string name = renew ? "renewed" : "kept";
    Experiment e = tiny_experiment("simple", 4);
    e.trials[1].starts = 3;
    e.trials[1].starts_renew = renew;
    run_whole(directory.path() / (name + "-1"), e, 1);
    run_whole(directory.path() / (name + "-2"), e, 2);
    EXPECT_EQ(contents(directory.path() / (name + "-1")),
              contents(directory.path() / (name + "-2")));
  }
}

std::string text_of(const Evaluated& one) {
  std::string text = fmt::format("{} {} {}", one.penalty, one.created, one.died);
  for (std::size_t t = 0; t < one.stages.size(); ++t) {
    const StageCounts& stage = one.stages[t];
    text += fmt::format(" [{} {} {} {}: {}]", one.evaluated[t], stage.cells, stage.created,
                        stage.died, text_of(one.trials[t]));
    for (const DescriptorField& field : descriptor_fields) {
      text += fmt::format(" {} {:a}", field.name, one.descriptors[t].*field.member);
    }
  }
  return text;
}

std::int64_t bodies_in(const std::vector<Evaluated>& results) {
  std::int64_t bodies = 0;
  for (const Evaluated& one : results) {
    for (const core::Outcome& outcome : one.trials) bodies += outcome.cells > 0;
  }
  return bodies;
}

/// Genomes with others that grow the same: copies; copies with a hidden node that reaches no output
/// (the same network); copies whose output "die" has another weight, too weak to matter (another
/// network, the same bodies).
std::vector<Genome> with_repetitions(const std::vector<Genome>& genomes) {
  std::vector<Genome> all = genomes;
  for (const Genome& genome : genomes) {
    all.push_back(genome);
    Genome dead_end = genome;
    const int node = genome.nodes.back().id + 1, link = genome.links.back().innovation + 1;
    dead_end.nodes.push_back({node, NodeKind::hidden});
    dead_end.links.push_back({link, 0, node, 0.5});
    all.push_back(dead_end);
    Genome neutral = genome;
    for (LinkGene& gene : neutral.links) {
      if (gene.to == die_output) gene.weight *= 1 + 0x1p-20;
    }
    all.push_back(neutral);
  }
  return all;
}

TEST(Evaluator, ThreadsAndIdenticalWorkDoneOnceChangeNoBit) {
  const Experiment e = tiny_experiment("simple", 2);
  const std::vector<Genome> distinct = first_generation(e.neat, 5).genomes;
  const std::vector<Genome> genomes = with_repetitions(distinct);
  const std::vector<core::Network> networks = networks_of(genomes);
  const std::vector<std::uint8_t> both = {1, 1};
  const auto n = static_cast<std::int64_t>(distinct.size());
  for (const int threads : {1, 2}) {
    Evaluator evaluator(rules_of(e), threads);
    const auto results = evaluator.evaluate(networks_of(genomes), both, 0);
    for (std::size_t i = 0; i < genomes.size(); ++i) {
      // A new evaluator and one genome: nothing there to be the same as.
      EXPECT_EQ(text_of(results[i]),
                text_of(Evaluator(rules_of(e), 1).evaluate({&networks[i], 1}, both, 0).front()))
          << i;
    }
    EXPECT_EQ(evaluator.work().individuals, 4 * n);
    EXPECT_EQ(evaluator.work().developed, 2 * n);  // the original and the neutral one
    EXPECT_EQ(evaluator.work().bodies, bodies_in(results));
    EXPECT_GT(evaluator.work().simulated, 0);
    EXPECT_EQ(evaluator.work().simulated * 4, evaluator.work().bodies);

    // In the next generation the originals are known, and so are the bodies of the neutral ones.
    Evaluator other(rules_of(e), threads);
    other.evaluate(networks_of(distinct), both, 0);
    const auto later = other.evaluate(networks_of(genomes), both, 0);
    for (std::size_t i = 0; i < genomes.size(); ++i) {
      EXPECT_EQ(text_of(later[i]), text_of(results[i])) << i;
    }
    EXPECT_EQ(other.work().developed, n);
    EXPECT_EQ(other.work().bodies, bodies_in(later));
    EXPECT_EQ(other.work().simulated, 0);
  }
}

// More than are developed at a time; the last ones are copies of the first.
TEST(Evaluator, BlocksOfAGenerationChangeNoBit) {
  Experiment e = tiny_experiment("simple", 2);
  e.development.steps = 60;
  e.development.max_cells = 8;
  e.min_cells = 3;
  e.trials[0].stage = 40;
  e.trials[1].stage = 60;
  for (NamedScene& named : e.scenes) named.scene.run_steps = 2;
  const std::size_t distinct = Evaluator::most_at_once + 50, all = distinct + 100;
  e.neat.population = static_cast<int>(distinct);
  std::vector<Genome> genomes = first_generation(e.neat, 5).genomes;
  genomes.insert(genomes.end(), genomes.begin(), genomes.begin() + 100);
  const std::vector<core::Network> networks = networks_of(genomes);
  const std::vector<std::uint8_t> both = {1, 1};
  Evaluator evaluator(rules_of(e), 2);
  const auto results = evaluator.evaluate(networks, both, 0);
  ASSERT_EQ(results.size(), all);
  EXPECT_EQ(evaluator.work().developed, static_cast<std::int64_t>(distinct));
  EXPECT_GT(evaluator.work().simulated, 0);
  std::set<std::string> different;
  for (std::size_t i = 0; i < all; ++i) {
    if (i >= distinct) {
      EXPECT_EQ(text_of(results[i]), text_of(results[i - distinct])) << i;
    }
    different.insert(text_of(results[i]));
    if (i % 97 != 0 && (i < Evaluator::most_at_once - 3 || i > Evaluator::most_at_once + 3))
      continue;
    EXPECT_EQ(text_of(results[i]),
              text_of(Evaluator(rules_of(e), 1).evaluate({&networks[i], 1}, both, 0).front()))
        << i;
  }
  EXPECT_GT(different.size(), 10u);
  // Once more: all of them are known, in whichever block they stood.
  const auto again = evaluator.evaluate(networks, both, 0);
  EXPECT_EQ(evaluator.work().developed, 0);
  EXPECT_EQ(evaluator.work().simulated, 0);
  for (std::size_t i = 0; i < all; ++i) EXPECT_EQ(text_of(again[i]), text_of(results[i])) << i;
}

}  // namespace
}  // namespace metamorph::evolve
