#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernels/ground.h"
#include "kernels/node_record.h"
#include "kernels/self_collision.h"

namespace metamorph::kernels {

inline constexpr int most_sweeps = 4;  ///< one is nearly always enough

/// The step in which approaches are stopped: between its kick and its drift.
template <class T>
struct StopStep {
  T step;               ///< h
  T inverse_step;       ///< 1/h
  T extrapolate_share;  ///< of the change of velocity, in what records hold
  bool ground;          ///< at y = 0, with `friction`
  T friction;           ///< mu
};

/// What stopping has changed.
template <class T>
struct Stopped {
  bool any = false;
  T fastest2 = 0;  ///< largest squared speed of what it touched
};

/// The least velocity at which a pair may separate, given its room and the velocity at which it
/// does. What has room may use it up within the step. What is too near is led back as fast as it
/// came, at most by a fifth of what is missing: nothing here ever adds energy.
template <class T>
inline T least_separation(T room, T separation, T inverse_step) {
  constexpr T share_led_back = T(0.2);
  if (room >= T(0)) return -room * inverse_step;
  return std::min(-share_led_back * room * inverse_step, std::max(-separation, T(0)));
}

/// Stops approaches: an impulse along the gap where a pair would come nearer than its least gap
/// within the drift (MODEL section 4), where it is nearest now or, along the same direction, where
/// it will be then: it may slide along while the edge turns. The edge's ends take the opposite,
/// barycentrically, so that momentum and angular momentum stay; what lies on the ground is held by
/// it. One pair after the other, in sweeps, until none needs it. `now` are the positions the drift
/// starts from, `next` those it leads to, with the velocities extrapolated; both velocities and
/// `next` are corrected.
template <class T>
inline Stopped<T> stop_approaches(const Approach<T>* begin, const Approach<T>* end,
                                  const StopStep<T>& s, const NodeRecord<T>* now,
                                  NodeRecord<T>* next, T* vx, T* vy) {
  Stopped<T> stopped;
  const auto push = [&](std::uint32_t n, T dvx, T dvy) {
    const T old_vx = vx[n], old_vy = vy[n];
    T new_vx = old_vx + dvx, new_vy = old_vy + dvy;
    const T least = -std::max(now[n].y, T(0)) * s.inverse_step;
    const bool grounded = s.ground && new_vy < least;
    if (grounded) {
      new_vx = after_friction(new_vx, s.friction * (least - new_vy));
      new_vy = least;
    }
    const T change_x = new_vx - old_vx, change_y = new_vy - old_vy;
    vx[n] = new_vx;
    vy[n] = new_vy;
    next[n].x = std::fma(s.step, new_vx, now[n].x);
    next[n].y = std::fma(s.step, new_vy, now[n].y);
    next[n].vx += std::fma(s.extrapolate_share, change_x, change_x);
    next[n].vy = grounded ? new_vy : next[n].vy + std::fma(s.extrapolate_share, change_y, change_y);
    stopped.fastest2 = std::max(stopped.fastest2, new_vx * new_vx + new_vy * new_vy);
  };
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool acted = false;
    for (const Approach<T>* pair = begin; pair != end; ++pair) {
      const std::uint32_t p = pair->node, a = pair->first, b = pair->second;
      const T ex = now[b].x - now[a].x, ey = now[b].y - now[a].y;
      // As the edge's first end sees them: the velocities of its second end and of the node.
      const T ux = vx[b] - vx[a], uy = vy[b] - vy[a];
      const T wx = vx[p] - vx[a], wy = vy[p] - vy[a];
      const T nx = pair->nx, ny = pair->ny, along = nx * wx + ny * wy, turning = nx * ux + ny * uy;
      // Nowhere along the edge too fast: as at nearly all times.
      const T allowed = -std::max(pair->room, T(0)) * s.inverse_step;
      if (along >= allowed && along - turning >= allowed && pair->room >= T(0)) continue;
      // Where the node will be nearest after the drift.
      const T fx = std::fma(s.step, ux, ex), fy = std::fma(s.step, uy, ey);
      const T qx = std::fma(s.step, wx, now[p].x - now[a].x);
      const T qy = std::fma(s.step, wy, now[p].y - now[a].y);
      const T later = std::min(
          std::max((qx * fx + qy * fy) / std::max(fx * fx + fy * fy, T(1e-12)), T(0)), T(1));
      const T second = pair->share, first = T(1) - second;
      const T room_later = pair->room + (second - later) * (nx * ex + ny * ey);
      const T separation = along - second * turning, separation_later = along - later * turning;
      const T mobility = T(1) + first * first + second * second;
      const T mobility_later = T(1) + first * (T(1) - later) + second * later;
      const T missing = least_separation(pair->room, separation, s.inverse_step) - separation;
      const T missing_later =
          least_separation(room_later, separation_later, s.inverse_step) - separation_later;
      // No more than turns the approach round, which leaves the energy as it is.
      const T impulse = std::max(missing / mobility, std::min(missing_later / mobility_later,
                                                              T(-2) * separation / mobility));
      if (!(impulse > T(0))) continue;
      const T jx = impulse * nx, jy = impulse * ny;
      push(p, jx, jy);
      push(a, -first * jx, -first * jy);
      push(b, -second * jx, -second * jy);
      acted = true;
    }
    if (!acted) break;
    stopped.any = true;
  }
  return stopped;
}

}  // namespace metamorph::kernels
