// What is seen of a gait: frequencies that are known, touches that can be derived or counted.

#include "core/locomotion/gait.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/bodies.h"
#include "tests/physics.h"
#include "tests/simulators.h"

namespace metamorph::core {
namespace {

using std::numbers::pi;

constexpr double interval = 2;

/// Mean positions over so many intervals.
struct Series {
  std::vector<double> x, y;
  explicit Series(std::size_t count) : x(count, 0), y(count, 0) {}

  Series& add_drift(double vx, double vy) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += vx * interval * static_cast<double>(i);
      y[i] += vy * interval * static_cast<double>(i);
    }
    return *this;
  }
  /// A swing of an amplitude, d, along a direction.
  Series& add_swing(double amplitude, double frequency, double direction, double phase) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double swing =
          amplitude * std::sin(2 * pi * frequency * interval * static_cast<double>(i) + phase);
      x[i] += std::cos(direction) * swing;
      y[i] += std::sin(direction) * swing;
    }
    return *this;
  }
  double frequency() const { return dominant_frequency(x, y, interval); }
  double resolution() const { return 1 / (interval * static_cast<double>(x.size() - 1)); }
};

// Between frequencies of whole numbers of cycles the window gives them exactly, but for what comes
// from the negative frequency: at four cycles a hundredth of a cycle, less above.
RC_GTEST_PROP(GaitFrequency, IsThatOfASwing, ()) {
  Series series(*rc::gen::inRange<std::size_t>(60, 600));
  const double lowest = 4.5 * series.resolution(), highest = 0.24 / interval;
  const double frequency = lowest + (highest - lowest) * *rc::gen::inRange(0, 1001) / 1000.0;
  const auto some = [](int most) { return *rc::gen::inRange(-1000, 1001) * most / 1000.0; };
  series.add_drift(some(1), some(1));
  const double amplitude = *rc::gen::inRange(1, 100) / 100.0;
  series.add_swing(amplitude, frequency, some(3), some(3));
  RC_ASSERT(std::abs(series.frequency() - frequency) < 0.02 * series.resolution());
}

TEST(GaitFrequency, IsThatOfTheFasterOfTwoMotions) {
  // Speeds are amplitude times frequency: 0.3 / 40 < 0.2 / 20.
  Series series(280);
  series.add_drift(0.1, 0).add_swing(0.3, 1.0 / 40, 0, 0).add_swing(0.2, 1.0 / 20, pi / 2, 1);
  EXPECT_NEAR(series.frequency(), 1.0 / 20, 0.1 * series.resolution());
  series.add_swing(0.15, 1.0 / 40, 0, 0);  // 0.45 / 40 > 0.2 / 20
  EXPECT_NEAR(series.frequency(), 1.0 / 40, 0.1 * series.resolution());
}

TEST(GaitFrequency, IsNotThatOfAWideTurn) {
  Series series(280);
  // Round a circle of 20 d, at a speed of 0.1 d per time unit, in 1260 time units.
  series.add_swing(20, 0.1 / (2 * pi * 20), 0, 0)
      .add_swing(20, 0.1 / (2 * pi * 20), pi / 2, pi / 2);
  EXPECT_EQ(series.frequency(), 0);
  series.add_swing(0.05, 1.0 / 33, 1, 0);
  EXPECT_NEAR(series.frequency(), 1.0 / 33, 0.1 * series.resolution());
}

TEST(GaitFrequency, OfWhatHardlyMovesOrOfAMomentIsNone) {
  EXPECT_EQ(Series(280).frequency(), 0);
  EXPECT_EQ(Series(280).add_drift(0.3, 0.1).frequency(), 0);
  // 1e-4 d per time unit, at a twentieth: an amplitude of 3.2e-4 d.
  EXPECT_EQ(Series(280).add_swing(2e-4, 1.0 / 20, 0, 0).frequency(), 0);
  EXPECT_GT(Series(280).add_swing(5e-4, 1.0 / 20, 0, 0).frequency(), 0);
  EXPECT_EQ(Series(16).add_swing(1, 1.0 / 8, 0, 0).frequency(), 0);
  EXPECT_EQ(Series(0).frequency(), 0);
}

Scene short_of(Scene scene) {
  scene.run_steps = 1500;
  scene.ramp_steps = 100;
  return scene;
}

TEST(Gait, OfABodyOfOnePeriodIsThatPeriodsOrItsDouble) {
  const Scene scene = short_of(water_scene());
  for (const double period : {30.0, 47.0}) {
    Body body = tests::blob_body(40, 3);
    body.period.assign(body.period.size(), period);
    for (const tests::Simulator& simulator : tests::simulators()) {
      const Outcome outcome = simulator.run(body, scene, 1, {});
      ASSERT_EQ(outcome.status, Status::ok);
      // 280 time units after the ramp: the motion is periodic, after a first cycle or so.
      const double cycles = outcome.gait_frequency * period;
      EXPECT_GE(std::lround(cycles), 1);
      EXPECT_NEAR(cycles, std::round(cycles), 0.1 * period / 280) << simulator;
    }
  }
}

// Nodes of two periods: the motion has their frequencies, sums and differences of them. Where few
// nodes have the other one it is that of the many, or its double.
TEST(Gait, OfABodyOfTwoPeriodsIsMadeOfTheirs) {
  const Scene scene = short_of(water_scene());
  for (const double border : {7.0, 13.2}) {
    Body body = tests::strip_body(30);
    for (std::size_t i = 0; i < body.x.size(); ++i) body.period[i] = body.x[i] < border ? 30 : 48;
    const double a = 1.0 / 30, b = 1.0 / 48;
    std::vector<double> expected = {a, 2 * a};
    if (border == 7) expected.insert(expected.end(), {b, 2 * b, a + b, a - b});
    for (const tests::Simulator& simulator : tests::simulators()) {
      const double found = simulator.run(body, scene, 1, {}).gait_frequency;
      double nearest = 1;
      for (const double f : expected) nearest = std::min(nearest, std::abs(found - f));
      EXPECT_LT(nearest, 0.1 / 280) << simulator << " " << found;
    }
  }
}

TEST(Gait, OfABodyAtRestOnLand) {
  Scene scene = short_of(land_scene());
  scene.amplitude = 0;
  const Body body = tests::strip_body(12);
  for (const tests::Simulator& simulator : tests::simulators()) {
    const tests::Film film = tests::film(simulator, body, scene, 1000);
    ASSERT_EQ(film.outcome.status, Status::ok);
    EXPECT_EQ(film.outcome.stance, 1) << simulator;  // its six lower nodes, all the time
    EXPECT_EQ(film.outcome.gait_frequency, 0);
    // It is a row of triangles high, less what its weight presses: a node's weight over stiffness.
    EXPECT_NEAR(film.outcome.height, 0.5 * std::numbers::sqrt3, 2 * scene.gravity);
  }
}

TEST(Gait, InWaterTouchesNothingAndIsAsHighAsTheBody) {
  const Body body = tests::blob_body(50, 8);
  const auto [least, most] = std::minmax_element(body.y.begin(), body.y.end());
  for (const tests::Simulator& simulator : tests::simulators()) {
    const Outcome outcome = simulator.run(body, short_of(water_scene()), 1, {});
    EXPECT_EQ(outcome.stance, 0);
    EXPECT_NEAR(outcome.height, *most - *least, 40 * simulator.round_off);
  }
}

// Every look again, from the frames of a run on land.
TEST(Gait, IsWhatFramesShow) {
  const Body body = tests::blob_body(40, 5);
  const Scene scene = short_of(land_scene());
  for (const tests::Simulator& simulator : tests::simulators()) {
    const tests::Film film = tests::film(simulator, body, scene, 1);
    ASSERT_EQ(film.outcome.status, Status::ok);
    const auto& start = film.pictures.front().y;
    EXPECT_EQ(film.outcome.height, *std::max_element(start.begin(), start.end()) -
                                       *std::min_element(start.begin(), start.end()));
    const auto first = static_cast<std::size_t>(std::lround(20 / scene.step));
    const auto stride = static_cast<std::size_t>(std::lround(2 / scene.step));
    std::vector<int> touches(body.x.size(), 0);
    std::vector<double> x, y;
    for (std::size_t n = first; n < film.pictures.size(); n += stride) {
      const auto& picture = film.pictures[n];
      x.push_back(tests::mean(picture.x));
      y.push_back(tests::mean(picture.y));
      for (std::size_t i = 0; i < touches.size(); ++i) touches[i] += picture.y[i] <= 0.01;
    }
    double sum = 0, nodes = 0;
    for (const int node : touches) {
      if (node == 0) continue;
      sum += static_cast<double>(node) / static_cast<double>(x.size());
      ++nodes;
    }
    EXPECT_NEAR(film.outcome.stance, sum / nodes, 1e-12) << simulator;
    EXPECT_GT(film.outcome.stance, 0);
    EXPECT_LT(film.outcome.stance, 1);
    // The fast simulator looks half a step later.
    const double again = dominant_frequency(x, y, static_cast<double>(stride) * scene.step);
    EXPECT_GT(again, 0);
    EXPECT_NEAR(film.outcome.gait_frequency, again, 0.02 / 280) << simulator;
  }
}

}  // namespace
}  // namespace metamorph::core
