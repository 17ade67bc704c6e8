#include "evolve/evaluation/fingerprint.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <span>
#include <unordered_set>
#include <vector>

#include "metamorph/genome.h"
#include "tests/bodies.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using Prints = std::unordered_set<Fingerprint, FingerprintHash>;

/// Calls visit() once for every bit of a list, with that bit turned.
template <class List, class Visit>
void for_every_bit(List& list, Visit visit) {
  auto* bytes = reinterpret_cast<unsigned char*>(list.data());
  for (std::size_t bit = 0; bit < 8 * sizeof list[0] * list.size(); ++bit) {
    const auto turned = static_cast<unsigned char>(1u << bit % 8);
    bytes[bit / 8] ^= turned;
    visit();
    bytes[bit / 8] ^= turned;
  }
}

TEST(Fingerprint, EveryBitOfABodyCounts) {
  core::Body body = tests::disc_body(19);
  const Fingerprint original = fingerprint(body);
  Prints seen = {original};
  std::size_t variants = 1;
  const auto visit = [&] {
    seen.insert(fingerprint(body));
    ++variants;
  };
  for (auto* list :
       {&body.x, &body.y, &body.period, &body.phase, &body.rest_length, &body.rest_area}) {
    for_every_bit(*list, visit);
  }
  for_every_bit(body.triangles, visit);
  for_every_bit(body.springs, visit);
  EXPECT_EQ(seen.size(), variants);
  body.cell.assign(body.x.size(), 3);  // says where nodes come from, not how they move
  EXPECT_EQ(fingerprint(body), original);
}

TEST(Fingerprint, EveryBitOfANetworkCounts) {
  core::Network network = compile(testing::wander(testing::restless(), 1, 30, 1).front());
  Prints seen = {fingerprint({&network, 1})};
  std::size_t variants = 1;
  const auto visit = [&] {
    seen.insert(fingerprint({&network, 1}));
    ++variants;
  };
  for_every_bit(network.first_link, visit);
  for_every_bit(network.source, visit);
  for_every_bit(network.weight, visit);
  for_every_bit(network.output, visit);
  for (int bit = 0; bit < 32; ++bit) {
    network.inputs ^= static_cast<int>(1u << bit);
    visit();
    network.inputs ^= static_cast<int>(1u << bit);
  }
  EXPECT_EQ(seen.size(), variants);
}

// The same numbers, divided among the lists in another way.
TEST(Fingerprint, TellsWhereAListEnds) {
  Prints seen;
  const std::vector<double> values = {1, 2, 0, 0, 0, 0, 0, 0};
  std::size_t variants = 0;
  for (std::size_t a = 0; a <= values.size(); ++a) {
    for (std::size_t b = a; b <= values.size(); ++b, ++variants) {
      core::Body body;
      const auto at = [&](std::size_t i) { return values.begin() + static_cast<long>(i); };
      body.x.assign(at(0), at(a));
      body.y.assign(at(a), at(b));
      body.period.assign(at(b), values.end());
      seen.insert(fingerprint(body));
    }
  }
  EXPECT_EQ(seen.size(), variants);
}

TEST(Fingerprint, EqualExactlyWhereTheContentIs) {
  std::vector<core::Network> networks;
  for (std::uint32_t i = 0; i < 20; ++i) {
    for (Genome& genome : testing::wander(testing::restless(), 8, 10, i)) {
      networks.push_back(compile(genome));
      // What reaches no output is not compiled.
      const int node = genome.nodes.back().id + 1, link = genome.links.back().innovation + 1;
      genome.nodes.push_back({node, NodeKind::hidden});
      genome.links.push_back({link, 0, node, 0.5});
      networks.push_back(compile(genome));
    }
  }
  int equal = 0;
  for (std::size_t i = 0; i < networks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const core::Network &a = networks[i], &b = networks[j];
      const bool same =
          a.first_link == b.first_link && a.source == b.source &&
          a.weight.size() == b.weight.size() && a.output == b.output &&
          std::memcmp(a.weight.data(), b.weight.data(), a.weight.size() * sizeof(float)) == 0;
      ASSERT_EQ(fingerprint({&a, 1}) == fingerprint({&b, 1}), same);
      equal += same;
    }
  }
  EXPECT_GE(equal, 160);  // each with its dead end
}

}  // namespace
}  // namespace metamorph::evolve
