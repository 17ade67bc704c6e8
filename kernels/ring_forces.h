#pragma once

#include "kernels/actuation.h"
#include "kernels/body_shape.h"
#include "kernels/drag.h"
#include "kernels/pressure.h"
#include "kernels/spring.h"
#include "kernels/step_terms.h"

namespace metamorph::kernels {

/// What the rings of all groups have in common in one step, in every lane.
template <class T>
struct RingCoefficients {
  Lanes<T> stiffness, damping, half_pressure;
  Lanes<T> amplitude, swing_sine, swing_cosine;
  DragCoefficients<T> drag;

  explicit RingCoefficients(const StepCoefficients<T>& c)
      : stiffness(c.stiffness),
        damping(c.damping),
        half_pressure(c.pressure / 2),
        amplitude(c.amplitude),
        swing_sine(c.swing_sine),
        swing_cosine(c.swing_cosine),
        drag{Lanes<T>(c.drag_normal), Lanes<T>(c.drag_tangential)} {}
};

/// A neighbour as a node sees it.
template <class T>
struct Spoke {
  Lanes<T> dx, dy;  ///< from the node to it, d
  Lanes<T> vx, vy;  ///< its own velocity
};

/// The forces on the nodes of one group, summed along their rings.
template <class T, Terms terms>
struct RingForces {
  using Pack = Lanes<T>;

  const BodyShape<T>& shape;
  const RingCoefficients<T>& all;
  Turn<T> n;  ///< the step, for the oscillators
  const NodePack<T>& self;
  Pack x, y;  ///< the sums

  /// Everything that acts along the rings and outline edges of group `g`; `nodes` as in step_body.
  template <class Nodes>
  [[gnu::always_inline]] void add_group(int g, const Nodes& nodes, StepExtremes<T>& extremes) {
    const int first_slot = lane_index<T>(shape.ring_begin[g]);
    const Spoke<T> first = spoke(nodes.neighbour(first_slot));
    Spoke<T> last;
    if (terms.actuation == Actuation::mixed_periods && shape.off_period[g] != 0) {
      last = add_ring<true>(g, first, nodes, extremes);
    } else {
      last = add_ring<false>(g, first, nodes, extremes);
    }
    if constexpr (terms.pressure) {
      if (shape.ring_closed[g] != 0) {
        const Pack rest_area2 = Pack::load(shape.closing_area2 + lane_index<T>(g));
        const auto present = rest_area2 > Pack(T(0));
        add_pressure(last, first, present, rest_area2 / area2(last, first, present), extremes);
      }
    }
    if constexpr (terms.drag) {
      if (g < shape.outline_groups) add_outline(g, first, last, nodes);
    }
  }

 private:
  [[gnu::always_inline]] Spoke<T> spoke(const NodePack<T>& other) const {
    return {other.x - self.x, other.y - self.y, other.vx, other.vy};
  }

  [[gnu::always_inline]] static Pack length2(const Spoke<T>& to) {
    return max(fma(to.dx, to.dx, to.dy * to.dy), Pack(T(1e-12)));
  }

  /// Twice the area of the triangle of the node and two neighbours, counter-clockwise; 1 where
  /// there is none.
  [[gnu::always_inline]] static Pack area2(const Spoke<T>& a, const Spoke<T>& b,
                                           LaneMask<T> present) {
    return select(present, fma(a.dx, b.dy, -(a.dy * b.dx)), Pack(T(1)));
  }

  /// Springs and triangles of the ring; returns its last neighbour. With `off_period` rare
  /// oscillators of other periods count: what they add is exactly 0 in all other lanes.
  template <bool off_period, class Nodes>
  [[gnu::always_inline]] Spoke<T> add_ring(int g, const Spoke<T>& first, const Nodes& nodes,
                                           StepExtremes<T>& extremes) {
    const Pack one(T(1));
    const int first_slot = lane_index<T>(shape.ring_begin[g]);
    const int end_slot = first_slot + lane_index<T>(shape.ring_size[g]);
    Pack own_swing(T(0));
    if constexpr (off_period) {
      const int base = lane_index<T>(g);
      own_swing = all.amplitude * Pack::load(shape.node_off_period + base) *
                  oscillation<T>(shape.node_start + base, shape.node_per_step + base, n);
    }
    {
      const Pack squared = length2(first);
      add_spring<off_period>(first, squared, one / squared, first_slot, own_swing);
    }
    Spoke<T> before = first;
    for (int slot = first_slot + Pack::width; slot < end_slot; slot += Pack::width) {
      const Spoke<T> to = spoke(nodes.neighbour(slot));
      const Pack squared = length2(to);
      if constexpr (terms.pressure) {
        // One division serves both 1/l^2 and S0/S.
        const Pack rest_area2 = Pack::load(shape.rest_area2 + slot);
        const auto present = rest_area2 > Pack(T(0));
        const Pack area = area2(before, to, present);
        const Pack inverse = one / (squared * area);
        add_pressure(before, to, present, rest_area2 * (inverse * squared), extremes);
        add_spring<off_period>(to, squared, inverse * area, slot, own_swing);
      } else {
        add_spring<off_period>(to, squared, one / squared, slot, own_swing);
      }
      before = to;
    }
    return before;
  }

  /// The spring to a neighbour, eq 2 and 3. `own_swing`: of the node's own oscillator, where its
  /// period is another.
  template <bool off_period>
  [[gnu::always_inline]] void add_spring(const Spoke<T>& to, Pack squared, Pack inverse_squared,
                                         int slot, Pack own_swing) {
    Pack rest_length = Pack::load(shape.rest_length + slot);
    if constexpr (terms.actuation != Actuation::none) {
      const Pack at_rest = rest_length;
      rest_length = fma(all.swing_sine, Pack::load(shape.swing_sine + slot), rest_length);
      rest_length = fma(all.swing_cosine, Pack::load(shape.swing_cosine + slot), rest_length);
      if constexpr (off_period) {
        const Pack other_swing =
            all.amplitude * Pack::load(shape.ring_off_period + slot) *
            oscillation<T>(shape.ring_start + slot, shape.ring_per_step + slot, n);
        rest_length = fma(at_rest, own_swing + other_swing, rest_length);
      }
    }
    const Pack tension = spring_tension<T>(
        to.dx, to.dy, to.vx - self.vx, to.vy - self.vy, sqrt(squared), inverse_squared, rest_length,
        all.stiffness, all.damping, Pack::load(shape.spring + slot));
    x = fma(tension, to.dx, x);
    y = fma(tension, to.dy, y);
  }

  /// The pressure of the triangle of the node and two neighbours, counter-clockwise, eq 1. `ratio`
  /// is S0/S.
  [[gnu::always_inline]] void add_pressure(const Spoke<T>& a, const Spoke<T>& b,
                                           LaneMask<T> present, Pack ratio,
                                           StepExtremes<T>& extremes) {
    const Pack push = select(present, half_pressure(ratio, all.half_pressure), Pack(T(0)));
    extremes.largest_ratio = max(ratio, extremes.largest_ratio);
    extremes.smallest_ratio = min(ratio, extremes.smallest_ratio);
    x = fma(push, a.dy - b.dy, x);
    y = fma(push, b.dx - a.dx, y);
  }

  /// Drag of the node's outline edges: at the ends of its ring, and those inside one of several
  /// fans.
  template <class Nodes>
  [[gnu::always_inline]] void add_outline(int g, const Spoke<T>& first, const Spoke<T>& last,
                                          const Nodes& nodes) {
    const Pack on_outline = Pack::load(shape.on_outline + lane_index<T>(g));
    add_drag(first, on_outline);
    add_drag(last, on_outline);
    for (int e = 0; e < shape.edge_size[g]; ++e) {
      const int slot = lane_index<T>(shape.edge_begin[g] + e);
      add_drag(spoke(nodes.edge_end(slot)), Pack::load(shape.edge_present + slot));
    }
  }

  /// The node's half of the drag of the edge to a neighbour, eq 4 and 5.
  [[gnu::always_inline]] void add_drag(const Spoke<T>& to, Pack present) {
    const Pack half(T(0.5));
    add_edge_drag<T>(to.dx, to.dy, half * (self.vx + to.vx), half * (self.vy + to.vy), all.drag,
                     present, x, y);
  }
};

}  // namespace metamorph::kernels
