// The links of whole developments against those of a full triangulation at every renewal.

#include <gtest/gtest.h>

#include "tests/evolve/checked_developments.h"

namespace metamorph::evolve {
namespace {

using testing::check_developments;
using testing::MutatedGenomes;
using testing::RandomGenomes;

TEST(DevelopmentLinks, OfRandomGenomesAreThoseOfAFullTriangulation) {
  RandomGenomes genomes;
  check_developments(genomes, 40);
}

TEST(DevelopmentLinks, OfEvolvedGenomesAreThoseOfAFullTriangulation) {
  MutatedGenomes genomes;
  check_developments(genomes, 40);
}

}  // namespace
}  // namespace metamorph::evolve
