#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "kernels/reference/ground.h"
#include "kernels/reference/self_collision.h"
#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// What keeps solid things apart: impulses on the velocities between the kick of a step and its
/// drift.
struct Solid {
  std::span<const CollisionPair> pairs;
  double least_gap = 0;  ///< delta; of a pair it is half of its threshold where that is less
  bool ground = false;   ///< at y = 0
  double friction = 0;   ///< mu of the ground
};

/// The least velocity at which a pair may separate, given its room (what the gap exceeds its least
/// by) and the velocity at which it does. What has room may use it up within the drift. What is too
/// near is led back as fast as it came, at most by a fifth of what is missing in one drift. So the
/// stop never adds energy.
inline double least_separation(double room, double separation, double h) {
  if (room >= 0) return -room / h;
  return std::min(-0.2 * room / h, std::max(-separation, 0.0));
}

/// Before a drift by h from x, y: stops nodes at the ground, then pairs, one after the other, in at
/// most four sweeps, by impulses along the gap that the edge's ends share barycentrically; what
/// such an impulse pushes into the ground is stopped there. A pair must keep its least gap where it
/// is nearest now and, along the same direction, where it will be after the drift. All nodes have
/// one mass, so it does not count.
inline void keep_apart(const Solid& solid, double h, std::span<const double> x,
                       std::span<const double> y, std::span<double> vx, std::span<double> vy,
                       std::span<double> since_vy = {}) {
  const auto meet = [&](std::size_t i) {
    if (solid.ground && meet_ground(y[i], h, solid.friction, vx[i], vy[i]) && !since_vy.empty()) {
      since_vy[i] = vy[i];
    }
  };
  double fastest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    meet(i);
    fastest = std::max(fastest, std::hypot(vx[i], vy[i]));
  }
  struct Approach {
    const CollisionPair* pair;
    ClosestPoint point;
    double room;
  };
  std::vector<Approach> approaches;
  for (const CollisionPair& pair : solid.pairs) {
    const ClosestPoint point = closest_point(pair.node, pair.edge, x, y);
    const double room = point.gap - std::min(solid.least_gap, pair.threshold / 2);
    // Twice what the fastest could do: impulses may make others faster.
    if (point.gap > 0 && room <= 4 * h * fastest) approaches.push_back({&pair, point, room});
  }
  for (int sweep = 0; sweep < 4; ++sweep) {
    bool acted = false;
    for (const auto& [pair, point, room] : approaches) {
      const auto [a, b, p] = places<3>({pair->edge[0], pair->edge[1], pair->node});
      const double nx = point.dx / point.gap, ny = point.dy / point.gap;
      const double second = point.place, first = 1 - second;
      const auto separation = [&](double place) {
        return nx * (vx[p] - (1 - place) * vx[a] - place * vx[b]) +
               ny * (vy[p] - (1 - place) * vy[a] - place * vy[b]);
      };
      const auto missing = [&](double place, double room_there) {
        const double v = separation(place);
        return (least_separation(room_there, v, h) - v) /
               (1 + first * (1 - place) + second * place);
      };
      // Where the node will be nearest after the drift: it may slide along while the edge turns.
      const double ex = x[b] - x[a], ey = y[b] - y[a];
      const double fx = ex + h * (vx[b] - vx[a]), fy = ey + h * (vy[b] - vy[a]);
      const double qx = x[p] - x[a] + h * (vx[p] - vx[a]), qy = y[p] - y[a] + h * (vy[p] - vy[a]);
      const double squared = fx * fx + fy * fy;
      const double later = squared > 0 ? std::clamp((qx * fx + qy * fy) / squared, 0.0, 1.0) : 0;
      const double room_later = room + (second - later) * (nx * ex + ny * ey);
      // No more than turns the approach round, which leaves the energy as it is.
      const double most = -2 * separation(second) / (1 + first * first + second * second);
      const double impulse =
          std::max(missing(second, room), std::min(missing(later, room_later), most));
      if (!(impulse > 0)) continue;
      const auto push = [&](std::size_t i, double share) {
        vx[i] += share * impulse * nx;
        vy[i] += share * impulse * ny;
        meet(i);
      };
      push(p, 1);
      push(a, -first);
      push(b, -second);
      acted = true;
    }
    if (!acted) return;
  }
}

}  // namespace metamorph::kernels::reference
