#pragma once

#include <cstdint>
#include <vector>

#include "metamorph/body.h"
#include "metamorph/scene.h"

namespace metamorph::bench {

/// Opponents of the library's step: the same water scene (springs, damping, pressure, drag,
/// actuation, drift-kick-drift), written over lists of springs, triangles and outline edges, forces
/// scattered to the ends. Compiled with contraction on, which the library forgoes.
///
/// As in the library, nodes hold the midpoint x_n + h/2 v_n and the velocity extrapolated there.

/// The tidy scalar loop: arrays of structs, one animat, one spring after the other, libm's sine.
template <class T>
class TidyLoop {
 public:
  TidyLoop(const core::Body& body, const core::Scene& scene);
  void step(double time, double amplitude);
  double mean_x() const;  ///< of the nodes at the step's end, d
  int animats() const { return 1; }

 private:
  struct Node {
    T x, y, vx, vy;      // midpoint, velocity extrapolated to it
    T kick_x, kick_y;    // velocity after the last kick
    T fx, fy;            // force
    T frequency, phase;  // turns per time unit, turns
    T oscillation;
  };
  struct Spring {
    int a, b;
    T rest_length;
  };
  struct Triangle {
    int a, b, c;
    T rest_area;
  };
  struct Edge {
    int a, b;
  };

  std::vector<Node> nodes_;
  std::vector<Spring> springs_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  T step_, stiffness_, damping_, pressure_, drag_normal_, drag_tangential_;
};

/// Plain arrays, `lanes` animats interleaved: lane = animat. All have the same body, each with its
/// nodes numbered in another order, so that lanes gather from unrelated places. With one lane it
/// is the scalar loop on plain arrays.
template <class T, int lanes>
class Interleaved {
 public:
  Interleaved(const core::Body& body, const core::Scene& scene);
  void step(double time, double amplitude);
  double mean_x() const;  ///< of the first animat
  int animats() const { return lanes; }

 private:
  std::size_t node_count_;
  std::vector<T> x_, y_, vx_, vy_, kick_x_, kick_y_, fx_, fy_;  // [nodes][lanes]
  std::vector<T> frequency_, phase_, oscillation_;              // [nodes][lanes]
  std::vector<int> spring_a_, spring_b_;                        // [springs][lanes], places in x_
  std::vector<T> rest_length_;
  std::vector<int> triangle_a_, triangle_b_, triangle_c_;  // [triangles][lanes]
  std::vector<T> rest_area_;
  std::vector<int> edge_a_, edge_b_;  // [outline edges][lanes]
  T step_, stiffness_, damping_, pressure_, drag_normal_, drag_tangential_;
};

/// Lanes of one register of the target.
template <class T>
inline constexpr int animat_lanes =
#if defined(__AVX512F__)
    64 / sizeof(T);
#elif defined(__AVX2__)
    32 / sizeof(T);
#else
    16 / sizeof(T);
#endif

}  // namespace metamorph::bench
