#pragma once

#include <cstddef>
#include <span>

#include "kernels/reference/ground.h"
#include "kernels/reference/views.h"

/// One step of size h from time t, the same signature for every method. `force` is called as
/// force(nodes, time, forces, normal) and overwrites both results: the sums, and the ground's
/// normal force per node, without friction. Friction is an impulse on vx after a kick.
namespace metamorph::kernels::reference {

/// What a step changes; all [nodes].
struct State {
  std::span<double> x, y, vx, vy;
  std::span<double> ax, ay;  ///< acceleration of the previous step, friction included; 0 at first

  Nodes nodes() const { return {x, y, vx, vy}; }
};

/// Scratch of a step; all [nodes].
struct Workspace {
  std::span<double> x, y, vx, vy;      ///< a stage
  std::span<double> fx, fy, normal;    ///< its forces
  std::span<double> dx, dy, dvx, dvy;  ///< weighted sums over the stages
  std::span<double> push;              ///< and that of the normal force

  Nodes nodes() const { return {x, y, vx, vy}; }
  Forces forces() const { return {fx, fy}; }
};

struct Step {
  double t = 0;         ///< time at its start
  double h = 0;         ///< size
  double mass = 1;      ///< of every node
  double friction = 0;  ///< mu
};

/// First order. v += h a(x, v, t), friction, x += h v.
template <class Force>
void symplectic_euler(const State& s, const Workspace& w, const Step& step, Force&& force) {
  force(s.nodes(), step.t, w.forces(), w.normal);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.vx[i] = after_friction(s.vx[i] + step.h * (w.fx[i] / step.mass),
                             step.friction * step.h * w.normal[i] / step.mass);
    s.vy[i] += step.h * (w.fy[i] / step.mass);
    s.x[i] += step.h * s.vx[i];
    s.y[i] += step.h * s.vy[i];
  }
}

/// Second order, one evaluation: half a drift, the forces at the midpoint with the velocity
/// extrapolated by the previous step's acceleration, the whole kick and friction, half a drift. The
/// acceleration counts friction: else dampers would take a node that friction holds for a moving
/// one, an error of first order that never changes its sign.
template <class Force>
void drift_kick_drift(const State& s, const Workspace& w, const Step& step, Force&& force) {
  const double half = step.h / 2;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.x[i] = s.x[i] + half * s.vx[i];
    w.y[i] = s.y[i] + half * s.vy[i];
    w.vx[i] = s.vx[i] + half * s.ax[i];
    w.vy[i] = s.vy[i] + half * s.ay[i];
  }
  force(w.nodes(), step.t + half, w.forces(), w.normal);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.ax[i] = w.fx[i] / step.mass;
    s.ay[i] = w.fy[i] / step.mass;
    const double before = s.vx[i];
    s.vx[i] =
        after_friction(before + step.h * s.ax[i], step.friction * step.h * w.normal[i] / step.mass);
    if (step.friction > 0) s.ax[i] = (s.vx[i] - before) / step.h;
    s.vy[i] += step.h * s.ay[i];
    s.x[i] = w.x[i] + half * s.vx[i];
    s.y[i] = w.y[i] + half * s.vy[i];
  }
}

/// Second order, two evaluations: half a kick, a drift, half a kick with the forces at the end, for
/// the velocity predicted there. Each half kick has its share of friction.
template <class Force>
void velocity_verlet(const State& s, const Workspace& w, const Step& step, Force&& force) {
  const double half = step.h / 2;
  force(s.nodes(), step.t, w.forces(), w.normal);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double kick_x = half * (w.fx[i] / step.mass);
    const double kick_y = half * (w.fy[i] / step.mass);
    s.vx[i] = after_friction(s.vx[i] + kick_x, step.friction * half * w.normal[i] / step.mass);
    s.vy[i] += kick_y;
    s.x[i] += step.h * s.vx[i];
    s.y[i] += step.h * s.vy[i];
    w.vx[i] = s.vx[i] + kick_x;
    w.vy[i] = s.vy[i] + kick_y;
  }
  force({s.x, s.y, w.vx, w.vy}, step.t + step.h, w.forces(), w.normal);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.vx[i] = after_friction(s.vx[i] + half * (w.fx[i] / step.mass),
                             step.friction * half * w.normal[i] / step.mass);
    s.vy[i] += half * (w.fy[i] / step.mass);
  }
}

/// The end of a Runge-Kutta step: state plus h times the summed slopes. Friction comes last and
/// acts on the velocity alone, so on the ground these methods are of first order: they are meant
/// for water.
inline void apply_slopes(const State& s, const Workspace& w, const Step& step) {
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.x[i] += step.h * w.dx[i];
    s.y[i] += step.h * w.dy[i];
    s.vx[i] =
        after_friction(s.vx[i] + step.h * w.dvx[i], step.friction * step.h * w.push[i] / step.mass);
    s.vy[i] += step.h * w.dvy[i];
  }
}

/// Second order, two evaluations.
template <class Force>
void midpoint(const State& s, const Workspace& w, const Step& step, Force&& force) {
  const double half = step.h / 2;
  force(s.nodes(), step.t, w.forces(), w.normal);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.x[i] = s.x[i] + half * s.vx[i];
    w.y[i] = s.y[i] + half * s.vy[i];
    w.vx[i] = s.vx[i] + half * (w.fx[i] / step.mass);
    w.vy[i] = s.vy[i] + half * (w.fy[i] / step.mass);
  }
  force(w.nodes(), step.t + half, w.forces(), w.normal);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.dx[i] = w.vx[i];
    w.dy[i] = w.vy[i];
    w.dvx[i] = w.fx[i] / step.mass;
    w.dvy[i] = w.fy[i] / step.mass;
    w.push[i] = w.normal[i];
  }
  apply_slopes(s, w, step);
}

/// The classical method of fourth order, four evaluations.
template <class Force>
void runge_kutta_4(const State& s, const Workspace& w, const Step& step, Force&& force) {
  static constexpr double weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  static constexpr double reach[4] = {0.5, 0.5, 1.0, 0.0};  // from the start to the next stage
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.x[i] = s.x[i];
    w.y[i] = s.y[i];
    w.vx[i] = s.vx[i];
    w.vy[i] = s.vy[i];
    w.dx[i] = w.dy[i] = w.dvx[i] = w.dvy[i] = w.push[i] = 0;
  }
  double time = step.t;
  for (int stage = 0; stage < 4; ++stage) {
    force(w.nodes(), time, w.forces(), w.normal);
    const double next = reach[stage] * step.h;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const double ax = w.fx[i] / step.mass;
      const double ay = w.fy[i] / step.mass;
      w.dx[i] += weight[stage] * w.vx[i];
      w.dy[i] += weight[stage] * w.vy[i];
      w.dvx[i] += weight[stage] * ax;
      w.dvy[i] += weight[stage] * ay;
      w.push[i] += weight[stage] * w.normal[i];
      w.x[i] = s.x[i] + next * w.vx[i];
      w.y[i] = s.y[i] + next * w.vy[i];
      w.vx[i] = s.vx[i] + next * ax;
      w.vy[i] = s.vy[i] + next * ay;
    }
    time = step.t + next;
  }
  apply_slopes(s, w, step);
}

}  // namespace metamorph::kernels::reference
