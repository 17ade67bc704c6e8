#pragma once

#include "kernels/body_shape.h"
#include "kernels/ground.h"
#include "kernels/ring_forces.h"
#include "kernels/step_terms.h"

namespace metamorph::kernels {

/// The state of a body's nodes as records, read from `now` and written to `next`.
template <class T>
struct Records {
  const BodyShape<T>& shape;
  BodyState<T>& state;

  NodePack<T> own(int lane) const { return load(state.now + lane); }
  NodePack<T> neighbour(int slot) const { return gather(state.now, shape.neighbour + slot); }
  NodePack<T> edge_end(int slot) const { return gather(state.now, shape.edge_other + slot); }
  void put(int lane, const NodePack<T>& pack) const { store(pack, state.next + lane); }
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
/// `nodes` is where they are read and written, see Records.
template <class T, Terms terms, class Nodes>
inline void step_body(const BodyShape<T>& shape, BodyState<T>& state,
                      const StepCoefficients<T>& c, Turn<T> n, StepExtremes<T>& seen,
                      Nodes&& nodes) {
  using Pack = Lanes<T>;
  const Pack zero(T(0)), h(c.step), extrapolate(c.extrapolate);
  const Pack extrapolate_share(c.extrapolate / c.step);
  const Pack inverse_step(T(1) / c.step), friction(c.friction);
  const RingCoefficients<T> all(c);

  StepExtremes<T> extremes = seen;  // a copy stays in registers
  for (int g = 0; g < shape.groups; ++g) {
    const int node_base = lane_index<T>(g);
    const NodePack<T> self = nodes.own(node_base);
    RingForces<T, terms> forces{shape, all, n, self, zero, zero};
    if constexpr (terms.extra) {
      forces.x = Pack::load(state.extra_fx + node_base);
      forces.y = Pack::load(state.extra_fy + node_base);
    }
    forces.add_group(g, nodes, extremes);
    if constexpr (terms.ground) {
      forces.x += Pack(c.gravity_x);
      forces.y += Pack(c.gravity_y);
    }
    if constexpr (terms.actuation == Actuation::none) {
      forces.x = fma(Pack(-c.settle_drag), self.vx, forces.x);
      forces.y = fma(Pack(-c.settle_drag), self.vy, forces.y);
    }

    const Pack inverse_mass = Pack::load(shape.inverse_mass + node_base);
    const Pack ax = forces.x * inverse_mass, ay = forces.y * inverse_mass;
    const Pack old_vx = Pack::load(state.vx + node_base);
    Pack vx = fma(h, ax, old_vx), vy = fma(h, ay, Pack::load(state.vy + node_base));
    Pack next_vx = fma(extrapolate, ax, vx), next_vy = fma(extrapolate, ay, vy);
    if constexpr (terms.ground) {
      const Pack falling = vy;
      vy = max(falling, least_rise(self.y, inverse_step));
      vx = after_friction(vx, friction * (vy - falling));
      next_vx = fma(extrapolate_share, vx - old_vx, vx);
      next_vy = select(vy > falling, vy, next_vy);
    }
    vx.store(state.vx + node_base);
    vy.store(state.vy + node_base);
    nodes.put(node_base, {fma(h, vx, self.x), fma(h, vy, self.y), next_vx, next_vy});

    const Pack speed2 = fma(vx, vx, vy * vy);
    extremes.largest_speed2 = max(speed2, extremes.largest_speed2);
    extremes.not_finite = fma(speed2, zero, extremes.not_finite);
  }
  seen = extremes;
}

template <class T, Terms terms>
inline void step_body(const BodyShape<T>& shape, BodyState<T>& state,
                      const StepCoefficients<T>& c, Turn<T> n, StepExtremes<T>& seen) {
  step_body<T, terms>(shape, state, c, n, seen, Records<T>{shape, state});
}

}  // namespace metamorph::kernels
