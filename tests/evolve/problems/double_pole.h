#pragma once

#include <array>
#include <vector>

#include "metamorph/evaluation.h"
#include "tests/evolve/problems/controller.h"

namespace metamorph::evolve::testing {

/// Two poles on a cart (Wieland 1991), as Stanley and Miikkulainen (2002) set the problem: poles of
/// 1 m and 0.1 m stand upright on joints at the same cart, which is pushed along a track.
struct PoleCart {
  struct Pole {
    double half_length;  ///< m
    double mass;         ///< kg
  };
  double cart_mass = 1;                                      ///< kg
  std::array<Pole, 2> poles = {{{0.5, 0.1}, {0.05, 0.01}}};  ///< uniform rods
  double joint_friction = 2e-6;                              ///< N m s
  double gravity = 9.8;                                      ///< m/s^2
};

/// Position and speed of the cart, angle from upright and its rate of both poles: m, rad, s.
using PoleState = std::array<double, 6>;

PoleState derivative(const PoleCart& cart, const PoleState& state, double force);
/// One step of the classical Runge-Kutta method of order 4.
PoleState runge_kutta_step(const PoleCart& cart, const PoleState& state, double force, double h);

inline constexpr double pole_step = 0.01;    ///< s; the force is chosen every two steps
inline constexpr double most_force = 10;     ///< N
inline constexpr int long_balance = 100000;  ///< choices of force: 2000 s
inline constexpr int short_balance = 1000;

/// The long pole starts at 4 degrees, all else at 0.
PoleState pole_start();
/// Beyond 2.4 m of the track's middle or 36 degrees of upright.
bool has_fallen(const PoleState& state);

/// What a controller is told of the state, each over its range (4.8 m, 2 m/s, 0.52 rad, 2 rad/s).
enum class PoleSenses {
  all,        ///< six: positions and speeds
  positions,  ///< three
  history     ///< six: positions, and for speeds their change since the last choice over its time
};
int input_count(PoleSenses senses);

struct Balance {
  int choices = 0;  ///< of the force until it fell, `most` if it did not
  /// Sum of |x| + |x'| + |angle| + |angle'| of cart and long pole over the last 100 choices.
  double jiggle = 0;
};

/// Lets a controller of one output hold the poles; the force is that output times 10 N.
Balance balance(Controller& controller, PoleSenses senses, const PoleState& start, int most);

/// Fitness with speeds: choices survived. Returns whether that is all of `long_balance`.
bool evaluate_with_velocities(const core::Network& network, double slope, Evaluation& evaluation);

/// Fitness without speeds, against those who jiggle to feel their speed (Gruau, Whitley and Pyeatt
/// 1996): 0.1 t/1000 + 0.9 (0.75 / jiggle, or 0 if t < 100) after t <= 1000 choices.
double damped_fitness(const Balance& balance);

/// Of the 625 starts of Gruau et al. (five values each of x, x', angle and rate of the long pole)
/// those from which the poles stand for `short_balance` choices.
int generalization(const core::Network& network, double slope, PoleSenses senses);

}  // namespace metamorph::evolve::testing
