#include "evolve/run/checkpoint.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "evolve/files/input_error.h"
#include "evolve/search/population_json.h"

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
  return {17, {0, 255, 3, 7}, {16, 98, 12.5, 13.25, {3.5, 1e-300, -0.0}, genome_of(4)}};
}

TEST(Checkpoint, EveryFieldComesBack) {
  const Checkpoint c = example();
  const Checkpoint back = decode(encode(c), "test");
  EXPECT_EQ(back, c);
  EXPECT_TRUE(std::signbit(back.best.distances[2]));
  EXPECT_TRUE(std::signbit(back.best.genome.links[1].weight));
}

TEST(Checkpoint, EveryFieldOfAPopulationComesBack) {
  PopulationState population;
  population.seed = 0xfedcba9876543210u;
  population.generation = 17;
  population.genomes = {genome_of(0), genome_of(3)};
  population.individuals = {{100, -1, -1, 2}, {(std::int64_t{1} << 40) + 1, 100, 99, 5}};
  population.species = {{2, genome_of(1), 4, 0.1 + 0.2, 3, 1}, {5, genome_of(2), 0, -1, 0, 1}};
  population.genomes[1].links[0].stages = {1, Stages::end_of_life};
  population.genomes[1].links[1].stages = {0, 2};
  population.next_individual = 102;
  population.next_species = 6;
  population.next_innovation = 1234;
  population.next_node = 77;
  population.compatibility_threshold = 1.0 / 3;
  const auto bytes = nlohmann::json::to_cbor(to_json(population));
  const PopulationState back = population_of(nlohmann::json::from_cbor(bytes));
  EXPECT_EQ(back, population);
  EXPECT_TRUE(std::signbit(back.genomes[0].links[1].weight));
}

// What checkpoints were before genes had stages is what they are without.
TEST(Checkpoint, AGenomeSaysNothingOfStagesThatAreAll) {
  Genome genome = genome_of(1);
  EXPECT_FALSE(to_json(genome).contains("stages"));
  genome.links[0].stages.last = 0;
  EXPECT_EQ(to_json(genome).at("stages").size(), 2 * genome.links.size());
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
