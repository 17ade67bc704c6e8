#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "evolve/genetics/distance.h"
#include "evolve/genetics/population.h"
#include "metamorph/development.h"
#include "metamorph/variation.h"
#include "tests/core/random_developments.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using core::testing::same;
using testing::hand_made;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::restless;
using testing::test_stream;
using ::testing::UnorderedElementsAre;
using testing::wander;

constexpr int forever = Stages::end_of_life;

NeatSettings separated(Separation separation, int stages = 2) {
  NeatSettings settings = restless();
  settings.move_gene = 1;
  settings.separation = separation;
  settings.stages = stages;
  return settings;
}

/// The embryos of a genome whose life has the stages up to 400 and up to 800.
std::vector<core::Embryo> grow(const Genome& genome) {
  core::DevelopmentRules rules;
  rules.steps = 800;
  const std::vector<core::Network> life = compile_stages(genome, {}, 2);
  const std::vector<int> switches = {400}, stages = {400, 800};
  return core::develop({&life, 1}, switches, rules, stages, 1).front();
}

/// What a genome has in one stage, as if it had no other.
Genome expressed(const Genome& genome, int stage) {
  Genome result{genome.nodes, {}};
  for (LinkGene link : genome.links) {
    if (stage < link.stages.first || stage > link.stages.last) continue;
    link.stages = {};
    result.links.push_back(link);
  }
  return result;
}

bool same_network(const core::Network& a, const core::Network& b) {
  return a.inputs == b.inputs && a.first_link == b.first_link && a.source == b.source &&
         a.weight == b.weight && a.output == b.output;
}

TEST(Stages, AreIntervals) {
  for (int a = 0; a < 4; ++a) {
    for (int b = a; b < 4; ++b) {
      for (int c = 0; c < 4; ++c) {
        for (int d = c; d < 4; ++d) {
          bool common = false;
          for (int k = 0; k < 4; ++k) {
            common |= Stages{a, b}.contains(k) && Stages{c, d}.contains(k);
          }
          EXPECT_EQ((Stages{a, b}.overlaps({c, d})), common);
        }
      }
    }
  }
}

TEST(PossibleStages, OfEachSeparation) {
  EXPECT_THAT(possible_stages(separated(Separation::none, 3)), UnorderedElementsAre(Stages{}));
  EXPECT_THAT(possible_stages(separated(Separation::partial, 3)),
              UnorderedElementsAre(Stages{}, Stages{1, forever}, Stages{2, forever}, Stages{0, 0},
                                   Stages{0, 1}));
  EXPECT_THAT(possible_stages(separated(Separation::full, 3)),
              UnorderedElementsAre(Stages{0, 0}, Stages{1, 1}, Stages{2, 2}));
}

TEST(CheckGenome, JudgesTheStagesOfLinks) {
  const auto faults = [](std::vector<LinkGene> links) {
    return check(hand_made({13, 14}, std::move(links)));
  };
  EXPECT_THAT(faults({{0, 0, 6, 1, {0, 0}}, {1, 0, 6, 1, {1, 1}}, {2, 0, 6, 1, {2, forever}}}),
              IsEmpty());
  EXPECT_THAT(faults({{0, 0, 6, 1, {0, 1}}, {1, 0, 6, 1, {1, forever}}}),
              ::testing::ElementsAre(HasSubstr("a second link between the same nodes")));
  for (const Stages wrong : {Stages{-1, 0}, Stages{2, 1}}) {
    EXPECT_THAT(faults({{0, 0, 6, 1, wrong}}),
                ::testing::ElementsAre(HasSubstr("the first of its stages")));
  }
  // Never expressed together, and still a cycle: a change of stages could close it.
  EXPECT_THAT(faults({{0, 13, 14, 1, {0, 0}}, {1, 14, 13, 1, {1, 1}}}),
              ::testing::ElementsAre(HasSubstr("cycle")));
}

TEST(CompileStages, GivesEachStageTheNetworkOfItsGenes) {
  for (const Separation separation : {Separation::partial, Separation::full}) {
    int apart = 0;
    wander(separated(separation, 3), 20, 20, 31, [&](const Genome& genome) {
      const auto life = compile_stages(genome, {}, 3);
      apart += life.size() == 3;
      for (std::size_t k = 0; k < 3; ++k) {
        const core::Network plain = compile(expressed(genome, static_cast<int>(k)));
        ASSERT_TRUE(same_network(life.size() == 1 ? life[0] : life[k], plain));
      }
      if (is_separated(genome)) {
        ASSERT_THROW(compile(genome), std::invalid_argument);
      }
    });
    EXPECT_GT(apart, 300);
  }
}

TEST(Separation, MutationsAndCrossoversKeepEveryInvariant) {
  for (const Separation separation : {Separation::none, Separation::partial, Separation::full}) {
    for (const int stages : {2, 3}) {
      const NeatSettings settings = separated(separation, stages);
      const std::vector<Stages> possible = possible_stages(settings);
      std::map<Stages, int> count;
      wander(settings, 40, 60, 32, [&](const Genome& genome) {
        ASSERT_THAT(check(genome), IsEmpty());
        std::set<int> used;
        for (const LinkGene& link : genome.links) {
          used.insert({link.from, link.to});
          ++count[link.stages];
        }
        for (const NodeGene& node : genome.nodes) {
          if (node.kind == NodeKind::hidden) {
            ASSERT_TRUE(used.contains(node.id));
          }
        }
      });
      EXPECT_EQ(count.size(), possible.size());
      for (const Stages& one : possible) EXPECT_TRUE(count.contains(one));
    }
  }
}

TEST(Separation, NoneDrawsNoOtherNumbersForStages) {
  NeatSettings one_stage = restless(), many = restless();
  one_stage.move_gene = 0;
  many.move_gene = 1;
  many.stages = 3;
  EXPECT_EQ(wander(one_stage, 10, 40, 33), wander(many, 10, 40, 33));
}

TEST(FullSeparation, StartsAsNoSeparationDoes) {
  NeatSettings plain, full;
  full.separation = Separation::full;
  plain.stages = full.stages = 2;
  for (std::uint32_t i = 0; i < 30; ++i) {
    RandomStream one = test_stream(34 + i), two = test_stream(34 + i);
    const Genome a = seed_genome(plain, one), b = seed_genome(full, two);
    EXPECT_EQ(b.links.size(), 2 * a.links.size());
    EXPECT_THAT(check(b), IsEmpty());
    EXPECT_TRUE(same(grow(a), grow(b)));
  }
}

// What one stage's genes are changed to says nothing to the other stages.
TEST(FullSeparation, AGeneOfTheAdultNeverChangesTheLarva) {
  const NeatSettings settings = separated(Separation::full);
  int changed_adults = 0, changed_larvae = 0;
  for (const bool full : {true, false}) {
    RandomStream stream = test_stream(70);
    for (int i = 0; i < 60; ++i) {
      Genome genome = seed_genome(full ? settings : NeatSettings{}, stream);
      const auto before = grow(genome);
      for (LinkGene& link : genome.links) {
        if (!full || link.stages.first == 1) link.weight = new_weight(settings, stream);
      }
      const auto after = grow(genome);
      if (full) {
        ASSERT_TRUE(same(before[0], after[0]));
        changed_adults += !same(before[1], after[1]);
      } else {
        changed_larvae += !same(before[0], after[0]);
      }
    }
  }
  EXPECT_GT(changed_adults, 10);
  EXPECT_GT(changed_larvae, 10);
}

// A structural mutation touches one stage: the network of every other one keeps its bits.
TEST(FullSeparation, EveryStructuralChangeActsOnOneStage) {
  NeatSettings settings = separated(Separation::full, 3);
  settings.mutate_weights = 0;
  RandomStream stream = test_stream(71);
  std::set<std::size_t> touched;
  for (int i = 0; i < 200; ++i) {
    const Genome parent = seed_genome(settings, stream);
    Genome child = parent;
    StructuralChange change;
    mutate(child, change, settings, stream);
    int next_innovation = 1000, next_node = 100;
    Innovations(next_innovation, next_node).apply(change, settings, child);
    ASSERT_THAT(check(child), IsEmpty());
    std::size_t different = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto stage = static_cast<int>(k);
      if (expressed(parent, stage).links == expressed(child, stage).links) continue;
      ++different;
      touched.insert(k);
    }
    ASSERT_EQ(different, 1u);
  }
  EXPECT_EQ(touched.size(), 3u);
}

TEST(PartialSeparation, AGeneFromAStageOnNeverChangesWhatIsBefore) {
  RandomStream stream = test_stream(72);
  int changed_adults = 0;
  for (int i = 0; i < 60; ++i) {
    Genome genome = seed_genome(NeatSettings{}, stream);
    for (LinkGene& link : genome.links) {
      if (stream.chance(0.3)) link.stages = {1, forever};
    }
    const auto before = grow(genome);
    for (LinkGene& link : genome.links) {
      if (link.stages.first == 1) link.weight = new_weight({}, stream);
    }
    const auto after = grow(genome);
    ASSERT_TRUE(same(before[0], after[0]));
    changed_adults += !same(before[1], after[1]);
  }
  EXPECT_GT(changed_adults, 5);
}

TEST(PartialSeparation, MovesOneGeneAndNothingElse) {
  NeatSettings settings = separated(Separation::partial, 3);
  settings.mutate_weights = settings.add_link = settings.add_node = settings.remove_link = 0;
  RandomStream stream = test_stream(73);
  Genome genome = seed_genome(settings, stream);
  for (int i = 0; i < 300; ++i) {
    Genome moved = genome;
    StructuralChange change;
    ASSERT_EQ(mutate(moved, change, settings, stream), MutationKind::move_gene);
    ASSERT_EQ(change, StructuralChange{});
    int different = 0;
    for (std::size_t l = 0; l < genome.links.size(); ++l) {
      different += genome.links[l].stages != moved.links[l].stages;
      genome.links[l].stages = moved.links[l].stages;
    }
    ASSERT_EQ(different, 1);
    ASSERT_EQ(genome, moved);
  }
}

// Two links of one pair stand in each other's way: of the four moves of each one alone is free.
TEST(PartialSeparation, MovesOnlyWhereNoLinkIsInTheWay) {
  NeatSettings settings = separated(Separation::partial, 3);
  settings.mutate_weights = settings.add_link = settings.add_node = settings.remove_link = 0;
  const Genome genome = hand_made({}, {{0, 0, 6, 1, {0, 0}}, {1, 0, 6, 1, {2, forever}}});
  RandomStream stream = test_stream(74);
  std::map<std::pair<Stages, Stages>, int> count;
  const int trials = 4000;
  for (int i = 0; i < trials; ++i) {
    Genome moved = genome;
    StructuralChange change;
    ASSERT_EQ(mutate(moved, change, settings, stream), MutationKind::move_gene);
    ++count[{moved.links[0].stages, moved.links[1].stages}];
  }
  const double spread = 5 * std::sqrt(trials * 0.25);
  EXPECT_EQ(count.size(), 2u);
  EXPECT_NEAR((count[{{0, 1}, {2, forever}}]), trials / 2, spread);
  EXPECT_NEAR((count[{{0, 0}, {1, forever}}]), trials / 2, spread);

  settings.stages = 2;
  Genome full = hand_made({}, {{0, 0, 6, 1, {0, 0}}, {1, 0, 6, 1, {1, forever}}});
  StructuralChange change;
  EXPECT_EQ(mutate(full, change, settings, stream), MutationKind::none);
}

TEST(Separation, AddLinkDrawsUniformlyAmongPairsAndStages) {
  for (const Separation separation : {Separation::partial, Separation::full}) {
    NeatSettings settings = separated(separation);
    settings.mutate_weights = settings.add_node = settings.remove_link = settings.move_gene = 0;
    // Every pair is linked in all stages; but one is in none, and one in the first alone.
    Genome genome = hand_made({}, {});
    for (int from = 0; from <= bias_input; ++from) {
      for (int to = bias_input + 1; to < first_hidden; ++to) {
        if (from == 0 && to == 6) continue;
        const int innovation = static_cast<int>(genome.links.size());
        const bool larval = from == 1 && to == 7;
        genome.links.push_back({innovation, from, to, 1, larval ? Stages{0, 0} : Stages{}});
      }
    }
    std::set<std::tuple<int, int, Stages>> expected = {{1, 7, possible_stages(settings)[1]}};
    for (const Stages& stages : possible_stages(settings)) expected.insert({0, 6, stages});
    RandomStream stream = test_stream(75);
    std::map<std::tuple<int, int, Stages>, int> count;
    const int trials = 8000;
    for (int i = 0; i < trials; ++i) {
      Genome child = genome;
      StructuralChange change;
      ASSERT_EQ(mutate(child, change, settings, stream), MutationKind::add_link);
      ++count[{change.from, change.to, change.stages}];
    }
    ASSERT_EQ(count.size(), expected.size());
    const double share = 1.0 / static_cast<double>(expected.size());
    for (const auto& [link, times] : count) {
      EXPECT_TRUE(expected.contains(link));
      EXPECT_NEAR(times, trials * share, 5 * std::sqrt(trials * share * (1 - share)));
    }
  }
}

TEST(Separation, TheSameChangeInOtherStagesGetsOtherNumbers) {
  const NeatSettings settings;
  const Genome parent =
      hand_made({13}, {{0, 0, 13, 2, {0, 0}}, {1, 0, 13, 3, {1, 1}}, {2, 13, 6, 1}});
  int next_innovation = 3, next_node = 14;
  Innovations generation(next_innovation, next_node);
  const auto changed = [&](MutationKind kind, int from, int to, Stages stages) {
    Genome child = parent;
    generation.apply({kind, from, to, 0.5, stages}, settings, child);
    EXPECT_THAT(check(child), IsEmpty());
    return child;
  };
  const Genome larval = changed(MutationKind::add_link, 0, 6, {0, 0});
  EXPECT_EQ(larval.links.back(), (LinkGene{3, 0, 6, 0.5, {0, 0}}));
  EXPECT_EQ(changed(MutationKind::add_link, 0, 6, {1, 1}).links.back().innovation, 4);
  EXPECT_EQ(changed(MutationKind::add_link, 0, 6, {0, 0}), larval);
  const Genome split = changed(MutationKind::add_node, 0, 13, {1, 1});
  EXPECT_EQ(split.links[0], parent.links[0]);
  EXPECT_EQ(split.links[2], (LinkGene{5, 0, 14, 2, {1, 1}}));
  EXPECT_EQ(split.links[3], (LinkGene{6, 14, 13, 3, {1, 1}}));
  EXPECT_EQ(changed(MutationKind::add_node, 0, 13, {0, 0}).nodes.back().id, 15);
  EXPECT_EQ(changed(MutationKind::add_node, 0, 13, {1, 1}), split);
}

TEST(Separation, ACrossoverKeepsTheStagesOfTheFitter) {
  const Genome fitter = hand_made({}, {{0, 0, 6, 1, {1, forever}}, {1, 0, 7, 1}});
  const Genome other = hand_made({}, {{0, 0, 6, 3}, {1, 0, 7, 3, {0, 0}}});
  RandomStream stream = test_stream(76);
  EXPECT_EQ(cross(fitter, other, true, stream),
            hand_made({}, {{0, 0, 6, 2, {1, forever}}, {1, 0, 7, 2}}));
}

TEST(Separation, DistanceCountsLinksOfOtherStages) {
  const Genome a = hand_made({}, {{0, 0, 6, 1}, {1, 0, 7, 2}, {2, 0, 8, 3}});
  Genome b = a;
  b.links[1].stages = {1, forever};
  b.links[2].weight = 0;
  Genome c = b;
  c.links[1].stages = {0, 0};
  c.links[0].stages = {0, 0};
  EXPECT_EQ(distance(a, b, 1.5), 1 + 1.5 * 1);
  EXPECT_EQ(distance(b, a, 1.5), 1 + 1.5 * 1);
  EXPECT_EQ(distance(b, c, 1.5), 2);
  EXPECT_EQ(distance(c, c, 1.5), 0);
}

TEST(Separation, PopulationsAreTheSameForAnyNumberOfThreads) {
  for (const Separation separation : {Separation::partial, Separation::full}) {
    NeatSettings settings = separated(separation);
    settings.population = 40;
    PopulationState one = first_generation(settings, 6), two = first_generation(settings, 6);
    EXPECT_EQ(one.next_innovation, static_cast<int>(one.genomes[0].links.size()));
    for (int g = 0; g < 10; ++g) {
      std::vector<double> fitness;
      for (int i = 0; i < 40; ++i) fitness.push_back((i * 7 + g) % 11);
      next_generation(one, settings, fitness, false, 1);
      next_generation(two, settings, fitness, false, 2);
      ASSERT_EQ(one, two);
      for (const Genome& genome : one.genomes) ASSERT_THAT(check(genome), IsEmpty());
    }
  }
}

}  // namespace
}  // namespace metamorph::evolve
