#pragma once

#include <cstdint>
#include <tuple>

#include "core/locomotion/columns.h"
#include "kernels/body_shape.h"

/// What kernels::BodyShape shows of a body, by what there is one of: a group of lanes, a lane, a
/// slot of a ring, ... Each has one list of its fields, which sizes, fills and shows their arrays.
/// As declared an entry is that of nobody: of an idle lane, or a slot beyond its ring.
namespace metamorph::core {

/// [groups]
template <class T>
struct ShapeGroup {
  int ring_begin = 0;
  int ring_size = 0;
  int ring_closed = 0;
  int off_period = 0;

  using Shape = kernels::BodyShape<T>;
  static constexpr std::tuple columns{Column{&ShapeGroup::ring_begin, &Shape::ring_begin},
                                      Column{&ShapeGroup::ring_size, &Shape::ring_size},
                                      Column{&ShapeGroup::ring_closed, &Shape::ring_closed},
                                      Column{&ShapeGroup::off_period, &Shape::off_period}};
};

/// [groups * width]
template <class T>
struct ShapeLane {
  T inverse_mass = 0;
  T closing_area2 = 0;
  T off_period = 0;
  kernels::Turn<T> start = 0;
  kernels::Turn<T> per_step = 0;

  using Shape = kernels::BodyShape<T>;
  static constexpr std::tuple columns{Column{&ShapeLane::inverse_mass, &Shape::inverse_mass},
                                      Column{&ShapeLane::closing_area2, &Shape::closing_area2},
                                      Column{&ShapeLane::off_period, &Shape::node_off_period},
                                      Column{&ShapeLane::start, &Shape::node_start},
                                      Column{&ShapeLane::per_step, &Shape::node_per_step}};
};

/// [slots * width]
template <class T>
struct ShapeSlot {
  std::uint32_t neighbour = 0;
  T rest_length = 1;
  T spring = 0;
  T rest_area2 = 0;
  T swing_sine = 0;
  T swing_cosine = 0;
  T off_period = 0;
  kernels::Turn<T> start = 0;
  kernels::Turn<T> per_step = 0;

  using Shape = kernels::BodyShape<T>;
  static constexpr std::tuple columns{Column{&ShapeSlot::neighbour, &Shape::neighbour},
                                      Column{&ShapeSlot::rest_length, &Shape::rest_length},
                                      Column{&ShapeSlot::spring, &Shape::spring},
                                      Column{&ShapeSlot::rest_area2, &Shape::rest_area2},
                                      Column{&ShapeSlot::swing_sine, &Shape::swing_sine},
                                      Column{&ShapeSlot::swing_cosine, &Shape::swing_cosine},
                                      Column{&ShapeSlot::off_period, &Shape::ring_off_period},
                                      Column{&ShapeSlot::start, &Shape::ring_start},
                                      Column{&ShapeSlot::per_step, &Shape::ring_per_step}};
};

/// [outline_groups]
template <class T>
struct ShapeEdgeGroup {
  int edge_begin = 0;
  int edge_size = 0;

  using Shape = kernels::BodyShape<T>;
  static constexpr std::tuple columns{Column{&ShapeEdgeGroup::edge_begin, &Shape::edge_begin},
                                      Column{&ShapeEdgeGroup::edge_size, &Shape::edge_size}};
};

/// [outline_groups * width]
template <class T>
struct ShapeEdgeLane {
  T on_outline = 0;

  using Shape = kernels::BodyShape<T>;
  static constexpr std::tuple columns{Column{&ShapeEdgeLane::on_outline, &Shape::on_outline}};
};

/// [edge slots * width]
template <class T>
struct ShapeEdgeSlot {
  std::uint32_t edge_other = 0;
  T edge_present = 0;

  using Shape = kernels::BodyShape<T>;
  static constexpr std::tuple columns{Column{&ShapeEdgeSlot::edge_other, &Shape::edge_other},
                                      Column{&ShapeEdgeSlot::edge_present, &Shape::edge_present}};
};

}  // namespace metamorph::core
