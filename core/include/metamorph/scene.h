#pragma once

#include <string>

namespace metamorph::core {

/// As the step of a scene: the program chooses one for each body (metamorph/automatic_step.h).
inline constexpr double automatic_step = 0;

/// How far an animat got, from the displacement (dx, dy) of its mean node position (MODEL section
/// 4).
enum class DistanceRule {
  euclidean,   ///< sqrt(dx^2 + dy^2): water
  horizontal,  ///< |dx|: flat land
  rightward,   ///< max(0, dx): the slope experiment
};

/// An environment as data: which terms act, and their coefficients. The step that runs is composed
/// from exactly the terms that are on. Units: d = m = k = 1, time unit sqrt(m/k); one paper step is
/// 0.2 time units.
struct Scene {
  std::string name = "water";

  // Body, in every scene.
  double stiffness = 1.0;           ///< k of eq 2
  double damping = 0.4;             ///< c of eq 2
  double pressure = 1.5;            ///< c_p of eq 1; 0 turns the term off
  double amplitude = 0.15;          ///< A of eq 3
  double min_pressure_area = 0.15;  ///< a triangle with S0 below this exerts no pressure, d^2

  // Water (eq 4, 5).
  bool drag = true;
  double drag_normal = 1.0;       ///< d_N
  double drag_tangential = 0.01;  ///< d_T

  // Land.
  bool ground = false;         ///< gravity, solid ground at y = 0 and friction (see settles() ...)
  double gravity = 0.02;       ///< g
  double slope_degrees = 0.0;  ///< gravity is turned by this angle; +x is uphill
  double friction = 0.8;       ///< mu

  // Self-collision: the outline repels itself below a gap, and stops what comes too near.
  bool self_collision = true;
  double collision_stiffness = 4.0;   ///< k_s
  double collision_gap = 0.3;         ///< d; the distance at rest where that is smaller
  double collision_least_gap = 0.05;  ///< delta, d; half the distance at rest where that is smaller

  // Time.
  double step = 0.2;     ///< time units per integrator step, or automatic_step
  int run_steps = 3000;  ///< actuation, ramp included; paper steps
  int ramp_steps = 200;  ///< paper steps
  DistanceRule distance = DistanceRule::euclidean;

  // Settling, before actuation, where there is gravity: symplectic Euler, which bears the damping
  // at twice the step of the run (the rest it reaches is the same within 0.01 d in the median).
  double settle_step = 0.2;      ///< time units per integrator step, or automatic_step
  double settle_damping = 0.8;   ///< c while settling
  double settle_drag = 0.01;     ///< drag per node while settling
  double settle_speed = 0.01;    ///< quiet below this speed, d per time unit
  int settle_quiet_steps = 800;  ///< paper steps that must be quiet
  int settle_max_steps = 6000;   ///< paper steps; then start anyway
  double settle_range = 1e9;     ///< d; a body that has slid or rolled so far starts anyway, too
};

/// Distance by a rule of a displacement (dx, dy), d.
double travelled(DistanceRule rule, double dx, double dy);

// What a scene asks of an evaluation beyond its forces. As scenes are, all of it comes with the
// ground; who needs one of these asks for that one, not for the ground.

/// The body comes to rest before it is actuated.
bool settles(const Scene& scene);
/// It is lowered or lifted at the start until its lowest node is at y = 0.
bool starts_on_ground(const Scene& scene);
/// Outcome::mean_position counts y from y = 0, not from where actuation began.
bool measures_height(const Scene& scene);
/// Bodies hit something: steps need the wider margin (stability.h), motion is not smooth, and near
/// starts may part.
bool has_impacts(const Scene& scene);
/// Pictures show the ground.
bool shows_ground(const Scene& scene);

inline constexpr double paper_step = 0.2;  ///< time units

/// The four environments of MODEL section 7.
Scene water_scene();
Scene land_scene();        ///< flat, |dx|
Scene land_right_scene();  ///< flat, rightward only
Scene slope_scene();       ///< 17 degrees, rightward only

}  // namespace metamorph::core
