#pragma once

#include <type_traits>
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
  none,          ///< settling: they do not, and every node has drag of its own
  one_period,    ///< all oscillators share the main period: a fraction of the arithmetic
  mixed_periods  ///< some have another (BodyView::odd); what does not gets the same bits
};

/// Which terms a step is composed of. A term that is off costs nothing.
struct Terms {
  bool pressure = true;
  bool drag = false;    ///< of outline edges, eq 4 and 5
  bool ground = false;  ///< gravity, solid ground, friction
  bool extra = false;   ///< forces from outside the step
  Actuation actuation = Actuation::one_period;
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
  T swing_sine = 0;    ///< A r(t) sin(2 pi t/T), T the body's main period
  T swing_cosine = 0;  ///< A r(t) cos(2 pi t/T)
  T drag_normal = 0, drag_tangential = 0;
  T gravity_x = 0, gravity_y = 0;
  T friction = 0;
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

/// The state of a body's nodes as records, read from `now` and written to `next`.
template <class T>
struct Records {
  const BodyView<T>& body;

  NodePack<T> own(int lane) const { return load(body.now + lane); }
  NodePack<T> neighbour(int slot) const { return gather(body.now, body.neighbour + slot); }
  NodePack<T> edge_end(int slot) const { return gather(body.now, body.edge_other + slot); }
  void put(int lane, const NodePack<T>& pack) const { store(pack, body.next + lane); }
};

/// One step of every node: actuation, springs, pressure, drag or ground, kick and drift in one
/// pass.
///
/// The scheme is leapfrog in its staggered form. A record holds the midpoint x_n + h/2 v_n and the
/// velocity extrapolated there, v_n + h/2 a_(n-1); the kick gives v_(n+1) = v_n + h a_n, and the
/// next midpoint is x_mid + h v_(n+1): two half drifts in one. The acceleration that extrapolates
/// is that of the velocity, friction included: what friction holds does not move. What the ground
/// has stopped it holds: it has none upwards. With
/// `extrapolate` 0 and records that hold (x_n, v_n) the same loop is symplectic Euler. `n` counts
/// steps for the oscillators.
///
/// `state` is where nodes are read and written, see Records.
template <class T, Terms terms, class State>
inline void step_body(const BodyView<T>& body, const StepCoefficients<T>& c, Turn<T> n,
                      StepExtremes<T>& seen, State&& state) {
  using Pack = Lanes<T>;
  const Pack zero(T(0)), one(T(1)), tiny(T(1e-12));
  const Pack stiffness(c.stiffness), damping(c.damping), half_pressure_coefficient(c.pressure / 2);
  const Pack amplitude(c.amplitude), h(c.step), extrapolate(c.extrapolate);
  const Pack extrapolate_share(c.extrapolate / c.step);
  const Pack swing_sine(c.swing_sine), swing_cosine(c.swing_cosine);
  const Pack inverse_step(T(1) / c.step), friction(c.friction);
  const DragCoefficients<T> drag{c.drag_normal, c.drag_tangential};

  StepExtremes<T> extremes = seen;  // a copy stays in registers
  for (int g = 0; g < body.groups; ++g) {
    const int node_base = lane_index<T>(g);
    const NodePack<T> self = state.own(node_base);
    Pack fx = zero, fy = zero;
    if constexpr (terms.extra) {
      fx = Pack::load(body.extra_fx + node_base);
      fy = Pack::load(body.extra_fy + node_base);
    }

    const auto pull = [&](const NodePack<T>& other, Pack dx, Pack dy, Pack length2,
                          Pack inverse_length2, int slot, auto odd, Pack own) {
      Pack rest_length = Pack::load(body.rest_length + slot);
      if constexpr (terms.actuation != Actuation::none) {
        const Pack at_rest = rest_length;
        rest_length = fma(swing_sine, Pack::load(body.swing_sine + slot), rest_length);
        rest_length = fma(swing_cosine, Pack::load(body.swing_cosine + slot), rest_length);
        if constexpr (odd) {
          const Pack other_end = amplitude * Pack::load(body.ring_odd + slot) *
                                 oscillation(body.ring_oscillator, slot, n);
          rest_length = fma(at_rest, own + other_end, rest_length);
        }
      }
      const Pack tension = spring_tension<T>(dx, dy, other.vx - self.vx, other.vy - self.vy,
                                             sqrt(length2), inverse_length2, rest_length, stiffness,
                                             damping, Pack::load(body.spring + slot));
      fx = fma(tension, dx, fx);
      fy = fma(tension, dy, fy);
    };
    // The triangle of this node and the ends of two vectors from it, counter-clockwise.
    const auto press = [&](Pack before_dx, Pack before_dy, Pack dx, Pack dy, LaneMask<T> present,
                           Pack ratio) {
      const Pack push = select(present, half_pressure(ratio, half_pressure_coefficient), zero);
      extremes.largest_ratio = max(ratio, extremes.largest_ratio);
      extremes.smallest_ratio = min(ratio, extremes.smallest_ratio);
      fx = fma(push, before_dy - dy, fx);
      fy = fma(push, dx - before_dx, fy);
    };
    const auto cross = [&](Pack ax, Pack ay, Pack bx, Pack by, LaneMask<T> present) {
      return select(present, fma(ax, by, -(ay * bx)), one);
    };

    const int first_slot = lane_index<T>(body.ring_begin[g]);
    const int end_slot = first_slot + lane_index<T>(body.ring_size[g]);
    const NodePack<T> first = state.neighbour(first_slot);
    const Pack first_dx = first.x - self.x, first_dy = first.y - self.y;
    Pack before_dx = first_dx, before_dy = first_dy;
    Pack last_vx = first.vx, last_vy = first.vy;
    const auto sum_ring = [&](auto odd, Pack own) {
      {
        const Pack length2 = max(fma(first_dx, first_dx, first_dy * first_dy), tiny);
        pull(first, first_dx, first_dy, length2, one / length2, first_slot, odd, own);
      }
      for (int slot = first_slot + Pack::width; slot < end_slot; slot += Pack::width) {
        const NodePack<T> other = state.neighbour(slot);
        const Pack dx = other.x - self.x, dy = other.y - self.y;
        const Pack length2 = max(fma(dx, dx, dy * dy), tiny);
        if constexpr (terms.pressure) {
          // One division serves both 1/l^2 and S0/S.
          const Pack rest_area2 = Pack::load(body.rest_area2 + slot);
          const auto present = rest_area2 > zero;
          const Pack area2 = cross(before_dx, before_dy, dx, dy, present);
          const Pack inverse = one / (length2 * area2);
          press(before_dx, before_dy, dx, dy, present, rest_area2 * (inverse * length2));
          pull(other, dx, dy, length2, inverse * area2, slot, odd, own);
        } else {
          pull(other, dx, dy, length2, one / length2, slot, odd, own);
        }
        before_dx = dx;
        before_dy = dy;
        last_vx = other.vx;
        last_vy = other.vy;
      }
    };
    if (terms.actuation == Actuation::mixed_periods && body.odd[g] != 0) {
      // Rare oscillators of other periods: what they add is exactly 0 in all other lanes.
      sum_ring(std::true_type(), amplitude * Pack::load(body.node_odd + node_base) *
                                     oscillation(body.node_oscillator, node_base, n));
    } else {
      sum_ring(std::false_type(), zero);
    }
    if constexpr (terms.pressure) {
      if (body.ring_closed[g] != 0) {
        const Pack rest_area2 = Pack::load(body.closing_area2 + node_base);
        const auto present = rest_area2 > zero;
        const Pack area2 = cross(before_dx, before_dy, first_dx, first_dy, present);
        press(before_dx, before_dy, first_dx, first_dy, present, rest_area2 / area2);
      }
    }

    if constexpr (terms.drag) {
      if (g < body.outline_groups) {
        const auto resist = [&](Pack dx, Pack dy, Pack other_vx, Pack other_vy, Pack present) {
          const Pack half(T(0.5));
          add_edge_drag<T>(dx, dy, half * (self.vx + other_vx), half * (self.vy + other_vy), drag,
                           present, fx, fy);
        };
        const Pack on_outline = Pack::load(body.on_outline + node_base);
        resist(first_dx, first_dy, first.vx, first.vy, on_outline);
        resist(before_dx, before_dy, last_vx, last_vy, on_outline);
        for (int e = 0; e < body.edge_size[g]; ++e) {
          const int base = lane_index<T>(body.edge_begin[g] + e);
          const NodePack<T> other = state.edge_end(base);
          resist(other.x - self.x, other.y - self.y, other.vx, other.vy,
                 Pack::load(body.edge_present + base));
        }
      }
    }

    if constexpr (terms.ground) {
      fx += Pack(c.gravity_x);
      fy += Pack(c.gravity_y);
    }
    if constexpr (terms.actuation == Actuation::none) {
      fx = fma(Pack(-c.settle_drag), self.vx, fx);
      fy = fma(Pack(-c.settle_drag), self.vy, fy);
    }

    const Pack inverse_mass = Pack::load(body.inverse_mass + node_base);
    const Pack ax = fx * inverse_mass, ay = fy * inverse_mass;
    const Pack old_vx = Pack::load(body.vx + node_base);
    Pack vx = fma(h, ax, old_vx), vy = fma(h, ay, Pack::load(body.vy + node_base));
    Pack next_vx = fma(extrapolate, ax, vx), next_vy = fma(extrapolate, ay, vy);
    if constexpr (terms.ground) {
      const Pack falling = vy;
      vy = max(falling, least_rise(self.y, inverse_step));
      vx = after_friction(vx, friction * (vy - falling));
      next_vx = fma(extrapolate_share, vx - old_vx, vx);
      next_vy = select(vy > falling, vy, next_vy);
    }
    vx.store(body.vx + node_base);
    vy.store(body.vy + node_base);
    state.put(node_base, {fma(h, vx, self.x), fma(h, vy, self.y), next_vx, next_vy});

    const Pack speed2 = fma(vx, vx, vy * vy);
    extremes.largest_speed2 = max(speed2, extremes.largest_speed2);
    extremes.not_finite = fma(speed2, zero, extremes.not_finite);
  }
  seen = extremes;
}

template <class T, Terms terms>
inline void step_body(const BodyView<T>& body, const StepCoefficients<T>& c, Turn<T> n,
                      StepExtremes<T>& seen) {
  step_body<T, terms>(body, c, n, seen, Records<T>{body});
}

}  // namespace metamorph::kernels
