#include "tests/evolve/problems/double_pole.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace metamorph::evolve::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double track = 2.4;  // m to either side
constexpr double most_angle = 36 * degree;
constexpr PoleState ranges = {4.8, 2, 0.52, 2, 0.52, 2};  // of the inputs
constexpr std::size_t jiggle_window = 100;

PoleState moved(const PoleState& state, const PoleState& rate, double time) {
  PoleState result;
  for (std::size_t i = 0; i < state.size(); ++i) result[i] = state[i] + time * rate[i];
  return result;
}

}  // namespace

PoleState derivative(const PoleCart& cart, const PoleState& state, double force) {
  std::array<double, 2> cosine, pull;  // pull: what a pole's own weight and friction turn it with
  double mass = cart.cart_mass;
  for (std::size_t p = 0; p < 2; ++p) {
    const auto& [l, m] = cart.poles[p];
    const double angle = state[2 + 2 * p], rate = state[3 + 2 * p];
    const double sine = std::sin(angle);
    cosine[p] = std::cos(angle);
    pull[p] = cart.gravity * sine - cart.joint_friction * rate / (m * l);
    force += m * l * rate * rate * sine - 0.75 * m * cosine[p] * pull[p];
    mass += m * (1 - 0.75 * cosine[p] * cosine[p]);
  }
  const double acceleration = force / mass;
  PoleState rates = {state[1], acceleration, state[3], 0, state[5], 0};
  for (std::size_t p = 0; p < 2; ++p)
    rates[3 + 2 * p] = 0.75 / cart.poles[p].half_length * (pull[p] - acceleration * cosine[p]);
  return rates;
}

PoleState runge_kutta_step(const PoleCart& cart, const PoleState& state, double force, double h) {
  const PoleState a = derivative(cart, state, force);
  const PoleState b = derivative(cart, moved(state, a, h / 2), force);
  const PoleState c = derivative(cart, moved(state, b, h / 2), force);
  const PoleState d = derivative(cart, moved(state, c, h), force);
  PoleState mean;
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (a[i] + 2 * (b[i] + c[i]) + d[i]) / 6;
  return moved(state, mean, h);
}

PoleState pole_start() { return {0, 0, 4 * degree, 0, 0, 0}; }

bool has_fallen(const PoleState& state) {
  return std::abs(state[0]) > track || std::abs(state[2]) > most_angle ||
         std::abs(state[4]) > most_angle;
}

int input_count(PoleSenses senses) { return senses == PoleSenses::positions ? 3 : 6; }

Balance balance(Controller& controller, PoleSenses senses, const PoleState& start, int most) {
  const PoleCart cart;
  PoleState state = start;
  PoleState before = start;
  std::array<double, 6> inputs{};
  const std::size_t count = static_cast<std::size_t>(input_count(senses));
  std::array<double, jiggle_window> recent{};
  Balance result;
  for (; result.choices < most; ++result.choices) {
    if (senses == PoleSenses::all) {
      for (std::size_t i = 0; i < state.size(); ++i) inputs[i] = state[i] / ranges[i];
    } else {
      for (std::size_t i = 0; i < 3; ++i) {
        inputs[i] = state[2 * i] / ranges[2 * i];
        inputs[3 + i] = (state[2 * i] - before[2 * i]) / (2 * pole_step) / ranges[2 * i + 1];
      }
      before = state;
    }
    const double force = most_force * controller({inputs.data(), count})[0];
    for (int half = 0; half < 2; ++half) state = runge_kutta_step(cart, state, force, pole_step);
    recent[static_cast<std::size_t>(result.choices) % jiggle_window] =
        std::abs(state[0]) + std::abs(state[1]) + std::abs(state[2]) + std::abs(state[3]);
    if (has_fallen(state)) break;
  }
  for (const double one : recent) result.jiggle += one;
  return result;
}

bool evaluate_with_velocities(const core::Network& network, double slope, Evaluation& evaluation) {
  Controller controller(network, slope);
  const int choices = balance(controller, PoleSenses::all, pole_start(), long_balance).choices;
  evaluation.objectives = {static_cast<double>(choices)};
  return choices == long_balance;
}

double damped_fitness(const Balance& balance) {
  const double calm = balance.choices < static_cast<int>(jiggle_window) ? 0 : 0.75 / balance.jiggle;
  return 0.1 * balance.choices / short_balance + 0.9 * calm;
}

int generalization(const core::Network& network, double slope, PoleSenses senses) {
  constexpr std::array levels = {0.05, 0.25, 0.5, 0.75, 0.95};
  const auto at = [](double level, double range) { return (2 * level - 1) * range; };
  Controller controller(network, slope);
  int stood = 0;
  for (const double x : levels)
    for (const double v : levels)
      for (const double angle : levels)
        for (const double rate : levels) {
          const PoleState start = {
              at(x, 2.16), at(v, 1.35), at(angle, 3.6 * degree), at(rate, 8.6 * degree), 0, 0};
          stood += balance(controller, senses, start, short_balance).choices == short_balance;
        }
  return stood;
}

}  // namespace metamorph::evolve::testing
