#pragma once

#include <utility>

#include "kernels/actuation.h"
#include "kernels/body_view.h"
#include "kernels/drag.h"
#include "kernels/ground.h"
#include "kernels/pressure.h"
#include "kernels/spring.h"

namespace metamorph::kernels {

/// How rest lengths swing, eq 3.
enum class Actuation : unsigned {
  none,        ///< settling: they do not, and every node has drag of its own
  own_period,  ///< every oscillator has a period of its own
  one_period   ///< all share one (BodyView::one_period): a fraction of the arithmetic
};

/// Which terms a step is composed of. A term that is off costs nothing.
struct Terms {
  bool pressure = true;
  bool drag = false;    ///< of outline edges, eq 4 and 5
  bool ground = false;  ///< gravity, contact, friction
  bool extra = false;   ///< forces from outside the step
  Actuation actuation = Actuation::own_period;
};

/// Every composition of terms has a number, to tabulate them.
inline constexpr unsigned compositions = 48;
constexpr Terms terms_from(unsigned number) {
  return {.pressure = (number & 1u) != 0,
          .drag = (number & 2u) != 0,
          .ground = (number & 4u) != 0,
          .extra = (number & 8u) != 0,
          .actuation = static_cast<Actuation>(number >> 4)};
}
constexpr unsigned number_of(const Terms& terms) {
  return (terms.pressure ? 1u : 0u) | (terms.drag ? 2u : 0u) | (terms.ground ? 4u : 0u) |
         (terms.extra ? 8u : 0u) | static_cast<unsigned>(terms.actuation) << 4;
}

/// Coefficients of a step, one value for all lanes.
template <class T>
struct StepCoefficients {
  T step = 0;         ///< h
  T extrapolate = 0;  ///< h/2: drift-kick-drift; 0: symplectic Euler
  T stiffness = 1, damping = 0, pressure = 0;
  T amplitude = 0;     ///< A r(t), ramp included; set per step
  T swing_sine = 0;    ///< A r(t) sin(2 pi t/T), for bodies of one period
  T swing_cosine = 0;  ///< A r(t) cos(2 pi t/T)
  T drag_normal = 0, drag_tangential = 0;
  T gravity_x = 0, gravity_y = 0;
  T ground_stiffness = 0, ground_damping = 0, friction = 0;
  T settle_drag = 0;
};

/// Extremes seen by steps since the last reset, each lane for itself.
template <class T>
struct StepExtremes {
  Lanes<T> largest_ratio{T(0)};   ///< of S0/S
  Lanes<T> smallest_ratio{T(0)};  ///< negative once a triangle was inside out
  Lanes<T> largest_speed2{T(0)};  ///< squared speed
  Lanes<T> not_finite{T(0)};      ///< not a number once a velocity was infinite or none
};

/// One step of every node: actuation, springs, pressure, drag or ground, kick and drift in one
/// pass.
///
/// The scheme is leapfrog in its staggered form. A record holds the midpoint x_n + h/2 v_n and the
/// velocity extrapolated there, v_n + h/2 a_(n-1); the kick gives v_(n+1) = v_n + h a_n, and the
/// next midpoint is x_mid + h v_(n+1): two half drifts in one. With `extrapolate` 0 and records
/// that hold (x_n, v_n) the same loop is symplectic Euler. `n` counts steps for the oscillators.
template <class T, Terms terms>
inline void step_body(const BodyView<T>& body, const StepCoefficients<T>& c, Turn<T> n,
                      StepExtremes<T>& seen) {
  using Pack = Lanes<T>;
  const Pack zero(T(0)), one(T(1)), tiny(T(1e-12));
  const Pack stiffness(c.stiffness), damping(c.damping), half_pressure_coefficient(c.pressure / 2);
  const Pack amplitude(c.amplitude), h(c.step), extrapolate(c.extrapolate);
  const Pack swing_sine(c.swing_sine), swing_cosine(c.swing_cosine);
  const GroundCoefficients<T> ground{c.ground_stiffness, c.ground_damping, c.friction};
  const DragCoefficients<T> drag{c.drag_normal, c.drag_tangential};

  StepExtremes<T> extremes = seen;  // a copy stays in registers
  for (int g = 0; g < body.groups; ++g) {
    const int node_base = lane_index<T>(g);
    const NodePack<T> self = load(body.now + node_base);
    Pack fx = zero, fy = zero;
    if constexpr (terms.extra) {
      fx = Pack::load(body.extra_fx + node_base);
      fy = Pack::load(body.extra_fy + node_base);
    }

    Pack own = zero;
    if constexpr (terms.actuation == Actuation::own_period) {
      own = fma(amplitude, oscillation(body.node_oscillator, node_base, n), one);
    }

    Pack before_dx = zero, before_dy = zero;
    if constexpr (terms.pressure) {
      if (body.ring_closed[g] != 0) {
        const NodePack<T> before = gather(body.now, body.before + node_base);
        before_dx = before.x - self.x;
        before_dy = before.y - self.y;
      }
    }
    for (int k = 0; k < body.ring_size[g]; ++k) {
      const int base = lane_index<T>(body.ring_begin[g] + k);
      const NodePack<T> other = gather(body.now, body.neighbour + base);
      const Pack dx = other.x - self.x, dy = other.y - self.y;
      const Pack length = sqrt(max(fma(dx, dx, dy * dy), tiny));

      Pack inverse_length, ratio, push = zero;
      if constexpr (terms.pressure) {
        // One division serves both 1/l and S0/S.
        const Pack rest_area2 = Pack::load(body.rest_area2 + base);
        const auto has_triangle = rest_area2 > zero;
        const Pack area2 = select(has_triangle, fma(before_dx, dy, -(before_dy * dx)), one);
        const Pack inverse = one / (length * area2);
        inverse_length = inverse * area2;
        ratio = rest_area2 * (inverse * length);
        push = select(has_triangle, half_pressure(ratio, half_pressure_coefficient), zero);
        extremes.largest_ratio = max(ratio, extremes.largest_ratio);
        extremes.smallest_ratio = min(ratio, extremes.smallest_ratio);
      } else {
        inverse_length = one / length;
      }

      Pack rest_length = Pack::load(body.rest_length + base);
      if constexpr (terms.actuation == Actuation::own_period) {
        rest_length *= fma(amplitude, oscillation(body.ring_oscillator, base, n), own);
      } else if constexpr (terms.actuation == Actuation::one_period) {
        rest_length = fma(swing_sine, Pack::load(body.swing_sine + base), rest_length);
        rest_length = fma(swing_cosine, Pack::load(body.swing_cosine + base), rest_length);
      }
      const Pack tension =
          spring_tension<T>(dx, dy, other.vx - self.vx, other.vy - self.vy, length, inverse_length,
                            rest_length, stiffness, damping, Pack::load(body.spring + base));
      if constexpr (terms.pressure) {
        fx = fma(tension, dx, fma(push, before_dy - dy, fx));
        fy = fma(tension, dy, fma(push, dx - before_dx, fy));
        before_dx = dx;
        before_dy = dy;
      } else {
        fx = fma(tension, dx, fx);
        fy = fma(tension, dy, fy);
      }
    }

    if constexpr (terms.drag) {
      if (g < body.outline_groups) {
        for (int e = 0; e < body.edge_size[g]; ++e) {
          const int base = lane_index<T>(body.edge_begin[g] + e);
          const NodePack<T> other = gather(body.now, body.edge_other + base);
          const Pack half(T(0.5));
          add_edge_drag<T>(other.x - self.x, other.y - self.y, half * (self.vx + other.vx),
                           half * (self.vy + other.vy), drag, Pack::load(body.edge_present + base),
                           fx, fy);
        }
      }
    }

    Pack normal = zero;
    if constexpr (terms.ground) {
      normal = ground_normal(self.y, self.vy, ground);
      fx += Pack(c.gravity_x);
      fy += Pack(c.gravity_y) + normal;
    }
    if constexpr (terms.actuation == Actuation::none) {
      fx = fma(Pack(-c.settle_drag), self.vx, fx);
      fy = fma(Pack(-c.settle_drag), self.vy, fy);
    }

    const Pack inverse_mass = Pack::load(body.inverse_mass + node_base);
    const Pack ax = fx * inverse_mass, ay = fy * inverse_mass;
    Pack vx = fma(h, ax, Pack::load(body.vx + node_base));
    const Pack vy = fma(h, ay, Pack::load(body.vy + node_base));
    if constexpr (terms.ground) {
      vx = after_friction(vx, ground.friction * h * normal * inverse_mass);
    }
    vx.store(body.vx + node_base);
    vy.store(body.vy + node_base);
    store({fma(h, vx, self.x), fma(h, vy, self.y), fma(extrapolate, ax, vx),
           fma(extrapolate, ay, vy)},
          body.next + node_base);

    const Pack speed2 = fma(vx, vx, vy * vy);
    extremes.largest_speed2 = max(speed2, extremes.largest_speed2);
    extremes.not_finite = fma(speed2, zero, extremes.not_finite);
  }
  seen = extremes;
}

}  // namespace metamorph::kernels
