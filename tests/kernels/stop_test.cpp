// What stops approaches, plain (kernels/reference/solid.h) and fast (kernels/stop.h).

#include "kernels/stop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/kernels/solid_cloud.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

namespace ref = kernels::reference;

struct Stopper {
  std::string name;
  double round_off;
  std::function<Cloud(const Cloud&, bool ground, double friction)> stop;
};

std::ostream& operator<<(std::ostream& out, const Stopper& stopper) { return out << stopper.name; }

class Stop : public testing::TestWithParam<Stopper> {
 protected:
  Cloud stop(const Cloud& cloud, bool ground = false, double friction = 0) const {
    return GetParam().stop(cloud, ground, friction);
  }
  double round_off() const { return GetParam().round_off; }
  /// Of a velocity after the stop: directions of pairs 0.01 apart, from coordinates of up to 4,
  /// rounded; from there on it grows by no more than a few in a few impulses.
  double rounding(const Cloud& cloud) const {
    return tolerance::sum(round_off(), 8) * 4 / 0.01 * std::max(cloud.fastest(), 1.0);
  }
};

INSTANTIATE_TEST_SUITE_P(
    Kernels, Stop,
    testing::Values(Stopper{"reference", round_off_64, kept_apart},
                    Stopper{"float64", round_off_64,
                            [](const Cloud& cloud, bool ground, double friction) {
                              return FastStop<double>(cloud, ground, friction).after;
                            }},
                    Stopper{"float32", round_off_32,
                            [](const Cloud& cloud, bool ground, double friction) {
                              return FastStop<float>(cloud, ground, friction).after;
                            }}),
    testing::PrintToStringParamName());

TEST(LeastSeparation, LetsRoomBeUsedUpAndLeadsBackNoFasterThanItCame) {
  constexpr double h = 0.25;
  const auto fast = [](double room, double v) {
    EXPECT_EQ(kernels::least_separation<float>(static_cast<float>(room), static_cast<float>(v), 4),
              static_cast<float>(ref::least_separation(room, v, h)));
    EXPECT_EQ(kernels::least_separation(room, v, 1 / h), ref::least_separation(room, v, h));
    return kernels::least_separation(room, v, 1 / h);
  };
  EXPECT_EQ(fast(0.5, -9), -2);  // room is used up at the end of the drift
  EXPECT_EQ(fast(0.5, 9), -2);
  EXPECT_EQ(fast(0, -1), 0);
  EXPECT_DOUBLE_EQ(fast(-0.125, -9), 0.2 * 0.125 / h);  // a fifth of what is missing
  EXPECT_EQ(fast(-0.125, -0.0625), 0.0625);             // as fast as it came
  EXPECT_EQ(fast(-0.125, 0), 0);                        // what rests or leaves is let alone
  EXPECT_EQ(fast(-0.125, 9), 0);
}

TEST_P(Stop, LeavesAloneWhatDoesNotComeTooNear) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 1);
  int alone = 0;
  for (int i = 0; i < 2000; ++i) {
    const Cloud cloud = random_cloud(random, 1, 1, 2, 1);
    const Separation now = separation(cloud, cloud, cloud.pairs[0]);
    if (now.room < 2 * cloud.h * 2 * cloud.fastest()) continue;
    const Cloud after = stop(cloud);
    EXPECT_EQ(after.vx, cloud.vx);
    EXPECT_EQ(after.vy, cloud.vy);
    ++alone;
  }
  EXPECT_GT(alone, 100);
}

TEST_P(Stop, OnePairKeepsItsLeastSeparation) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 2);
  int acted = 0, led_back = 0;
  for (int i = 0; i < 5000; ++i) {
    const Cloud before = random_cloud(random, 1, 1, 0.6, 3);
    const Cloud after = stop(before);
    const Separation s = separation(before, after, before.pairs[0]);
    EXPECT_TRUE(within(std::max(s.least - s.velocity, 0.0), rounding(before))) << "cloud " << i;
    const bool hit = separation(before, before, before.pairs[0]).velocity < s.least;
    acted += hit;
    led_back += hit && s.room < 0;
  }
  EXPECT_GT(acted, 1000);
  EXPECT_GT(led_back, 20);
}

TEST_P(Stop, HardlyEverDoesAPairPassThroughAtSpeedsThatStepsResolve) {
  // Drifts of up to an eighth of d per coordinate, at angular speeds no body has: an impulse at the
  // place of the least gap cannot always turn round, without adding energy, what meets elsewhere on
  // the edge. What would pass through otherwise must be rare to the third digit.
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 3);
  int would = 0, passed = 0;
  for (int i = 0; i < 40000; ++i) {
    const Cloud before = random_cloud(random, 1, 1, 0.8, 1);
    would += passes_through(before, before.pairs[0]);
    passed += passes_through(stop(before), before.pairs[0]);
  }
  EXPECT_GT(would, 1000);
  EXPECT_TRUE(within(passed, 0.01 * would)) << passed << " of " << would;
}

TEST_P(Stop, APairThatMovesHeadOnNeverPassesThrough) {
  // An edge that does not turn and a node that does not slide along it, at any speed.
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 10);
  int would = 0;
  for (int i = 0; i < 5000; ++i) {
    Cloud before = random_cloud(random, 1, 1, 0.8, 8);
    const auto point = ref::closest_point(2, {0, 1}, before.x, before.y);
    const double towards = 8 * random.uniform() / point.gap;
    for (std::size_t n : {0u, 1u}) before.vx[n] = before.vy[n] = 0;
    before.vx[2] = static_cast<double>(static_cast<float>(-towards * point.dx));
    before.vy[2] = static_cast<double>(static_cast<float>(-towards * point.dy));
    would += passes_through(before, before.pairs[0]);
    EXPECT_FALSE(passes_through(stop(before), before.pairs[0])) << "cloud " << i;
  }
  EXPECT_GT(would, 1000);
}

TEST_P(Stop, KeepsMomentumAndAngularMomentum) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 4);
  int acted = 0;
  for (int i = 0; i < 1000; ++i) {
    const Cloud before = random_cloud(random, 4, 4, 2, 2);
    const Cloud after = stop(before);
    double x = 0, y = 0, angular = 0, pushed = 0;
    for (std::size_t n = 0; n < before.x.size(); ++n) {
      const double dx = after.vx[n] - before.vx[n], dy = after.vy[n] - before.vy[n];
      x += dx;
      y += dy;
      angular += before.x[n] * dy - before.y[n] * dx;
      pushed += std::abs(dx) + std::abs(dy);
    }
    // Every impulse of 12 nodes' rounds where it is added; that it goes through the point where the
    // pair is nearest hangs on the direction of a gap of 0.01 and more, over which it acts.
    const double linear = tolerance::sum(round_off(), 64) * 12 * before.fastest();
    EXPECT_TRUE(within(std::max(std::abs(x), std::abs(y)), linear));
    EXPECT_TRUE(within(angular, 4 * linear));
    acted += pushed > 0;
  }
  EXPECT_GT(acted, 600);
}

TEST_P(Stop, NeverAddsEnergy) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 5);
  for (int i = 0; i < 3000; ++i) {
    const bool ground = i % 2 != 0;
    const double speed = 0.1 * std::exp2(6 * random.uniform());
    Cloud before = random_cloud(random, 4, 4, 1.5, speed);
    before.h = 0.05 * std::exp2(static_cast<double>(random.below(4)));
    const Cloud after = stop(before, ground, random.uniform());
    EXPECT_LE(after.energy(), before.energy() * (1 + tolerance::sum(round_off(), 256)));
  }
}

TEST_P(Stop, PushesNothingIntoTheGround) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 6);
  int held = 0;
  for (int i = 0; i < 1000; ++i) {
    Cloud before = random_cloud(random, 4, 4, 1, 2);
    for (std::size_t n = 0; n < before.y.size(); n += 3) before.y[n] = 0;
    for (const auto& pair : before.pairs)
      if (ref::closest_point(pair.node, pair.edge, before.x, before.y).gap < 0.01) before.h = 0;
    if (before.h == 0) continue;
    const Cloud after = stop(before, true, 0.8);
    for (std::size_t n = 0; n < before.y.size(); ++n) {
      EXPECT_TRUE(within(std::min(before.y[n] + before.h * after.vy[n], 0.0), 4 * round_off()));
      held += before.y[n] + before.h * after.vy[n] < 1e-6;
    }
  }
  EXPECT_GT(held, 300);
}

TEST_P(Stop, SweepsSettleWhatManyPairsWant) {
  // One pair undoes a part of what another has got. What is left of all that was missing after four
  // sweeps is little; that of a single sweep, pair by pair, would be half and more.
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 7);
  double wanted = 0, left = 0;
  for (int i = 0; i < 1000; ++i) {
    const Cloud before = random_cloud(random, 4, 4, 2, 2);
    const Cloud after = stop(before);
    for (const auto& pair : before.pairs) {
      const Separation then = separation(before, before, pair), s = separation(before, after, pair);
      wanted += std::max(then.least - then.velocity, 0.0);
      left += std::max(s.least - s.velocity, 0.0);
    }
  }
  EXPECT_TRUE(within(left / wanted, 0.1));
}

template <class T>
double largest_difference(const Cloud& before, bool ground) {
  const Cloud plain = kept_apart(before, ground, 0.6),
              fast = FastStop<T>(before, ground, 0.6).after;
  double largest = 0;
  for (std::size_t i = 0; i < plain.vx.size(); ++i)
    largest =
        std::max({largest, std::abs(plain.vx[i] - fast.vx[i]), std::abs(plain.vy[i] - fast.vy[i])});
  return largest;
}

template <class T>
void expect_agreement(double round_off) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 8);
  int acted = 0;
  for (int i = 0; i < 1000; ++i) {
    const Cloud before = random_cloud(random, 4, 4, 2, 2);
    const bool ground = i % 2 != 0;
    // Both are continuous in what they are given: directions of gaps above 0.01 between coordinates
    // of up to 4, and rooms over the step; up to four sweeps of 40 pairs take that on.
    const double rounding = tolerance::sum(round_off, 40 * 4) * (4 / 0.01 + 4 / before.h);
    EXPECT_TRUE(within(largest_difference<T>(before, ground), rounding)) << "cloud " << i;
    acted += kept_apart(before, ground).vx != before.vx;
  }
  EXPECT_GT(acted, 600);
}

TEST(FastStop, AgreesWithThePlainOneInDouble) { expect_agreement<double>(round_off_64); }
TEST(FastStop, AgreesWithThePlainOneInFloat) { expect_agreement<float>(round_off_32); }

TEST(FastStop, LeadsRecordsWhereTheNewVelocitiesDoAndBoundsTheSpeedOfWhatItTouched) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 9);
  int acted = 0;
  for (int i = 0; i < 200; ++i) {
    const Cloud before = random_cloud(random, 3, 3, 1.5, 2);
    const FastStop<double> fast(before);
    double change = 0, fastest = 0;
    for (std::size_t n = 0; n < before.x.size(); ++n) {
      const double dx = fast.after.vx[n] - before.vx[n], dy = fast.after.vy[n] - before.vy[n];
      change = std::max(change, std::hypot(dx, dy));
      if (dx != 0 || dy != 0)
        fastest = std::max(fastest, std::hypot(fast.after.vx[n], fast.after.vy[n]));
      const double rounding = tolerance::sum(round_off_64, 64) * 8;
      EXPECT_TRUE(within(fast.next[n].x - before.x[n] - before.h * fast.after.vx[n], rounding));
      EXPECT_TRUE(within(fast.next[n].y - before.y[n] - before.h * fast.after.vy[n], rounding));
      // Extrapolated by half of the change, as FastStop asks for.
      EXPECT_TRUE(within(fast.next[n].vx - before.vx[n] - 1.5 * dx, rounding));
      EXPECT_TRUE(within(fast.next[n].vy - before.vy[n] - 1.5 * dy, rounding));
    }
    EXPECT_EQ(fast.stopped.any, change > 0);
    EXPECT_GE(fast.stopped.fastest2 * (1 + 64 * round_off_64), fastest * fastest);
    acted += fast.stopped.any;
  }
  EXPECT_GT(acted, 100);
}

TEST_P(Stop, ANodeSlidingRoundTheEndOfATurningEdgeDoesNotPassThroughIt) {
  // The node is beyond the end of the edge, straight ahead of it, and goes sideways: along the gap
  // nothing approaches. But the edge grows past it and turns into its way.
  int would = 0;
  for (double turn = 0; turn <= 6; turn += 0.25)
    for (double growth = 0; growth <= 3; growth += 0.25)
      for (double aside = -1; aside <= 1; aside += 0.25) {
        Cloud cloud;
        cloud.x = {0, 1, 1.0625};
        cloud.y = {1, 1, 1.03125};
        cloud.vx = {0, growth, 0};
        cloud.vy = {0, turn, aside};
        cloud.pairs = {{2, {0, 1}, 0.0625}};
        would += passes_through(cloud, cloud.pairs[0]);
        EXPECT_FALSE(passes_through(stop(cloud), cloud.pairs[0]))
            << "turn " << turn << " growth " << growth << " aside " << aside;
      }
  EXPECT_GT(would, 10);
}

}  // namespace
}  // namespace metamorph::tests
