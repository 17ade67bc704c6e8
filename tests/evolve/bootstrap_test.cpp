#include "evolve/study/bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "metamorph/random.h"

namespace metamorph::evolve {
namespace {

using Sample = std::vector<double>;

std::vector<std::uint64_t> seeds_to(std::size_t count) {
  std::vector<std::uint64_t> seeds(count);
  std::iota(seeds.begin(), seeds.end(), 1);
  return seeds;
}

Sample random_sample(RandomStream& stream, std::size_t size) {
  Sample sample(size);
  for (double& value : sample) value = std::exp(3 * stream.triangular());  // skew, as fitness is
  return sample;
}

double plain_centre(Sample sample, Centre centre) {
  std::sort(sample.begin(), sample.end());
  const std::size_t n = sample.size();
  if (centre == Centre::median) return (sample[(n - 1) / 2] + sample[n / 2]) / 2;
  double sum = 0;
  for (const double value : sample) sum += value;
  return sum / static_cast<double>(n);
}

/// The centres of all n^n samples that can be drawn of n values, ascending: the bootstrap
/// distribution itself, without chance.
Sample all_centres(const Sample& sample, Centre centre) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < sample.size(); ++i) count *= sample.size();
  Sample centres;
  for (std::size_t draw = 0; draw < count; ++draw) {
    Sample drawn;
    for (std::size_t rest = draw; drawn.size() < sample.size(); rest /= sample.size()) {
      drawn.push_back(sample[rest % sample.size()]);
    }
    centres.push_back(plain_centre(drawn, centre));
  }
  std::sort(centres.begin(), centres.end());
  return centres;
}

/// The least centre that a share p of all does not exceed.
double quantile(const Sample& ascending, double p) {
  const double count = static_cast<double>(ascending.size());
  const double rank = std::clamp(std::ceil(p * count), 1.0, count);
  return ascending[static_cast<std::size_t>(rank) - 1];
}

TEST(Bootstrap, LimitsAreThoseOfAllSamplesThatCanBeDrawn) {
  constexpr double tail = 0.025;
  // How many of the drawn centres lie beyond the true limit is binomial; six of its deviations, in
  // 480 comparisons, are never exceeded by chance.
  const double slack = 6 * std::sqrt(tail * (1 - tail) / Bootstrap::resamples);
  RandomStream stream(Purpose::test, 7, 0, 0);
  for (std::size_t size = 2; size <= 5; ++size) {
    const Bootstrap bootstrap(seeds_to(size));
    for (int repetition = 0; repetition < 15; ++repetition) {
      const Sample sample = random_sample(stream, size);
      for (const Centre centre : {Centre::mean, Centre::median}) {
        const Sample all = all_centres(sample, centre);
        const Interval interval = bootstrap.interval(sample, centre);
        const double rounding = 1e-12 * sample.back() + 1e-12;
        EXPECT_GE(interval.low, quantile(all, tail - slack) - rounding);
        EXPECT_LE(interval.low, quantile(all, tail + slack) + rounding);
        EXPECT_GE(interval.high, quantile(all, 1 - tail - slack) - rounding);
        EXPECT_LE(interval.high, quantile(all, 1 - tail + slack) + rounding);
      }
    }
  }
}

TEST(Bootstrap, CentresAreMeanAndMedian) {
  RandomStream stream(Purpose::test, 8, 0, 0);
  for (std::size_t size = 1; size <= 9; ++size) {
    const Sample sample = random_sample(stream, size);
    EXPECT_NEAR(centre_of(sample, Centre::mean), plain_centre(sample, Centre::mean),
                1e-14 * std::accumulate(sample.begin(), sample.end(), 0.0));
    EXPECT_EQ(centre_of(sample, Centre::median), plain_centre(sample, Centre::median));
  }
}

TEST(Bootstrap, LimitsMoveAndStretchWithTheValues) {
  RandomStream stream(Purpose::test, 9, 0, 0);
  for (const std::size_t size : {3u, 8u, 20u}) {
    const Bootstrap bootstrap(seeds_to(size));
    for (const Centre centre : {Centre::mean, Centre::median}) {
      const Sample sample = random_sample(stream, size);
      const Interval interval = bootstrap.interval(sample, centre);
      ASSERT_LT(interval.low, interval.high);
      for (const double factor : {4.0, -0.5}) {
        Sample moved = sample;
        for (double& value : moved) value = factor * value + 10;
        const Interval of_moved = bootstrap.interval(moved, centre);
        const Interval expected{factor * (factor > 0 ? interval.low : interval.high) + 10,
                                factor * (factor > 0 ? interval.high : interval.low) + 10};
        // A sum of n values, each within 100 in magnitude, rounds n times.
        const double rounding =
            100 * static_cast<double>(size) * std::numeric_limits<double>::epsilon();
        EXPECT_NEAR(of_moved.low, expected.low, rounding);
        EXPECT_NEAR(of_moved.high, expected.high, rounding);
      }
    }
  }
}

TEST(Bootstrap, OfEqualValuesTheBandIsTheValue) {
  const Bootstrap bootstrap(seeds_to(4));
  for (const Centre centre : {Centre::mean, Centre::median}) {
    const Interval interval = bootstrap.interval(Sample(4, 0.1), centre);
    EXPECT_DOUBLE_EQ(interval.low, 0.1);
    EXPECT_DOUBLE_EQ(interval.high, 0.1);
  }
}

TEST(Bootstrap, IsDrawnByTheSeedsAlone) {
  RandomStream stream(Purpose::test, 10, 0, 0);
  const Sample sample = random_sample(stream, 12);
  const auto limits = [&](const std::vector<std::uint64_t>& seeds) {
    const Interval interval = Bootstrap(seeds).interval(sample, Centre::mean);
    return std::array{interval.low, interval.high};
  };
  std::vector<std::uint64_t> others = seeds_to(12);
  others.back() = 99;
  EXPECT_EQ(limits(seeds_to(12)), limits(seeds_to(12)));
  EXPECT_NE(limits(seeds_to(12)), limits(others));
}

TEST(Bootstrap, OfTenNormalValuesCoversTheMeanAsOftenAsItShould) {
  constexpr std::size_t size = 10;
  constexpr int samples = 500;
  const Bootstrap bootstrap(seeds_to(size));
  RandomStream stream(Purpose::test, 11, 0, 0);
  int covered = 0;
  for (int s = 0; s < samples; ++s) {
    Sample sample(size);
    for (double& value : sample) {  // Box and Muller
      value = std::sqrt(-2 * std::log(1 - stream.uniform())) *
              std::cos(2 * std::numbers::pi * stream.uniform());
    }
    const Interval interval = bootstrap.interval(sample, Centre::mean);
    if (interval.low <= 0 && 0 <= interval.high) ++covered;
  }
  // The bootstrap's deviation is sqrt((n - 1) / n) of the usual one: the chance that |t| with 9
  // degrees of freedom is below 1.96 sqrt(9/10) = 1.859 is 0.904. Four deviations of a binomial.
  EXPECT_NEAR(static_cast<double>(covered) / samples, 0.904,
              4 * std::sqrt(0.904 * 0.096 / samples));
}

}  // namespace
}  // namespace metamorph::evolve
