#pragma once

#include <cmath>

namespace metamorph::kernels {

/// Position and velocity of a cell in one 16-byte (float) record, fetched whole by its neighbours.
template <class T>
struct alignas(4 * sizeof(T)) CellRecord {
  T x, y, vx, vy;
};

/// Cells that are computed side by side.
inline constexpr int cell_lanes = 16;

/// Linked neighbours of groups of cell_lanes consecutive cells. Group g has the slots
/// [first_slot[g], first_slot[g + 1]); slot s holds one neighbour of each of its cells at
/// neighbour[s * cell_lanes + lane], ascending over the slots of a cell, padded at the end with the
/// cell itself (which exerts no force).
struct CellRings {
  int groups;
  const int* first_slot;  ///< [groups + 1]
  const int* neighbour;   ///< [first_slot[groups] * cell_lanes]
};

/// MODEL section 2: damped springs of rest length 1 d between linked cells, drag; unit masses.
template <class T>
struct CellMechanics {
  T step;
  T stiffness;
  T damping;
  T drag;
};

/// Force of the springs on every cell, summed in ascending order of neighbours: each cell sums its
/// own ring, so that nothing is scattered and each spring is computed from both its ends, to equal
/// and opposite bits. Coincident centres exert no force. force_x, force_y:
/// [groups * cell_lanes], and as many records.
template <class T>
inline void cell_spring_forces(const CellMechanics<T>& mechanics, const CellRings& rings,
                               const CellRecord<T>* cell, T* force_x, T* force_y) {
  for (int g = 0; g < rings.groups; ++g) {
    const CellRecord<T>* const own = cell + g * cell_lanes;
    T x[cell_lanes], y[cell_lanes], vx[cell_lanes], vy[cell_lanes];
    T sum_x[cell_lanes] = {}, sum_y[cell_lanes] = {};
    for (int lane = 0; lane < cell_lanes; ++lane) {
      x[lane] = own[lane].x;
      y[lane] = own[lane].y;
      vx[lane] = own[lane].vx;
      vy[lane] = own[lane].vy;
    }
    for (int s = rings.first_slot[g]; s < rings.first_slot[g + 1]; ++s) {
      const int* const neighbour = rings.neighbour + s * cell_lanes;
      T px[cell_lanes], py[cell_lanes], pvx[cell_lanes], pvy[cell_lanes];
      for (int lane = 0; lane < cell_lanes; ++lane) {
        const CellRecord<T>& other = cell[neighbour[lane]];
        px[lane] = other.x;
        py[lane] = other.y;
        pvx[lane] = other.vx;
        pvy[lane] = other.vy;
      }
#pragma omp simd
      for (int lane = 0; lane < cell_lanes; ++lane) {
        const T dx = px[lane] - x[lane];
        const T dy = py[lane] - y[lane];
        const T approach = (pvx[lane] - vx[lane]) * dx + (pvy[lane] - vy[lane]) * dy;
        const T square = dx * dx + dy * dy;
        const T inverse = square > T(0) ? T(1) / std::sqrt(square) : T(0);
        const T pull = mechanics.stiffness * (T(1) - inverse) +
                       mechanics.damping * approach * (inverse * inverse);
        sum_x[lane] += pull * dx;
        sum_y[lane] += pull * dy;
      }
    }
    for (int lane = 0; lane < cell_lanes; ++lane) {
      force_x[g * cell_lanes + lane] = sum_x[lane];
      force_y[g * cell_lanes + lane] = sum_y[lane];
    }
  }
}

/// One symplectic Euler step from the spring forces: v += h (F - drag v), then x += h v.
template <class T>
inline void move_cells(const CellMechanics<T>& mechanics, int groups, const T* force_x,
                       const T* force_y, CellRecord<T>* cell) {
#pragma omp simd
  for (int i = 0; i < groups * cell_lanes; ++i) {
    const T vx = cell[i].vx + mechanics.step * (force_x[i] - mechanics.drag * cell[i].vx);
    const T vy = cell[i].vy + mechanics.step * (force_y[i] - mechanics.drag * cell[i].vy);
    cell[i].vx = vx;
    cell[i].vy = vy;
    cell[i].x += mechanics.step * vx;
    cell[i].y += mechanics.step * vy;
  }
}

}  // namespace metamorph::kernels
