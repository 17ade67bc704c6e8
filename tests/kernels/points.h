#pragma once

// A few point masses with the arrays that the reference integrators borrow.

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "kernels/reference/integrators.h"
#include "kernels/reference/views.h"

namespace metamorph::tests {

namespace ref = kernels::reference;

struct Points {
  explicit Points(std::size_t n)
      : x(n), y(n), vx(n), vy(n), ax(n), ay(n), scratch(10, std::vector<double>(n)) {}

  ref::State state() { return {x, y, vx, vy, ax, ay}; }
  ref::Nodes nodes() const { return {x, y, vx, vy}; }
  ref::Workspace workspace() {
    return {scratch[0], scratch[1], scratch[2], scratch[3], scratch[4],
            scratch[5], scratch[6], scratch[7], scratch[8], scratch[9]};
  }

  std::vector<double> x, y, vx, vy, ax, ay;
  std::vector<std::vector<double>> scratch;
};

/// Forces as zeroed sums to add to.
using ForceLaw = std::function<void(const ref::Nodes&, double t, const ref::Forces&)>;

/// Impulses between kick and drift, see kernels/reference/integrators.h.
using Keep =
    std::function<void(double h, std::span<const double> x, std::span<const double> y,
                       std::span<double> vx, std::span<double> vy, std::span<double> since_vy)>;

inline void keep_nothing(double, std::span<const double>, std::span<const double>,
                         std::span<double>, std::span<double>, std::span<double>) {}

struct Integrator {
  std::string name;
  int order = 0;
  std::function<void(const ref::State&, const ref::Workspace&, const ref::Step&, const ForceLaw&,
                     const Keep&)>
      step;
};

inline std::ostream& operator<<(std::ostream& out, const Integrator& integrator) {
  return out << integrator.name;
}

inline const Integrator symplectic_euler = {"SymplecticEuler", 1,
                                            ref::symplectic_euler<const ForceLaw&, const Keep&>};
inline const Integrator drift_kick_drift = {"DriftKickDrift", 2,
                                            ref::drift_kick_drift<const ForceLaw&, const Keep&>};
inline const Integrator velocity_verlet = {"VelocityVerlet", 2,
                                           ref::velocity_verlet<const ForceLaw&, const Keep&>};
inline const Integrator midpoint = {"Midpoint", 2, ref::midpoint<const ForceLaw&, const Keep&>};
inline const Integrator runge_kutta_4 = {"RungeKutta4", 4,
                                         ref::runge_kutta_4<const ForceLaw&, const Keep&>};

inline std::vector<Integrator> all_integrators() {
  return {symplectic_euler, drift_kick_drift, velocity_verlet, midpoint, runge_kutta_4};
}

/// Steps from time 0 to `duration`. `law` adds to sums that are zero.
inline void integrate(Points& points, const Integrator& integrator, double duration, double h,
                      const ForceLaw& law, const Keep& keep = keep_nothing, double mass = 1) {
  const ForceLaw cleared = [&law](const ref::Nodes& nodes, double t, const ref::Forces& sums) {
    std::fill(sums.x.begin(), sums.x.end(), 0.0);
    std::fill(sums.y.begin(), sums.y.end(), 0.0);
    law(nodes, t, sums);
  };
  const long steps = std::lround(duration / h);
  for (long n = 0; n < steps; ++n)
    integrator.step(points.state(), points.workspace(), {static_cast<double>(n) * h, h, mass},
                    cleared, keep);
}

}  // namespace metamorph::tests
