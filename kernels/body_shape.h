#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/lanes.h"
#include "kernels/node_record.h"

/// The layout of one body for the fused step.
///
/// Lane = node. Nodes are sorted (outline first, then by ring size) and cut into groups of one
/// register's width. Every node carries its ring: the neighbours around it, counter-clockwise, one
/// slot each, so that it sums its own springs and triangle corners and nothing is ever scattered.
/// Each spring is thus computed twice and each triangle three times, which is still faster than
/// gathers and scatters over a spring list (measured: see bench/). A slot holds the spring to its
/// neighbour and the triangle between it and the slot before; the triangle between the last slot
/// of a closed ring and the first stands apart (`closing_area2`). A pinch node holds one fan after
/// the other, with no triangle in the slot where the next fan begins.
namespace metamorph::kernels {

template <class T>
using Turn = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

/// What is constant of a body. An oscillator's phase is a fraction of a turn in fixed point: 2^bits
/// is one turn, so phases wrap exactly.
template <class T>
struct BodyShape {
  int nodes = 0;           ///< real nodes; lanes beyond them are idle
  int groups = 0;          ///< ceil(nodes / width)
  int outline_groups = 0;  ///< the first groups, which hold every outline node

  bool mixed_periods = false;  ///< an oscillator has another than the body's main period
  std::uint64_t advance = 0;   ///< of the main period in one step: 2^64 is one turn

  // [groups]
  const int* ring_begin = nullptr;   ///< first slot of the group
  const int* ring_size = nullptr;    ///< its slots
  const int* ring_closed = nullptr;  ///< 1 if a lane of the group has a closed ring
  const int* off_period = nullptr;   ///< 1 if an oscillator of another period is in its rings

  // [groups * width]
  const T* inverse_mass = nullptr;      ///< 1; 0 in an idle lane
  const T* closing_area2 = nullptr;     ///< 2 S0 of the triangle that closes a ring, d^2; 0: none
  const T* node_off_period = nullptr;   ///< 1 if the node's period is another, else 0
  const Turn<T>* node_start = nullptr;  ///< its phase at step 0
  const Turn<T>* node_per_step = nullptr;  ///< and the advance of one step

  // [slots * width]
  const std::uint32_t* neighbour = nullptr;  ///< record offset; its own where there is no such slot
  const T* rest_length = nullptr;            ///< L0, d
  const T* spring = nullptr;                 ///< 1 if the slot holds a spring, else 0
  const T* rest_area2 = nullptr;  ///< 2 S0 of the triangle to the slot before, d^2; 0: no pressure
  // The oscillators of a body's main period: both of a spring are one, a sin + b cos of 2 pi t/T.
  const T* swing_sine = nullptr;    ///< L0 (cos phi_i + cos phi_j) of those that have it, d
  const T* swing_cosine = nullptr;  ///< L0 (sin phi_i + sin phi_j)
  // The neighbour's, where its period is another.
  const T* ring_off_period = nullptr;  ///< 1 if it is, else 0
  const Turn<T>* ring_start = nullptr;
  const Turn<T>* ring_per_step = nullptr;

  // Outline edges of the nodes of the first groups. A ring that is one open fan has them at its
  // ends; those inside a ring of several fans follow, one slot per edge of a node.
  // [outline_groups]
  const int* edge_begin = nullptr;  ///< first edge slot
  const int* edge_size = nullptr;
  // [outline_groups * width]
  const T* on_outline = nullptr;  ///< 1: edges lead to the ring's first and last neighbour; else 0
  // [edge slots * width]
  const std::uint32_t* edge_other = nullptr;  ///< record offset of the other end
  const T* edge_present = nullptr;            ///< 1 or 0
};

/// What changes: of [groups * width]. A record holds the position at which forces are taken and the
/// velocity extrapolated to the same moment; `vx`, `vy` the velocity after the last kick.
template <class T>
struct BodyState {
  NodeRecord<T>* now = nullptr;   ///< read by a step
  NodeRecord<T>* next = nullptr;  ///< written by it
  T* vx = nullptr;
  T* vy = nullptr;
  // Forces from outside the step (self-collision), zero where there are none.
  const T* extra_fx = nullptr;
  const T* extra_fy = nullptr;
};

/// The group's base in arrays of one entry per node lane, and a slot's base in ring arrays.
template <class T>
constexpr int lane_index(int group_or_slot) {
  return group_or_slot * Lanes<T>::width;
}

}  // namespace metamorph::kernels
