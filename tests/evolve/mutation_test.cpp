#include "metamorph/variation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using testing::hand_made;
using ::testing::IsEmpty;
using testing::restless;
using testing::test_stream;
using testing::wander;

// Five standard deviations of a binomial count.
void expect_frequency(int count, int trials, double probability) {
  EXPECT_NEAR(count, trials * probability, 5 * std::sqrt(trials * probability * (1 - probability)));
}

TEST(SeedGenome, HasTheTopologyOfTheModel) {
  evolve::RandomStream stream = test_stream(0);
  const Genome genome = seed_genome(NeatSettings{}, stream);
  EXPECT_THAT(check(genome), IsEmpty());
  EXPECT_EQ(genome.nodes.size(), 21u);
  EXPECT_EQ(genome.links.size(), 6u * 8 + 8 * 7 + 7);
  for (const LinkGene& link : genome.links) {
    EXPECT_LT(std::abs(link.weight), 2);
    const bool to_hidden = link.from < 6 && link.to >= first_hidden;
    const bool to_output = link.from >= first_hidden || link.from == bias_input;
    EXPECT_TRUE(to_hidden || to_output) << link.from << " -> " << link.to;
  }
}

TEST(SeedGenome, WeightsAreTriangular) {
  evolve::RandomStream stream = test_stream(1);
  const int n = 111 * 300;
  double sum = 0, square = 0;
  for (int i = 0; i < 300; ++i) {
    for (const LinkGene& link : seed_genome(NeatSettings{}, stream).links) {
      sum += link.weight;
      square += link.weight * link.weight;
    }
  }
  // 2 (u - v): variance 4/6; fourth moment 16/15, so the square's variance is 16/15 - 4/9.
  EXPECT_NEAR(sum / n, 0, 5 * std::sqrt(4.0 / 6 / n));
  EXPECT_NEAR(square / n, 4.0 / 6, 5 * std::sqrt((16.0 / 15 - 4.0 / 9) / n));
}

TEST(Mutation, ThousandsInARowKeepEveryInvariant) {
  const NeatSettings settings = restless();
  int genomes = 0;
  wander(settings, 60, 120, 5, [&](const Genome& genome) {
    ASSERT_THAT(check(genome), IsEmpty());
    for (const LinkGene& link : genome.links)
      ASSERT_LE(std::abs(link.weight), settings.weight_limit);
    ++genomes;
    std::set<int> used;
    for (const LinkGene& link : genome.links) used.insert({link.from, link.to});
    for (const NodeGene& node : genome.nodes) {
      if (node.kind == NodeKind::hidden) {
        ASSERT_TRUE(used.contains(node.id));
      }
    }
  });
  EXPECT_EQ(genomes, 60 * 120);
}

TEST(Mutation, RouletteFollowsTheRates) {
  const NeatSettings settings = paper_neat_settings();
  evolve::RandomStream stream = test_stream(2);
  const Genome seed = seed_genome(settings, stream);
  const int trials = 40000;
  std::map<MutationKind, int> count;
  for (int i = 0; i < trials; ++i) {
    Genome genome = seed;
    StructuralChange change;
    const MutationKind kind = mutate(genome, change, settings, stream);
    ++count[kind];
    // A child has exactly the kind of change that was named.
    const bool structural = kind == MutationKind::add_link || kind == MutationKind::add_node;
    ASSERT_EQ(change.kind, structural ? kind : MutationKind::none);
    ASSERT_EQ(genome.links.size(), seed.links.size() - (kind == MutationKind::remove_link));
    ASSERT_EQ(genome == seed, structural);
    const bool redraw = kind == MutationKind::redraw;
    if (!redraw && kind != MutationKind::weights) continue;
    // A small change moves no weight by 1 or more; of 111 redrawn weights some always do.
    bool far = false;
    for (std::size_t l = 0; l < seed.links.size(); ++l) {
      far |= std::abs(genome.links[l].weight - seed.links[l].weight) >= settings.weight_change;
    }
    ASSERT_EQ(far, redraw);
  }
  const double total = 0.75 + 0.07 + 0.01 + 0.01;
  const int weights = count[MutationKind::weights] + count[MutationKind::redraw];
  expect_frequency(weights, trials, 0.75 / total);
  expect_frequency(count[MutationKind::redraw], weights, settings.severe);
  expect_frequency(count[MutationKind::add_link], trials, 0.07 / total);
  expect_frequency(count[MutationKind::add_node], trials, 0.01 / total);
  expect_frequency(count[MutationKind::remove_link], trials, 0.01 / total);
}

// How many of 111 links a mutation changes. A share s is log-uniform on [1/111, 1], so the mean of
// s is (1 - 1/111) / ln 111; the logarithm that is linear between powers of two is off by 6 % at
// most.
TEST(Mutation, MovesALogUniformShareOfTheLinks) {
  NeatSettings settings;
  settings.add_link = settings.add_node = settings.remove_link = 0;
  for (const bool redraw : {false, true}) {
    settings.severe = redraw ? 1 : 0;
    settings.redrawn_share = 0;
    evolve::RandomStream stream = test_stream(21);
    const Genome seed = seed_genome(settings, stream);
    const double links = static_cast<double>(seed.links.size());
    const int trials = 20000;
    double changed = 0;
    int one = 0, half = 0;
    for (int i = 0; i < trials; ++i) {
      Genome genome = seed;
      StructuralChange change;
      ASSERT_EQ(mutate(genome, change, settings, stream),
                redraw ? MutationKind::redraw : MutationKind::weights);
      int count = 0;
      for (std::size_t l = 0; l < seed.links.size(); ++l) {
        count += genome.links[l].weight != seed.links[l].weight;
      }
      ASSERT_GE(count, 1);
      changed += count;
      one += count == 1;
      half += count > links / 2;
    }
    const double octaves = std::log(links);
    EXPECT_NEAR(changed / trials / links, (1 - 1 / links) / octaves, 0.06 * 1 / octaves + 0.01);
    // More than half move with probability about ln 2 / ln 111, and single ones are common: where
    // s = e^t / 111, one link or none moves with probability (1 + e^t) exp(-e^t) and more, and the
    // integral of that over t from 0 to ln 111 is about 0.58.
    EXPECT_NEAR(half / static_cast<double>(trials), std::log(2.0) / octaves, 0.03);
    EXPECT_NEAR(one / static_cast<double>(trials), 0.58 / octaves, 0.03);
  }
}

TEST(Mutation, ALeastShareOfOneMovesAllLinks) {
  const NeatSettings settings = paper_neat_settings();
  evolve::RandomStream stream = test_stream(22);
  const Genome seed = seed_genome(settings, stream);
  for (int i = 0; i < 200; ++i) {
    Genome genome = seed;
    StructuralChange change;
    const MutationKind kind = mutate(genome, change, settings, stream);
    if (kind != MutationKind::weights && kind != MutationKind::redraw) continue;
    for (std::size_t l = 0; l < seed.links.size(); ++l) {
      EXPECT_NE(genome.links[l].weight, seed.links[l].weight);
    }
  }
}

TEST(Mutation, AnImpossibleKindIsDrawnAgain) {
  // One bias link: no link to split, and the last link stays.
  const Genome lonely = hand_made({}, {{0, bias_input, 6, 1}});
  const NeatSettings settings;
  evolve::RandomStream stream = test_stream(4);
  const int trials = 20000;
  std::map<MutationKind, int> count;
  for (int i = 0; i < trials; ++i) {
    Genome genome = lonely;
    StructuralChange change;
    ++count[mutate(genome, change, settings, stream)];
  }
  EXPECT_EQ(count.size(), 3u);
  const int weights = count[MutationKind::weights] + count[MutationKind::redraw];
  expect_frequency(weights, trials, 0.75 / 0.82);
  expect_frequency(count[MutationKind::add_link], trials, 0.07 / 0.82);
}

TEST(Mutation, EndsWhereNothingIsPossible) {
  NeatSettings settings;
  settings.add_link = 0;
  const Genome unlinked = hand_made({}, {});
  Genome genome = unlinked;
  StructuralChange change;
  evolve::RandomStream stream = test_stream(5);
  EXPECT_EQ(mutate(genome, change, settings, stream), MutationKind::none);
  EXPECT_EQ(genome, unlinked);
  EXPECT_EQ(change, StructuralChange{});
}

TEST(Mutation, KeepsAndUsesANodeWithANegativeId) {
  // Between the links of the seed genome and those of its descendants: added ones leave the node.
  int added = 0;
  wander(
      restless(), 40, 60, 12,
      [&](const Genome& genome) {
        ASSERT_THAT(check(genome), IsEmpty());
        ASSERT_EQ(genome.nodes.front(), (NodeGene{-1, NodeKind::input}));
        for (const LinkGene& link : genome.links) added += link.from == -1 && link.to < 13;
      },
      testing::with_neighbours());
  EXPECT_GT(added, 0);
}

// Every input linked to every output but for the given free pairs.
Genome nearly_full(const std::set<std::pair<int, int>>& free) {
  Genome genome = hand_made({}, {});
  for (int from = 0; from <= bias_input; ++from) {
    for (int to = bias_input + 1; to < first_hidden; ++to) {
      const int innovation = static_cast<int>(genome.links.size());
      if (!free.contains({from, to})) genome.links.push_back({innovation, from, to, 1});
    }
  }
  return genome;
}

TEST(AddLink, DrawsUniformlyAmongThePossiblePairs) {
  // Rarely, several quick draws miss all free pairs and the full list decides: both ways and their
  // mixture must be uniform.
  NeatSettings settings;
  settings.mutate_weights = settings.add_node = settings.remove_link = 0;
  evolve::RandomStream stream = test_stream(6);
  for (const std::set<std::pair<int, int>>& free :
       {std::set<std::pair<int, int>>{{0, 6}, {3, 9}, {5, 12}},
        std::set<std::pair<int, int>>{{0, 6}, {0, 7}, {0, 8}, {1, 6}, {1, 7}, {1, 8}, {2, 9}}}) {
    const Genome genome = nearly_full(free);
    std::map<std::pair<int, int>, int> count;
    const int trials = 12000;
    for (int i = 0; i < trials; ++i) {
      Genome child = genome;
      StructuralChange change;
      ASSERT_EQ(mutate(child, change, settings, stream), MutationKind::add_link);
      ++count[{change.from, change.to}];
    }
    ASSERT_EQ(count.size(), free.size());
    for (const auto& [pair, times] : count) {
      EXPECT_TRUE(free.contains(pair));
      expect_frequency(times, trials, 1.0 / static_cast<double>(free.size()));
    }
  }
  Genome full = nearly_full({});
  StructuralChange change;
  EXPECT_EQ(mutate(full, change, settings, stream), MutationKind::none);
}

TEST(AddLink, RejectsCycles) {
  // 13 -> 14 -> 15: of the pairs of hidden nodes only 13 -> 15 closes no cycle.
  const Genome chain = hand_made({13, 14, 15}, {{0, 13, 14, 1}, {1, 14, 15, 1}});
  NeatSettings settings;
  settings.mutate_weights = settings.add_node = settings.remove_link = 0;
  evolve::RandomStream stream = test_stream(7);
  std::set<std::pair<int, int>> hidden_pairs;
  for (int i = 0; i < 5000; ++i) {
    Genome genome = chain;
    StructuralChange change;
    mutate(genome, change, settings, stream);
    if (change.from >= first_hidden && change.to >= first_hidden) {
      hidden_pairs.insert({change.from, change.to});
    }
  }
  EXPECT_EQ(hidden_pairs, (std::set<std::pair<int, int>>{{13, 15}}));
}

TEST(AddNode, SplitsALinkThatIsNotTheBias) {
  const NeatSettings settings;
  NeatSettings splitting;
  splitting.mutate_weights = splitting.add_link = splitting.remove_link = 0;
  const Genome parent = hand_made({}, {{0, bias_input, 6, 3}, {1, 2, 7, -4}});
  evolve::RandomStream stream = test_stream(8);
  for (int i = 0; i < 100; ++i) {
    Genome child = parent;
    StructuralChange change;
    ASSERT_EQ(mutate(child, change, splitting, stream), MutationKind::add_node);
    int next_innovation = 10, next_node = 20;
    Innovations(next_innovation, next_node).apply(change, settings, child);
    EXPECT_EQ(child, hand_made({20}, {{0, bias_input, 6, 3}, {10, 2, 20, 2}, {11, 20, 7, -4}}));
    EXPECT_EQ(next_innovation, 12);
    EXPECT_EQ(next_node, 21);
  }
}

// A node split into a link with incoming weight 2 passes small signals on: tanh(2 x / 2) = x - x^3
// / 3 and less; with 1 it halves them.
TEST(AddNode, KeepsSmallSignals) {
  for (const double weight : {1.0, 2.0}) {
    NeatSettings settings;
    settings.mutate_weights = settings.add_link = settings.remove_link = 0;
    settings.node_weight = weight;
    const Genome parent = hand_made({}, {{0, 2, 7, 0.5}});
    evolve::RandomStream stream = test_stream(8);
    Genome child = parent;
    StructuralChange change;
    ASSERT_EQ(mutate(child, change, settings, stream), MutationKind::add_node);
    int next_innovation = 10, next_node = 20;
    Innovations(next_innovation, next_node).apply(change, settings, child);
    const double x = 0.01;
    const double before = std::tanh(0.5 * x / 2);
    const double after = std::tanh(0.5 * std::tanh(child.links.front().weight * x / 2) / 2);
    EXPECT_NEAR(after, weight / 2 * before, x * x * x);
  }
}

TEST(RemoveLink, TakesUnlinkedHiddenNodesAlong) {
  NeatSettings settings;
  settings.mutate_weights = settings.add_link = settings.add_node = 0;
  evolve::RandomStream stream = test_stream(9);
  std::set<std::size_t> nodes_left;
  for (int i = 0; i < 200; ++i) {
    Genome genome = hand_made({13}, {{0, 0, 13, 1}, {1, 0, 6, 1}});
    StructuralChange change;
    ASSERT_EQ(mutate(genome, change, settings, stream), MutationKind::remove_link);
    nodes_left.insert(genome.nodes.size());
    EXPECT_EQ(genome.nodes.size() == 13u, genome.links[0].to == 6);
  }
  EXPECT_EQ(nodes_left.size(), 2u);
}

TEST(Innovations, TheSameChangeGetsTheSameNumbersWithinAGeneration) {
  const NeatSettings settings;
  const Genome parent = hand_made({13}, {{0, 0, 13, 2}, {1, 13, 6, 3}});
  int next_innovation = 2, next_node = 14;
  const StructuralChange link_a = {MutationKind::add_link, 0, 6, 0.5};
  const StructuralChange link_b = {MutationKind::add_link, 0, 6, -0.5};
  const StructuralChange other = {MutationKind::add_link, 1, 6, 0.5};
  const StructuralChange split = {MutationKind::add_node, 0, 13, 0};
  Innovations generation(next_innovation, next_node);
  const auto changed = [&](Innovations& innovations, const StructuralChange& change) {
    Genome child = parent;
    innovations.apply(change, settings, child);
    EXPECT_THAT(check(child), IsEmpty());
    return child;
  };
  EXPECT_EQ(changed(generation, link_a).links.back(), (LinkGene{2, 0, 6, 0.5}));
  EXPECT_EQ(changed(generation, split), changed(generation, split));
  EXPECT_EQ(changed(generation, link_b).links.back(), (LinkGene{2, 0, 6, -0.5}));
  EXPECT_EQ(changed(generation, other).links.back().innovation, 5);
  EXPECT_EQ(next_innovation, 6);
  EXPECT_EQ(next_node, 15);
  Innovations following(next_innovation, next_node);
  EXPECT_EQ(changed(following, link_a).links.back().innovation, 6);
}

TEST(Crossover, TakesTheStructureOfTheFitter) {
  const Genome fitter =
      hand_made({13}, {{0, 0, 13, 1}, {2, 13, 6, 2}, {3, 1, 13, 3}, {9, 2, 13, 4}});
  const Genome other = hand_made({14}, {{0, 0, 13, -1}, {1, 0, 14, -5}, {3, 1, 13, -3}});
  evolve::RandomStream stream = test_stream(10);
  EXPECT_EQ(cross(fitter, other, true, stream),
            hand_made({13}, {{0, 0, 13, 0}, {2, 13, 6, 2}, {3, 1, 13, 0}, {9, 2, 13, 4}}));
  const int trials = 10000;
  int first = 0, both = 0;
  for (int i = 0; i < trials; ++i) {
    const Genome child = cross(fitter, other, false, stream);
    ASSERT_EQ(std::abs(child.links[0].weight), 1);
    ASSERT_EQ(std::abs(child.links[2].weight), 3);
    first += child.links[0].weight < 0;
    both += child.links[0].weight < 0 && child.links[2].weight < 0;
    ASSERT_EQ(child.links[1], fitter.links[1]);
    ASSERT_EQ(child.links[3], fitter.links[3]);
  }
  expect_frequency(first, trials, 0.5);
  expect_frequency(both, trials, 0.25);
}

}  // namespace
}  // namespace metamorph::evolve
