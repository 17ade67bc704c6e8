#pragma once

#include <cmath>

namespace metamorph::kernels::reference {

/// One symplectic Euler step of one embryo (MODEL section 2): damped springs of rest length 1
/// between linked cells, force -drag * v on each, unit masses. link: [links][2]; x, y, vx, vy:
/// [cells] state; force_x, force_y: [cells] scratch.
inline void step_cells(double step, double stiffness, double damping, double drag, int cells,
                       int links, const int (*link)[2], double* x, double* y, double* vx,
                       double* vy, double* force_x, double* force_y) {
  for (int i = 0; i < cells; ++i) {
    force_x[i] = -drag * vx[i];
    force_y[i] = -drag * vy[i];
  }
  for (int l = 0; l < links; ++l) {
    const int i = link[l][0], j = link[l][1];
    const double dx = x[j] - x[i], dy = y[j] - y[i];
    const double length = std::sqrt(dx * dx + dy * dy);
    if (length == 0) continue;
    const double nx = dx / length, ny = dy / length;
    const double rate = (vx[j] - vx[i]) * nx + (vy[j] - vy[i]) * ny;
    const double pull = stiffness * (length - 1) + damping * rate;
    force_x[i] += pull * nx;
    force_y[i] += pull * ny;
    force_x[j] -= pull * nx;
    force_y[j] -= pull * ny;
  }
  for (int i = 0; i < cells; ++i) {
    vx[i] += step * force_x[i];
    vy[i] += step * force_y[i];
    x[i] += step * vx[i];
    y[i] += step * vy[i];
  }
}

}  // namespace metamorph::kernels::reference
