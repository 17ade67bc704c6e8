#include "metamorph/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace metamorph::evolve {
namespace {

TEST(RandomStream, IsAPureFunctionOfItsKey) {
  RandomStream a(Purpose::mutation, 7, 3, 11), b(Purpose::mutation, 7, 3, 11);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(a.bits(), b.bits());
}

TEST(RandomStream, EveryPartOfTheKeyChangesTheStream) {
  std::set<std::uint32_t> first;
  first.insert(RandomStream(Purpose::mutation, 7, 3, 11).bits());
  first.insert(RandomStream(Purpose::crossover, 7, 3, 11).bits());
  first.insert(RandomStream(Purpose::mutation, 8, 3, 11).bits());
  first.insert(RandomStream(Purpose::mutation, 7 + (1ull << 32), 3, 11).bits());
  first.insert(RandomStream(Purpose::mutation, 7, 4, 11).bits());
  first.insert(RandomStream(Purpose::mutation, 7, 3, 12).bits());
  EXPECT_EQ(first.size(), 6u);
}

TEST(RandomStream, UniformHasTheRightMoments) {
  RandomStream stream(Purpose::test, 1, 0, 0);
  const int n = 100000;
  double sum = 0, square = 0;
  for (int i = 0; i < n; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    square += u * u;
  }
  // Five standard errors of the mean (1/sqrt(12 n)) and of the second moment (sqrt(4/45 / n)).
  EXPECT_NEAR(sum / n, 0.5, 5 / std::sqrt(12.0 * n));
  EXPECT_NEAR(square / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
}

TEST(RandomStream, BelowIsUnbiased) {
  RandomStream stream(Purpose::test, 2, 0, 0);
  const int n = 70000;
  int count[7] = {};
  for (int i = 0; i < n; ++i) ++count[stream.below(7)];
  double chi2 = 0;
  for (int c : count) chi2 += (c - n / 7.0) * (c - n / 7.0) / (n / 7.0);
  EXPECT_LT(chi2, 22.46);  // chi-square, 6 degrees of freedom, p = 0.001
}

}  // namespace
}  // namespace metamorph::evolve
