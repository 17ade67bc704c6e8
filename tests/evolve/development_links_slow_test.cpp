#include <gtest/gtest.h>

#include "tests/evolve/checked_developments.h"

namespace metamorph::evolve {
namespace {

using testing::check_developments;
using testing::MutatedGenomes;
using testing::RandomGenomes;

TEST(ManyDevelopmentLinks, OfRandomGenomes) {
  RandomGenomes genomes;
  check_developments(genomes, 1200);
}

TEST(ManyDevelopmentLinks, OfEvolvedGenomes) {
  MutatedGenomes genomes;
  check_developments(genomes, 1200);
}

}  // namespace
}  // namespace metamorph::evolve
