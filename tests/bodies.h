#pragma once

// Hand-made bodies for tests, with rest values, periods and phases set. All are sound.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "metamorph/body.h"
#include "metamorph/random.h"

namespace metamorph::tests {

/// A point of the hexagonal lattice with spacing 1: u * (1, 0) + v * (1/2, sqrt(3)/2).
using LatticePoint = std::pair<int, int>;

/// The six neighbours, counter-clockwise.
inline std::array<LatticePoint, 6> lattice_neighbours(LatticePoint p) {
  const auto [u, v] = p;
  return {{{u + 1, v}, {u, v + 1}, {u - 1, v + 1}, {u - 1, v}, {u, v - 1}, {u + 1, v - 1}}};
}

/// Squared distance from the origin; exact.
inline int lattice_square(LatticePoint p) {
  return p.first * p.first + p.first * p.second + p.second * p.second;
}

/// Lets a travelling wave of phase run over the body, its oscillators all with period 40.
inline void set_wave(core::Body& body, double wave_x = 0.9, double wave_y = 0.4) {
  const std::size_t nodes = body.x.size();
  body.period.assign(nodes, 40.0);
  body.phase.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    body.phase[i] = std::remainder(wave_x * body.x[i] + wave_y * body.y[i], 2 * std::numbers::pi);
  }
}

/// The body of all lattice triangles whose corners are in `points`; nodes in the order of
/// `points` (by u, then v).
inline core::Body lattice_body(const std::set<LatticePoint>& points) {
  core::Body body;
  std::map<LatticePoint, core::Index> node;
  for (const LatticePoint& p : points) {
    node[p] = body.node_count();
    body.x.push_back(p.first + 0.5 * p.second);
    body.y.push_back(0.5 * std::numbers::sqrt3 * p.second);
  }
  for (const auto& [p, a] : node) {
    // Every triangle is counted at its corner with the lowest v, leftmost: up and down.
    const auto [u, v] = p;
    const auto find = [&](int du, int dv) {
      const auto found = node.find({u + du, v + dv});
      return found == node.end() ? -1 : found->second;
    };
    const core::Index right = find(1, 0), up = find(0, 1), down = find(1, -1);
    if (right >= 0 && up >= 0) body.triangles.push_back({a, right, up});
    if (right >= 0 && down >= 0) body.triangles.push_back({a, down, right});
  }
  core::set_rest_from_nodes(body);
  set_wave(body);
  return body;
}

/// One equilateral triangle of side 1.
inline core::Body triangle_body() { return lattice_body({{0, 0}, {1, 0}, {0, 1}}); }

/// Six triangles around a centre: 7 nodes.
inline core::Body hexagon_body() {
  std::set<LatticePoint> points = {{0, 0}};
  for (const LatticePoint& p : lattice_neighbours({0, 0})) points.insert(p);
  return lattice_body(points);
}

/// A strip of `nodes` >= 3 nodes in two rows, nodes - 2 triangles.
inline core::Body strip_body(int nodes) {
  std::set<LatticePoint> points;
  for (int i = 0; i < nodes; ++i) points.insert({i / 2, i % 2});
  return lattice_body(points);
}

/// A lattice disc: the smallest circle around a lattice point with at least `nodes` >= 7 nodes
/// (7, 13, 19, 31, 37, 43, 55, 61, 73, 85, 91, ..., 253, 265).
inline core::Body disc_body(int nodes) {
  std::set<LatticePoint> points;
  for (int square = 0; static_cast<int>(points.size()) < nodes; ++square) {
    for (int u = -square; u <= square; ++u) {
      for (int v = -square; v <= square; ++v) {
        if (lattice_square({u, v}) == square) points.insert({u, v});
      }
    }
  }
  return lattice_body(points);
}

/// A disc of lattice points within `outer` of the centre, without those closer than `inner`: two
/// outline loops. inner <= outer - 2 keeps it at least two triangles wide.
inline core::Body ring_body(int inner, int outer) {
  std::set<LatticePoint> points;
  for (int u = -2 * outer; u <= 2 * outer; ++u) {
    for (int v = -2 * outer; v <= 2 * outer; ++v) {
      const int square = lattice_square({u, v});
      if (square >= inner * inner && square <= outer * outer) points.insert({u, v});
    }
  }
  return lattice_body(points);
}

/// Two holes that touch in one node, whose ring of triangles falls into two fans.
inline core::Body pinched_body() {
  std::set<LatticePoint> points;
  for (int u = -4; u <= 4; ++u)
    for (int v = -4; v <= 4; ++v)
      if (lattice_square({u, v}) <= 12) points.insert({u, v});
  points.erase({-1, 0});
  points.erase({1, 0});
  return lattice_body(points);
}

/// A C of lattice points whose jaws can snap together.
inline core::Body jaws_body() {
  std::set<LatticePoint> points;
  for (int v = 0; v < 8; ++v)
    for (int u = -4; u < 8; ++u)
      if (2 * u + v >= 0 && 2 * u + v <= 15 && (v < 2 || v > 5 || 2 * u + v <= 3))
        points.insert({u, v});
  return lattice_body(points);
}

/// A random compact body of exactly `nodes` >= 3 nodes without holes or pinches, as extraction
/// gives them: grown on the lattice node by node, every coordinate then moved by up to `jitter` d
/// (at most 0.15, which leaves every triangle counter-clockwise), random periods in [30, 120] and
/// phases in (-pi, pi).
inline core::Body blob_body(int nodes, std::uint64_t seed, double jitter = 0.15) {
  evolve::RandomStream random(evolve::Purpose::test, seed, 0, static_cast<std::uint32_t>(nodes));
  std::set<LatticePoint> points = {{0, 0}, {1, 0}, {0, 1}};
  while (static_cast<int>(points.size()) < nodes) {
    // Candidates: free points whose neighbours in the body form one run of two or more, which
    // neither closes a ring nor makes a pinch.
    std::set<LatticePoint> free;
    for (const LatticePoint& p : points) {
      for (const LatticePoint& q : lattice_neighbours(p)) {
        if (points.count(q) == 0) free.insert(q);
      }
    }
    std::vector<LatticePoint> candidates;
    for (const LatticePoint& p : free) {
      const auto around = lattice_neighbours(p);
      int occupied = 0, runs = 0;
      for (std::size_t k = 0; k < 6; ++k) {
        const bool here = points.count(around[k]) > 0;
        occupied += here;
        runs += here && points.count(around[(k + 5) % 6]) == 0;
      }
      if (runs == 1 && occupied >= 2) candidates.push_back(p);
    }
    points.insert(candidates[random.below(static_cast<std::uint32_t>(candidates.size()))]);
  }
  core::Body body = lattice_body(points);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    body.x[i] += jitter * (2 * random.uniform() - 1);
    body.y[i] += jitter * (2 * random.uniform() - 1);
    body.period[i] = 30 + 90 * random.uniform();
    body.phase[i] = std::numbers::pi * random.triangular();
  }
  core::set_rest_from_nodes(body);
  return body;
}

}  // namespace metamorph::tests
