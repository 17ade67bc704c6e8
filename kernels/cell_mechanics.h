#pragma once

#include <cstdint>

#include "kernels/node_record.h"

namespace metamorph::kernels {

/// Cells of a group: computed side by side, in one register or in a few independent ones.
inline constexpr int cell_lanes = 16;

/// Linked neighbours of groups of cell_lanes consecutive cells. Group g has the slots
/// [first_slot[g], end_slot[g]); slot s holds one neighbour of each of its cells at
/// neighbour[s * cell_lanes + lane], ascending over the slots of a cell, padded at the end with the
/// cell itself (which exerts no force).
struct CellRings {
  int groups;
  const int* first_slot;           ///< [groups]
  const int* end_slot;             ///< [groups]
  const std::uint32_t* neighbour;  ///< [slots * cell_lanes] record_offset()s
};

/// MODEL section 2: damped springs of rest length 1 d between linked cells, drag; unit masses.
template <class T>
struct CellMechanics {
  T step;
  T stiffness;
  T damping;
  T drag;
};

/// Force of the spring from each cell of a pack to its neighbour, divided by its length: multiply
/// by (dx, dy). Coincident centres exert none.
template <class T>
inline Lanes<T> cell_spring_tension(const CellMechanics<T>& mechanics, Lanes<T> dx, Lanes<T> dy,
                                    Lanes<T> dvx, Lanes<T> dvy) {
  const Lanes<T> zero(T(0)), stiffness(mechanics.stiffness), damping(mechanics.damping);
  const Lanes<T> square = fma(dx, dx, dy * dy);
  const Lanes<T> inverse = select(square > zero, Lanes<T>(T(1)) / sqrt(square), zero);
  const Lanes<T> rate = fma(dvx, dx, dvy * dy) * (inverse * inverse);  // (dv . d) / l^2
  return fma(damping, rate, fma(-stiffness, inverse, stiffness));      // c rate + k (1 - 1/l)
}

/// One symplectic Euler step, v += h (F - drag v), then x += h v, from one array of
/// groups * cell_lanes records into another. Each cell sums its own ring in ascending order of
/// neighbours, so that nothing is scattered and each spring is computed from both its ends, to
/// equal and opposite bits.
template <class T>
inline void step_cells(const CellMechanics<T>& mechanics, const CellRings& rings,
                       const NodeRecord<T>* from, NodeRecord<T>* to) {
  constexpr int width = Lanes<T>::width;
  constexpr int packs = cell_lanes / width;
  static_assert(packs * width == cell_lanes);
  const Lanes<T> step(mechanics.step), drag(mechanics.drag);
  for (int g = 0; g < rings.groups; ++g) {
    NodePack<T> own[packs];
    Lanes<T> force_x[packs], force_y[packs];
    for (int p = 0; p < packs; ++p) {
      own[p] = load<T>(from + g * cell_lanes + p * width);
      force_x[p] = -drag * own[p].vx;
      force_y[p] = -drag * own[p].vy;
    }
    for (int s = rings.first_slot[g]; s < rings.end_slot[g]; ++s) {
      for (int p = 0; p < packs; ++p) {
        const NodePack<T> other = gather<T>(from, rings.neighbour + s * cell_lanes + p * width);
        const Lanes<T> dx = other.x - own[p].x, dy = other.y - own[p].y;
        const Lanes<T> tension =
            cell_spring_tension(mechanics, dx, dy, other.vx - own[p].vx, other.vy - own[p].vy);
        force_x[p] = fma(tension, dx, force_x[p]);
        force_y[p] = fma(tension, dy, force_y[p]);
      }
    }
    for (int p = 0; p < packs; ++p) {
      const Lanes<T> vx = fma(step, force_x[p], own[p].vx);
      const Lanes<T> vy = fma(step, force_y[p], own[p].vy);
      store<T>({fma(step, vx, own[p].x), fma(step, vy, own[p].y), vx, vy},
               to + g * cell_lanes + p * width);
    }
  }
}

}  // namespace metamorph::kernels
