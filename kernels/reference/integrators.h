#pragma once

#include <cstddef>
#include <span>

#include "kernels/reference/views.h"

/// One step of size h from time t, the same signature for every method. `force` is called as
/// force(nodes, time, forces) and overwrites the sums. `keep` is called between kick and drift as
/// keep(h, x, y, vx, vy, since_vy), with the positions that a drift by h starts from: it may change
/// the velocities by impulses (solid ground, friction, solid outlines) and the upward velocities
/// from which accelerations are counted, where there are such; see kernels/reference/solid.h.
namespace metamorph::kernels::reference {

/// What a step changes; all [nodes].
struct State {
  std::span<double> x, y, vx, vy;
  std::span<double> ax, ay;  ///< acceleration of the previous step, impulses included; 0 at first

  Nodes nodes() const { return {x, y, vx, vy}; }
};

/// Scratch of a step; all [nodes].
struct Workspace {
  std::span<double> x, y, vx, vy;      ///< a stage
  std::span<double> fx, fy;            ///< its forces
  std::span<double> dx, dy, dvx, dvy;  ///< weighted sums over the stages

  Nodes nodes() const { return {x, y, vx, vy}; }
  Forces forces() const { return {fx, fy}; }
};

struct Step {
  double t = 0;     ///< time at its start
  double h = 0;     ///< size
  double mass = 1;  ///< of every node
};

/// First order. v += h a(x, v, t), impulses, x += h v.
template <class Force, class Keep>
void symplectic_euler(const State& s, const Workspace& w, const Step& step, Force&& force,
                      Keep&& keep) {
  force(s.nodes(), step.t, w.forces());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.vx[i] += step.h * (w.fx[i] / step.mass);
    s.vy[i] += step.h * (w.fy[i] / step.mass);
  }
  keep(step.h, s.x, s.y, s.vx, s.vy, {});
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.x[i] += step.h * s.vx[i];
    s.y[i] += step.h * s.vy[i];
  }
}

/// Second order, one evaluation: half a drift, the forces at the midpoint with the velocity
/// extrapolated by the previous step's acceleration, the whole kick and impulses, half a drift;
/// what is solid looks a whole step ahead, to the next midpoint. The acceleration counts the
/// impulses: else dampers would take a node that ground or friction hold for a moving one, an error
/// of first order that never changes its sign.
template <class Force, class Keep>
void drift_kick_drift(const State& s, const Workspace& w, const Step& step, Force&& force,
                      Keep&& keep) {
  const double half = step.h / 2;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.x[i] = s.x[i] + half * s.vx[i];
    w.y[i] = s.y[i] + half * s.vy[i];
    w.vx[i] = s.vx[i] + half * s.ax[i];
    w.vy[i] = s.vy[i] + half * s.ay[i];
  }
  force(w.nodes(), step.t + half, w.forces());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.vx[i] = s.vx[i];
    w.vy[i] = s.vy[i];
    s.vx[i] += step.h * (w.fx[i] / step.mass);
    s.vy[i] += step.h * (w.fy[i] / step.mass);
  }
  keep(step.h, w.x, w.y, s.vx, s.vy, w.vy);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.ax[i] = (s.vx[i] - w.vx[i]) / step.h;
    s.ay[i] = (s.vy[i] - w.vy[i]) / step.h;
    s.x[i] = w.x[i] + half * s.vx[i];
    s.y[i] = w.y[i] + half * s.vy[i];
  }
}

/// Second order, two evaluations: half a kick, impulses, a drift, half a kick with the forces at
/// the end, for the velocity predicted there. Impulses come once per step, before the drift.
template <class Force, class Keep>
void velocity_verlet(const State& s, const Workspace& w, const Step& step, Force&& force,
                     Keep&& keep) {
  const double half = step.h / 2;
  force(s.nodes(), step.t, w.forces());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.vx[i] += half * (w.fx[i] / step.mass);
    s.vy[i] += half * (w.fy[i] / step.mass);
  }
  keep(step.h, s.x, s.y, s.vx, s.vy, {});
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.x[i] += step.h * s.vx[i];
    s.y[i] += step.h * s.vy[i];
    w.vx[i] = s.vx[i] + half * (w.fx[i] / step.mass);
    w.vy[i] = s.vy[i] + half * (w.fy[i] / step.mass);
  }
  force({s.x, s.y, w.vx, w.vy}, step.t + step.h, w.forces());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.vx[i] += half * (w.fx[i] / step.mass);
    s.vy[i] += half * (w.fy[i] / step.mass);
  }
}

/// The end of a Runge-Kutta step: state plus h times the summed slopes. Impulses act on the mean
/// velocity of the drift, and on the velocity alike; they come once per step, so against ground and
/// outline these methods are of first order: they are meant for water.
template <class Keep>
void apply_slopes(const State& s, const Workspace& w, const Step& step, Keep&& keep) {
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.vx[i] += step.h * w.dvx[i] - w.dx[i];
    s.vy[i] += step.h * w.dvy[i] - w.dy[i];
  }
  keep(step.h, s.x, s.y, w.dx, w.dy, {});
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.x[i] += step.h * w.dx[i];
    s.y[i] += step.h * w.dy[i];
    s.vx[i] += w.dx[i];
    s.vy[i] += w.dy[i];
  }
}

/// Second order, two evaluations.
template <class Force, class Keep>
void midpoint(const State& s, const Workspace& w, const Step& step, Force&& force, Keep&& keep) {
  const double half = step.h / 2;
  force(s.nodes(), step.t, w.forces());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.x[i] = s.x[i] + half * s.vx[i];
    w.y[i] = s.y[i] + half * s.vy[i];
    w.vx[i] = s.vx[i] + half * (w.fx[i] / step.mass);
    w.vy[i] = s.vy[i] + half * (w.fy[i] / step.mass);
  }
  force(w.nodes(), step.t + half, w.forces());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.dx[i] = w.vx[i];
    w.dy[i] = w.vy[i];
    w.dvx[i] = w.fx[i] / step.mass;
    w.dvy[i] = w.fy[i] / step.mass;
  }
  apply_slopes(s, w, step, keep);
}

/// The classical method of fourth order, four evaluations.
template <class Force, class Keep>
void runge_kutta_4(const State& s, const Workspace& w, const Step& step, Force&& force,
                   Keep&& keep) {
  static constexpr double weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  static constexpr double reach[4] = {0.5, 0.5, 1.0, 0.0};  // from the start to the next stage
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    w.x[i] = s.x[i];
    w.y[i] = s.y[i];
    w.vx[i] = s.vx[i];
    w.vy[i] = s.vy[i];
    w.dx[i] = w.dy[i] = w.dvx[i] = w.dvy[i] = 0;
  }
  double time = step.t;
  for (int stage = 0; stage < 4; ++stage) {
    force(w.nodes(), time, w.forces());
    const double next = reach[stage] * step.h;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const double ax = w.fx[i] / step.mass;
      const double ay = w.fy[i] / step.mass;
      w.dx[i] += weight[stage] * w.vx[i];
      w.dy[i] += weight[stage] * w.vy[i];
      w.dvx[i] += weight[stage] * ax;
      w.dvy[i] += weight[stage] * ay;
      w.x[i] = s.x[i] + next * w.vx[i];
      w.y[i] = s.y[i] + next * w.vy[i];
      w.vx[i] = s.vx[i] + next * ax;
      w.vy[i] = s.vy[i] + next * ay;
    }
    time = step.t + next;
  }
  apply_slopes(s, w, step, keep);
}

}  // namespace metamorph::kernels::reference
