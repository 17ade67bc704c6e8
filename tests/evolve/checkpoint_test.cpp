#include "evolve/run/checkpoint.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "evolve/files/input_error.h"

namespace metamorph::evolve {
namespace {

Genome genome_of(int salt) {
  Genome genome;
  for (int i = 0; i < 13; ++i) {
    genome.nodes.push_back({i, i < 6 ? NodeKind::input : NodeKind::output});
  }
  genome.nodes.push_back({13 + salt, NodeKind::hidden});
  genome.links = {{1, 0, 13 + salt, 0.1 * salt}, {2 + salt, 13 + salt, 6, -0.0}};
  return genome;
}

Checkpoint example() {
  Checkpoint c;
  c.population.seed = 0xfedcba9876543210u;
  c.population.generation = 17;
  c.population.genomes = {genome_of(0), genome_of(3)};
  c.population.individuals = {{100, -1, -1, 2}, {(std::int64_t{1} << 40) + 1, 100, 99, 5}};
  c.population.species = {{2, genome_of(1), 4, 0.1 + 0.2, 3, 1}, {5, genome_of(2), 0, -1, 0, 1}};
  c.population.next_individual = 102;
  c.population.next_species = 6;
  c.population.next_innovation = 1234;
  c.population.next_node = 77;
  c.population.compatibility_threshold = 1.0 / 3;
  c.search.archive_threshold = 0.7;
  c.search.added_in_a_row = 8;
  c.search.idle_generations = 49;
  c.best = {16, 98, 12.5, 13.25, {3.5, 1e-300}, genome_of(4)};
  return c;
}

TEST(Checkpoint, EveryFieldComesBack) {
  const Checkpoint c = example();
  const Checkpoint back = decode(encode(c), "test");
  const PopulationState &p = c.population, &q = back.population;
  EXPECT_EQ(p.seed, q.seed);
  EXPECT_EQ(p.generation, q.generation);
  EXPECT_EQ(p.genomes, q.genomes);
  EXPECT_TRUE(std::signbit(q.genomes[0].links[1].weight));
  ASSERT_EQ(q.individuals.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(p.individuals[i].id, q.individuals[i].id);
    EXPECT_EQ(p.individuals[i].parent_a, q.individuals[i].parent_a);
    EXPECT_EQ(p.individuals[i].parent_b, q.individuals[i].parent_b);
    EXPECT_EQ(p.individuals[i].species, q.individuals[i].species);
  }
  ASSERT_EQ(q.species.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(p.species[i].id, q.species[i].id);
    EXPECT_EQ(p.species[i].representative, q.species[i].representative);
    EXPECT_EQ(p.species[i].age, q.species[i].age);
    EXPECT_EQ(p.species[i].best_ever, q.species[i].best_ever);
    EXPECT_EQ(p.species[i].stagnant, q.species[i].stagnant);
    EXPECT_EQ(p.species[i].size, q.species[i].size);
  }
  EXPECT_EQ(p.next_individual, q.next_individual);
  EXPECT_EQ(p.next_species, q.next_species);
  EXPECT_EQ(p.next_innovation, q.next_innovation);
  EXPECT_EQ(p.next_node, q.next_node);
  EXPECT_EQ(p.compatibility_threshold, q.compatibility_threshold);
  EXPECT_EQ(c.search.archive_threshold, back.search.archive_threshold);
  EXPECT_EQ(c.search.added_in_a_row, back.search.added_in_a_row);
  EXPECT_EQ(c.search.idle_generations, back.search.idle_generations);
  EXPECT_EQ(c.best, back.best);
}

TEST(Checkpoint, EveryShorterFormIsRefused) {
  const std::vector<std::uint8_t> bytes = encode(example());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(decode(std::span(bytes).first(length), "test"), InputError) << length;
  }
  std::vector<std::uint8_t> longer = bytes;
  longer.push_back(0);
  EXPECT_THROW(decode(longer, "test"), InputError);
}

RC_GTEST_PROP(Checkpoint, EveryFlippedBitIsRefused, ()) {
  std::vector<std::uint8_t> bytes = encode(example());
  const auto where = *rc::gen::inRange<std::size_t>(0, bytes.size());
  bytes[where] = static_cast<std::uint8_t>(bytes[where] ^ (1 << *rc::gen::inRange(0, 8)));
  RC_ASSERT_THROWS_AS(decode(bytes, "test"), InputError);
}

}  // namespace
}  // namespace metamorph::evolve
