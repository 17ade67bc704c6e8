#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/locomotion/crossed_edge.h"
#include "kernels/reference/checks.h"
#include "kernels/reference/gravity.h"
#include "kernels/reference/integrators.h"
#include "kernels/reference/self_collision.h"
#include "kernels/reference/solid.h"
#include "kernels/reference/views.h"
#include "metamorph/body.h"
#include "metamorph/reference.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// A body in a scene, with its state and the arrays of the reference kernels. Units: d, m and k.
class ReferenceSystem {
 public:
  /// Copies both. The body starts at rest as it is given; on the ground it is lowered or lifted
  /// until its lowest node is at y = 0. Collision thresholds are those of the body's positions.
  ReferenceSystem(const Body& body, const Scene& scene);

  /// Settling: no actuation, settle_damping and settle_drag. Otherwise (at first) the run itself.
  void set_settling(bool settling) { settling_ = settling; }

  /// Stops what would come below the ground in a drift by h, as every step does before its own.
  void meet_ground(double h);

  /// One step of size h from time t (time units since the start of actuation).
  void step(ReferenceMethod method, double t, double h);

  /// Sums of all forces of the scene. What is solid acts by impulses and is no part of them.
  void forces(const kernels::reference::Nodes& nodes, double t,
              const kernels::reference::Forces& sums);

  /// What acts by impulses in every step: ground, friction, the outline against itself.
  kernels::reference::Solid solid() const;

  /// Energy of everything that is conservative: springs at the rest lengths of time t, pressure,
  /// weight, self-collision.
  double potential_energy(double t);
  double kinetic_energy() const;

  kernels::reference::Health examine(double h) const;

  /// Where the outline crosses itself, if it does. Precondition: all places are finite.
  std::optional<CrossedEdge> crossed() const { return crossed_edge(body_, x, y); }

  /// A triangle without pressure that has turned over, if there is one.
  struct TurnedTriangle {
    Index triangle;
    double area_ratio;
  };
  std::optional<TurnedTriangle> turned_without_pressure() const;

  kernels::reference::State state() { return {x, y, vx, vy, ax, ay}; }
  kernels::reference::Nodes nodes() const { return {x, y, vx, vy}; }
  std::span<const kernels::reference::CollisionPair> collision_pairs() const { return pairs_; }
  kernels::reference::PressureCells pressure_cells() const;
  std::array<double, 2> mean_position() const;
  double max_speed() const;
  const std::vector<std::array<Index, 2>>& outline() const { return outline_; }

  double mass = 1;             ///< of every node, m
  std::vector<double> x, y;    ///< [nodes] position, d
  std::vector<double> vx, vy;  ///< [nodes] velocity, d per time unit
  std::vector<double> ax, ay;  ///< [nodes] acceleration of the previous step, with impulses

 private:
  void set_spring_lengths(double t);

  Body body_;
  Scene scene_;
  bool settling_ = false;
  kernels::reference::Gravity gravity_;
  std::vector<std::array<Index, 2>> outline_;
  std::vector<kernels::reference::CollisionPair> pairs_;
  std::vector<double> length_;  // [springs] actuated rest length
  std::vector<std::vector<double>> scratch_;
};

}  // namespace metamorph::core
