#pragma once

// Nodes and edges about to meet, for the tests of what keeps them apart.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/body/aligned.h"
#include "kernels/reference/solid.h"
#include "kernels/self_collision.h"
#include "kernels/stop.h"
#include "metamorph/random.h"

namespace metamorph::tests {

/// Loose edges and nodes with velocities, every node and every edge without it a pair. Coordinates
/// and velocities are floats, so that both precisions get the same.
struct Cloud {
  std::vector<double> x, y, vx, vy;
  std::vector<kernels::reference::CollisionPair> pairs;
  double h = 0.125;  ///< the step

  kernels::reference::Solid solid(bool ground, double friction) const {
    return {pairs, 0.05, ground, friction};
  }
  double energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < vx.size(); ++i) sum += (vx[i] * vx[i] + vy[i] * vy[i]) / 2;
    return sum;
  }
  double fastest() const {
    double most = 0;
    for (std::size_t i = 0; i < vx.size(); ++i) most = std::max(most, std::hypot(vx[i], vy[i]));
    return most;
  }
};

/// `edges` edges of length about 1 and `nodes` loose nodes in a box of `size` above y = 0, of
/// speeds up to `speed` per coordinate; nothing is nearer than 0.01. Thresholds: 0.3 or, of every
/// fourth pair, what it is apart by.
inline Cloud random_cloud(evolve::RandomStream& random, int edges, int nodes, double size,
                          double speed) {
  namespace ref = kernels::reference;
  const auto rounded = [](double value) { return static_cast<double>(static_cast<float>(value)); };
  while (true) {
    Cloud cloud;
    const auto add = [&](double x, double y) {
      cloud.x.push_back(rounded(x));
      cloud.y.push_back(rounded(std::max(y, 0.0)));
      cloud.vx.push_back(rounded(speed * (2 * random.uniform() - 1)));
      cloud.vy.push_back(rounded(speed * (2 * random.uniform() - 1)));
    };
    std::vector<ref::Edge> all;
    for (int e = 0; e < edges; ++e) {
      const double x = size * random.uniform(), y = size * random.uniform();
      const double angle = 6.2831853 * random.uniform(), length = 0.5 + random.uniform();
      add(x, y);
      add(x + length * std::cos(angle), y + length * std::sin(angle));
      all.push_back({2 * e, 2 * e + 1});
    }
    for (int n = 0; n < nodes; ++n) add(size * random.uniform(), size * random.uniform());
    bool roomy = true;
    for (const ref::Edge& edge : all)
      for (int node = 0; node < static_cast<int>(cloud.x.size()); ++node) {
        if (node == edge[0] || node == edge[1]) continue;
        const double gap = ref::closest_point(node, edge, cloud.x, cloud.y).gap;
        roomy = roomy && gap > 0.01;
        const double threshold = random.below(4) == 0 ? std::min(0.3, gap) : 0.3;
        cloud.pairs.push_back({node, edge, rounded(threshold)});
      }
    if (roomy) return cloud;
  }
}

/// The cloud with the velocities that the plain stop leaves.
inline Cloud kept_apart(Cloud cloud, bool ground = false, double friction = 0) {
  kernels::reference::keep_apart(cloud.solid(ground, friction), cloud.h, cloud.x, cloud.y, cloud.vx,
                                 cloud.vy);
  return cloud;
}

/// The same by the fast one, after the ground's stop, which is no part of it; and where its records
/// say that the drift ends.
template <class T>
struct FastStop {
  FastStop(const Cloud& before, bool ground = false, double friction = 0) : after(before) {
    const std::size_t n = before.x.size();
    core::Aligned<T> vx(n), vy(n), fx(n), fy(n);
    now.resize(n);
    next.resize(n);
    const T h = static_cast<T>(before.h);
    for (std::size_t i = 0; i < n; ++i) {
      double to_vx = before.vx[i], to_vy = before.vy[i];
      if (ground) kernels::reference::meet_ground(before.y[i], before.h, friction, to_vx, to_vy);
      vx[i] = static_cast<T>(to_vx);
      vy[i] = static_cast<T>(to_vy);
      now[i] = {static_cast<T>(before.x[i]), static_cast<T>(before.y[i]), vx[i], vy[i]};
      next[i] = {now[i].x + h * vx[i], now[i].y + h * vy[i], vx[i], vy[i]};
    }
    const auto width = static_cast<std::size_t>(kernels::Lanes<T>::width);
    const std::size_t filled = (before.pairs.size() + width - 1) / width * width;
    core::Aligned<std::uint32_t> node(filled), first(filled), second(filled);
    core::Aligned<T> threshold(filled);
    for (std::size_t p = 0; p < before.pairs.size(); ++p) {
      const auto offset = [](int i) {
        return kernels::record_offset<T>(static_cast<std::uint32_t>(i));
      };
      node[p] = offset(before.pairs[p].node);
      first[p] = offset(before.pairs[p].edge[0]);
      second[p] = offset(before.pairs[p].edge[1]);
      threshold[p] = static_cast<T>(before.pairs[p].threshold);
    }
    std::vector<kernels::Approach<T>> approaches(filled);
    double fastest = 0;
    for (std::size_t i = 0; i < n; ++i)
      fastest =
          std::max(fastest, std::hypot(static_cast<double>(vx[i]), static_cast<double>(vy[i])));
    const kernels::PairCounts counts = kernels::meet_pairs<T>(
        {static_cast<int>(filled), node.data(), first.data(), second.data(), threshold.data()},
        now.data(), T(0), T(0.05), static_cast<T>(4 * before.h * fastest), fx.data(), fy.data(),
        approaches.data());
    near = counts.near;
    stopped = kernels::stop_approaches<T>(approaches.data(), approaches.data() + counts.near,
                                          {h, T(1) / h, T(0.5), ground, static_cast<T>(friction)},
                                          now.data(), next.data(), vx.data(), vy.data());
    for (std::size_t i = 0; i < n; ++i) {
      after.vx[i] = static_cast<double>(vx[i]);
      after.vy[i] = static_cast<double>(vy[i]);
    }
  }

  Cloud after;
  core::Aligned<kernels::NodeRecord<T>> now, next;
  kernels::Stopped<T> stopped;
  int near = 0;
};

/// The velocity at which a pair separates where it is nearest, the room it has, and the velocity it
/// may at least have for that, by MODEL section 4; before: the cloud as it met the stop.
struct Separation {
  double velocity, room, least;
};

inline Separation separation(const Cloud& before, const Cloud& after,
                             const kernels::reference::CollisionPair& pair) {
  const auto point = kernels::reference::closest_point(pair.node, pair.edge, before.x, before.y);
  const auto p = static_cast<std::size_t>(pair.node), a = static_cast<std::size_t>(pair.edge[0]),
             b = static_cast<std::size_t>(pair.edge[1]);
  const auto of = [&](const Cloud& cloud) {
    const double s = point.place;
    return (point.dx * (cloud.vx[p] - (1 - s) * cloud.vx[a] - s * cloud.vx[b]) +
            point.dy * (cloud.vy[p] - (1 - s) * cloud.vy[a] - s * cloud.vy[b])) /
           point.gap;
  };
  const double room = point.gap - std::min(0.05, pair.threshold / 2);
  const double least =
      room >= 0 ? -room / before.h : std::min(-0.2 * room / before.h, std::max(-of(before), 0.0));
  return {of(after), room, least};
}

/// Whether the node passes through the edge while all drift by the cloud's step: their cross
/// product is a parabola in time, and at its roots the node lies on the edge or beside it.
inline bool passes_through(const Cloud& cloud, const kernels::reference::CollisionPair& pair) {
  const auto p = static_cast<std::size_t>(pair.node), a = static_cast<std::size_t>(pair.edge[0]),
             b = static_cast<std::size_t>(pair.edge[1]);
  const double ex = cloud.x[b] - cloud.x[a], ey = cloud.y[b] - cloud.y[a];
  const double ux = cloud.vx[b] - cloud.vx[a], uy = cloud.vy[b] - cloud.vy[a];
  const double qx = cloud.x[p] - cloud.x[a], qy = cloud.y[p] - cloud.y[a];
  const double wx = cloud.vx[p] - cloud.vx[a], wy = cloud.vy[p] - cloud.vy[a];
  const double c0 = ex * qy - ey * qx;
  const double c1 = ex * wy + ux * qy - ey * wx - uy * qx;
  const double c2 = ux * wy - uy * wx;
  const auto on_edge = [&](double t) {
    if (!(t >= 0 && t <= cloud.h)) return false;
    const double fx = ex + t * ux, fy = ey + t * uy;
    const double share = ((qx + t * wx) * fx + (qy + t * wy) * fy) / (fx * fx + fy * fy);
    return share >= 0 && share <= 1;
  };
  const double discriminant = c1 * c1 - 4 * c0 * c2;
  if (discriminant < 0) return false;
  const double q = -(c1 + std::copysign(std::sqrt(discriminant), c1)) / 2;
  return on_edge(q / c2) || on_edge(c0 / q);
}

}  // namespace metamorph::tests
