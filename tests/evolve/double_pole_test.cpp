#include "tests/evolve/problems/double_pole.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/evolve/random_genomes.h"
#include "tests/tolerance.h"

namespace metamorph::evolve {
namespace {

using testing::derivative;
using testing::PoleCart;
using testing::PoleState;
using tests::within;

PoleState random_state(evolve::RandomStream& stream) {
  const PoleState size = {2.4, 2, 1, 5, 1, 5};
  PoleState state;
  for (std::size_t i = 0; i < state.size(); ++i) state[i] = size[i] * stream.triangular();
  return state;
}

// A uniform rod of half length l has m (2 l)^2 / 3 about its joint.
double inertia(const PoleCart::Pole& pole) {
  return pole.mass * 4 * pole.half_length * pole.half_length / 3;
}

// Newton's laws, in which Wieland's equations are solved for the accelerations.
TEST(DoublePole, ObeysNewton) {
  PoleCart cart;
  cart.joint_friction = 0.01;  // as it is, it would not show
  evolve::RandomStream stream = testing::test_stream(31);
  for (int i = 0; i < 100; ++i) {
    const PoleState state = random_state(stream);
    const double force = 10 * stream.triangular();
    const PoleState rate = derivative(cart, state, force);
    for (const std::size_t n : {0u, 2u, 4u}) EXPECT_EQ(rate[n], state[n + 1]);
    double momentum = cart.cart_mass * rate[1];  // what changes per time
    for (std::size_t p = 0; p < 2; ++p) {
      const auto& [l, m] = cart.poles[p];
      const double sine = std::sin(state[2 + 2 * p]), cosine = std::cos(state[2 + 2 * p]);
      const double turn = state[3 + 2 * p], turned = rate[3 + 2 * p];
      momentum += m * (rate[1] + l * turned * cosine - l * turn * turn * sine);
      // Torque about the joint, in the frame of the cart.
      const double torque =
          m * l * (cart.gravity * sine - rate[1] * cosine) - cart.joint_friction * turn;
      const double size = m * l * (cart.gravity + std::abs(rate[1]));
      EXPECT_TRUE(within(inertia(cart.poles[p]) * turned - torque,
                         tests::tolerance::sum(tests::round_off_64, 20) * size));
    }
    // Friction at the joints acts between the parts; only the force comes from outside.
    const double size = 2 * (10 + cart.cart_mass * std::abs(rate[1]) + 10);
    EXPECT_TRUE(within(momentum - force, tests::tolerance::sum(tests::round_off_64, 20) * size));
  }
}

double energy(const PoleCart& cart, const PoleState& state) {
  double sum = cart.cart_mass * state[1] * state[1] / 2;
  for (std::size_t p = 0; p < 2; ++p) {
    const auto& [l, m] = cart.poles[p];
    const double cosine = std::cos(state[2 + 2 * p]), turn = state[3 + 2 * p];
    sum += m * state[1] * (state[1] / 2 + l * turn * cosine) +
           inertia(cart.poles[p]) * turn * turn / 2 + m * cart.gravity * l * cosine;
  }
  return sum;
}

// Error of the energy after a second of free motion, in steps of h.
double energy_error(double h) {
  PoleCart cart;
  cart.joint_friction = 0;
  const PoleState start = {0, 0.5, 0.3, -1, 0.1, 0};
  PoleState state = start;
  const int steps = static_cast<int>(std::lround(1 / h));
  for (int i = 0; i < steps; ++i) state = testing::runge_kutta_step(cart, state, 0, h);
  return std::abs(energy(cart, state) - energy(cart, start));
}

// A method of order 4 keeps energy to h^4 at least: halving the step takes 16 times off. Three
// halvings, and 1 in the exponent for the terms beyond.
TEST(DoublePole, KeepsEnergyToTheOrderOfItsMethod) {
  const double coarse = energy_error(0.005), fine = energy_error(0.005 / 8);
  EXPECT_LT(coarse, 1e-3 * energy(PoleCart{}, testing::pole_start()));
  EXPECT_GT(std::log2(coarse / fine), 3 * 4 - 1);
}

// The motion itself: the difference of two steps shrinks 16 times when both are halved.
TEST(DoublePole, IsIntegratedToOrderFour) {
  const auto after = [](double h) {
    PoleState state = testing::pole_start();
    const int steps = static_cast<int>(std::lround(0.4 / h));
    for (int i = 0; i < steps; ++i)
      state = testing::runge_kutta_step(PoleCart{}, state, i < steps / 2 ? -5 : 5, h);
    return state;
  };
  const PoleState a = after(0.004), b = after(0.002), c = after(0.001);
  double coarse = 0, fine = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    coarse += std::abs(a[i] - b[i]);
    fine += std::abs(b[i] - c[i]);
  }
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.5);
}

// Answers the weighted sum of its inputs.
testing::Controller line(const std::vector<float>& weights) {
  core::Network network;
  network.inputs = static_cast<int>(weights.size()) + 1;
  network.weight = weights;
  for (int i = 0; i + 1 < network.inputs; ++i) network.source.push_back(i);
  network.first_link = {0, static_cast<int>(weights.size())};
  network.output = {network.inputs};
  return {network, 1};
}

TEST(DoublePole, FallsUnderNoForceAndStandsWhereItIsUpright) {
  testing::Controller idle = line({0, 0, 0});
  const auto senses = testing::PoleSenses::positions;
  EXPECT_EQ(testing::balance(idle, senses, {}, 1000).choices, 1000);
  const testing::Balance fallen = testing::balance(idle, senses, testing::pole_start(), 1000);
  // Alone on a cart at rest the long pole would go as 4 cosh(t sqrt(3 g / 4 l)) degrees and reach
  // 36 after 0.75 s or 38 choices; the cart gives way, and the short pole, though upright at first,
  // is thrown by it. It takes no less than the short pole's own time.
  EXPECT_LT(fallen.choices, 38);
  EXPECT_GT(fallen.choices, 10);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(testing::has_fallen({sign * 2.41, 0, 0, 0, 0, 0}));
    for (const std::size_t angle : {2u, 4u}) {
      PoleState state{};
      state[angle] = sign * 35.9 * std::numbers::pi / 180;
      EXPECT_FALSE(testing::has_fallen(state));
      state[angle] = sign * 36.1 * std::numbers::pi / 180;
      EXPECT_TRUE(testing::has_fallen(state));
    }
  }
}

// A cart that is pushed without end: x = a t^2 / 2 leaves the track of 2.4 m, or a pole falls
// first.
TEST(DoublePole, CountsTheChoicesBeforeTheFall) {
  for (const auto senses :
       {testing::PoleSenses::all, testing::PoleSenses::positions, testing::PoleSenses::history}) {
    std::vector<float> weights(static_cast<std::size_t>(testing::input_count(senses)), 0.0f);
    weights[senses == testing::PoleSenses::all ? 2 : 1] = 20;  // on the angle of the long pole
    testing::Controller controller = line(weights);
    PoleState state = testing::pole_start();
    int choices = 0;
    for (;; ++choices) {
      const double force = 10 * std::tanh(20 * state[2] / 0.52 / 2);
      for (int half = 0; half < 2; ++half)
        state = testing::runge_kutta_step(PoleCart{}, state, force, testing::pole_step);
      if (testing::has_fallen(state)) break;
    }
    EXPECT_EQ(testing::balance(controller, senses, testing::pole_start(), 1000).choices, choices);
  }
}

// Instead of speeds, the change of the three positions since the choice before.
TEST(DoublePole, RemembersTheLastChoice) {
  for (std::size_t input = 0; input < 3; ++input) {
    std::vector<float> weights(6, 0.0f);
    weights[3 + input] = -3;
    testing::Controller controller = line(weights);
    const PoleState start = {0.5, 0.1, 0.05, 0, 0.02, 0};
    const testing::Balance found =
        testing::balance(controller, testing::PoleSenses::history, start, 1000);
    PoleState state = start, before = start;
    double jiggle = 0;
    int choices = 0;
    for (;; ++choices) {
      const double change = (state[2 * input] - before[2 * input]) / 0.02 / 2;
      const double force = 10 * std::tanh(-3 * change / 2);
      before = state;
      for (int half = 0; half < 2; ++half)
        state = testing::runge_kutta_step(PoleCart{}, state, force, testing::pole_step);
      jiggle += std::abs(state[0]) + std::abs(state[1]) + std::abs(state[2]) + std::abs(state[3]);
      if (testing::has_fallen(state)) break;
    }
    ASSERT_LT(choices, 100);
    EXPECT_EQ(found.choices, choices) << input;
    // The controller's tanh is 1 - 2 / (1 + e^x): a few roundings, which an unstable motion of
    // less than two seconds does not raise to a millionth.
    EXPECT_NEAR(found.jiggle, jiggle, 1e-6 * jiggle) << input;
  }
}

TEST(DampedFitness, IsGruaus) {
  EXPECT_DOUBLE_EQ(testing::damped_fitness({99, 1}), 0.1 * 0.099);
  EXPECT_DOUBLE_EQ(testing::damped_fitness({1000, 3}), 0.1 + 0.9 * 0.25);
}

}  // namespace
}  // namespace metamorph::evolve
