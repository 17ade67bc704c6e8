#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "metamorph/random.h"
#include "metamorph/scene_fields.h"
#include "tests/bodies.h"
#include "tests/physics.h"
#include "tests/simulators.h"
#include "tests/tolerance.h"

// What a whole evaluation may not depend on: place, direction, handedness, units, and the order in
// which a body is written down.

namespace metamorph::tests {
namespace {

class Invariance : public testing::TestWithParam<Simulator> {
 protected:
  /// Two ways to compute the same motion differ by the rounding of places of up to 4 d in every
  /// step, which the damped motion does not amplify in water.
  double rounding(const core::Scene& scene) const {
    return tolerance::drift(GetParam().round_off, 4,
                            scene.run_steps * core::paper_step / scene.step);
  }
};

INSTANTIATE_TEST_SUITE_P(Simulators, Invariance, testing::ValuesIn(simulators()),
                         testing::PrintToStringParamName());

Film::Picture last_picture(const Simulator& simulator, const core::Body& body,
                           const core::Scene& scene) {
  const int steps = static_cast<int>(std::lround(scene.run_steps * core::paper_step / scene.step));
  const Film result = film(simulator, body, scene, steps);
  EXPECT_FALSE(core::is_failure(result.outcome.status)) << core::name(result.outcome.status);
  EXPECT_EQ(result.pictures.size(), 2u);
  return result.pictures.back();
}

/// An orthogonal map of the plane: x' = a x + b y + u, y' = c x + d y + v.
struct Map {
  double a = 1, b = 0, c = 0, d = 1, u = 0, v = 0;

  void apply(std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double px = x[i], py = y[i];
      x[i] = a * px + b * py + u;
      y[i] = c * px + d * py + v;
    }
  }
};

/// The body mapped. Rest lengths and areas are taken over; triangles stay counter-clockwise.
core::Body mapped(core::Body body, const Map& map) {
  map.apply(body.x, body.y);
  if (map.a * map.d - map.b * map.c < 0)
    for (auto& triangle : body.triangles) std::swap(triangle[1], triangle[2]);
  return body;
}

/// How far the motion of the mapped body ends from the map of the motion of the body.
double difference(const Simulator& simulator, const core::Body& body, const core::Scene& scene,
                  const Map& map) {
  Film::Picture plain = last_picture(simulator, body, scene);
  const Film::Picture moved = last_picture(simulator, mapped(body, map), scene);
  map.apply(plain.x, plain.y);
  return rms_distance(plain.x, plain.y, moved.x, moved.y);
}

TEST_P(Invariance, OfPlaceInWater) {
  const core::Scene scene = lasting(core::water_scene(), 270);
  EXPECT_TRUE(within(difference(GetParam(), blob_body(40, 1), scene, {.u = 3.7, .v = -2.9}),
                     rounding(scene)));
}

/// The body with coordinates that are multiples of 2^-24, so that it can be carried 2^19 away
/// without rounding: what is its shape stays.
core::Body on_a_fine_grid(core::Body body) {
  for (auto* coordinates : {&body.x, &body.y})
    for (double& value : *coordinates) value = std::ldexp(std::round(std::ldexp(value, 24)), -24);
  core::set_rest_from_nodes(body);
  return body;
}

/// What is half a million d away is told in double precision, by a few of its roundings; the
/// reference computes there.
double rounding_far_away(const Simulator& simulator, double steps) {
  const double place = std::ldexp(1.0, 19);
  return simulator.name == "reference" ? tolerance::drift(round_off_64, place, steps)
                                       : 8 * round_off_64 * place;
}

TEST_P(Invariance, OfAPlaceHalfAMillionAwayInWater) {
  const core::Scene scene = lasting(core::water_scene(), 270);
  const double place = std::ldexp(1.0, 19);
  EXPECT_TRUE(within(
      difference(GetParam(), on_a_fine_grid(blob_body(40, 1)), scene, {.u = place, .v = -place}),
      rounding(scene) + rounding_far_away(GetParam(), 270 / scene.step)));
}

TEST_P(Invariance, OfAPlaceHalfAMillionAwayOnLand) {
  core::Scene scene = lasting(core::land_scene(), 60);
  scene.settle_max_steps = 500;
  const core::Body body = on_a_fine_grid(strip_body(20));
  EXPECT_TRUE(within(difference(GetParam(), body, scene, {.u = std::ldexp(1.0, 19)}),
                     10 * tolerance::drift(GetParam().round_off, 4, 1600) +
                         10 * rounding_far_away(GetParam(), 1600)));
}

TEST_P(Invariance, OfTheDistanceOfAPlaceHalfAMillionAway) {
  const double place = std::ldexp(1.0, 19);
  const core::Scene scene = lasting(core::water_scene(), 270);
  const core::Body body = on_a_fine_grid(blob_body(40, 1));
  const auto distance = [&](const Map& map) {
    return GetParam().run(mapped(body, map), scene, 1 << 30, [](const core::Frame&) {}).distance;
  };
  EXPECT_TRUE(within(distance({.u = place, .v = place}) - distance({}),
                     rounding(scene) + rounding_far_away(GetParam(), 270 / scene.step)));
}

TEST_P(Invariance, OfDirectionInWater) {
  const core::Scene scene = lasting(core::water_scene(), 270);
  const double angle = 37 * std::numbers::pi / 180;
  const Map turn{
      .a = std::cos(angle), .b = -std::sin(angle), .c = std::sin(angle), .d = std::cos(angle)};
  EXPECT_TRUE(within(difference(GetParam(), blob_body(40, 1), scene, turn), rounding(scene)));
}

TEST_P(Invariance, OfHandednessInWater) {
  const core::Scene scene = lasting(core::water_scene(), 270);
  EXPECT_TRUE(within(difference(GetParam(), blob_body(40, 1), scene, {.a = -1}), rounding(scene)));
}

TEST_P(Invariance, OfPlaceAndHandednessOnLand) {
  // Only shortly: contact amplifies differences, by e in some 80 time units of walking, here over
  // 60 and the settling before. The quiet time is short so that settling ends at a moment that
  // hangs on no rounding: at the time-out.
  core::Scene scene = lasting(core::land_scene(), 60);
  scene.settle_max_steps = 500;
  const double amplified = 10 * tolerance::drift(GetParam().round_off, 4, 1600);
  EXPECT_TRUE(within(difference(GetParam(), strip_body(20), scene, {.u = 3.7}), amplified));
  EXPECT_TRUE(within(difference(GetParam(), strip_body(20), scene, {.a = -1}), amplified));
}

/// The scene and body in units that are 2^length of d and 2^time of the time unit: every field by
/// its unit.
core::Scene rescaled(core::Scene scene, int length, int time) {
  core::for_each_scene_field([&](const auto& field) {
    auto& value = scene.*field.member;
    using Value = std::remove_reference_t<decltype(value)>;
    const double factor = std::ldexp(1.0, length * field.unit.length + time * field.unit.time);
    if constexpr (std::is_same_v<Value, double>) value *= factor;
    if constexpr (std::is_same_v<Value, int>) value = static_cast<int>(value * factor);
  });
  return scene;
}

core::Body rescaled(core::Body body, int length, int time) {
  const double d = std::ldexp(1.0, length), t = std::ldexp(1.0, time);
  for (auto* lengths : {&body.x, &body.y, &body.rest_length})
    for (double& value : *lengths) value *= d;
  for (double& area : body.rest_area) area *= d * d;
  for (double& period : body.period) period *= t;
  return body;
}

TEST_P(Invariance, OfUnitsBitByBit) {
  // Powers of two leave every mantissa alone. (Times double: their step counts stay whole.)
  for (core::Scene scene : {core::water_scene(), core::slope_scene()}) {
    scene = lasting(scene, 100);
    scene.settle_max_steps = 400;
    const core::Body body = blob_body(40, 2);
    const Film::Picture plain = last_picture(GetParam(), body, scene);
    for (const auto& [length, time] : std::vector<std::pair<int, int>>{{1, 0}, {0, 1}, {-1, 2}}) {
      const Film::Picture other =
          last_picture(GetParam(), rescaled(body, length, time), rescaled(scene, length, time));
      int different = 0;
      for (std::size_t i = 0; i < plain.x.size(); ++i)
        different += std::ldexp(plain.x[i], length) != other.x[i] ||
                     std::ldexp(plain.y[i], length) != other.y[i];
      EXPECT_EQ(different, 0) << scene.name << " length 2^" << length << " time 2^" << time;
    }
  }
}

/// The body with its nodes renamed: node i becomes name[i]. Triangles are shuffled and begin at
/// another corner; springs are in order again, as a Body demands.
core::Body renamed(const core::Body& body, const std::vector<int>& name,
                   evolve::RandomStream& random) {
  core::Body result = body;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto j = static_cast<std::size_t>(name[i]);
    result.x[j] = body.x[i];
    result.y[j] = body.y[i];
    result.period[j] = body.period[i];
    result.phase[j] = body.phase[i];
  }
  std::vector<std::size_t> order(body.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t n = order.size(); n > 1; --n)
    std::swap(order[n - 1], order[random.below(static_cast<std::uint32_t>(n))]);
  for (std::size_t t = 0; t < order.size(); ++t) {
    const auto& triangle = body.triangles[order[t]];
    const std::uint32_t turn = random.below(3);
    for (std::size_t corner = 0; corner < 3; ++corner)
      result.triangles[t][corner] = name[static_cast<std::size_t>(triangle[(corner + turn) % 3])];
    result.rest_area[t] = body.rest_area[order[t]];
  }
  std::map<std::array<core::Index, 2>, double> springs;
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    const int i = name[static_cast<std::size_t>(body.springs[s][0])];
    const int j = name[static_cast<std::size_t>(body.springs[s][1])];
    springs[{std::min(i, j), std::max(i, j)}] = body.rest_length[s];
  }
  result.springs.clear();
  result.rest_length.clear();
  for (const auto& [ends, length] : springs) {
    result.springs.push_back(ends);
    result.rest_length.push_back(length);
  }
  return result;
}

/// How far the nodes of a renamed body end from where they end under their old names.
double renaming_difference(const Simulator& simulator, const core::Body& body,
                           const core::Scene& scene) {
  evolve::RandomStream random(evolve::Purpose::test, 5, 0, 0);
  std::vector<int> name(body.x.size());
  std::iota(name.begin(), name.end(), 0);
  for (std::size_t n = name.size(); n > 1; --n)
    std::swap(name[n - 1], name[random.below(static_cast<std::uint32_t>(n))]);
  const Film::Picture plain = last_picture(simulator, body, scene);
  const Film::Picture other = last_picture(simulator, renamed(body, name, random), scene);
  std::vector<double> x(plain.x.size()), y(plain.y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = other.x[static_cast<std::size_t>(name[i])];
    y[i] = other.y[static_cast<std::size_t>(name[i])];
  }
  return rms_distance(plain.x, plain.y, x, y);
}

TEST_P(Invariance, OfOrderInWater) {
  const core::Scene scene = lasting(core::water_scene(), 270);
  EXPECT_TRUE(within(renaming_difference(GetParam(), blob_body(40, 3), scene), rounding(scene)));
}

TEST_P(Invariance, OfOrderOnLand) {
  core::Scene scene = lasting(core::land_scene(), 60);
  scene.settle_max_steps = 500;
  EXPECT_TRUE(within(renaming_difference(GetParam(), strip_body(20), scene),
                     10 * tolerance::drift(GetParam().round_off, 4, 1600)));
}

}  // namespace
}  // namespace metamorph::tests
