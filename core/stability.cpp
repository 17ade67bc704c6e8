#include "core/stability.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace metamorph::core {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// The linearised body at rest: springs act along their direction, triangles along grad S.
struct Linearised {
  struct Spring {
    Index i, j;
    double nx, ny;
  };
  struct Triangle {
    std::array<Index, 3> node;
    std::array<double, 3> gx, gy;  ///< grad S
    double stiffness;              ///< c_p / S0
  };
  Index nodes;
  double k;
  std::vector<Spring> springs;
  std::vector<Triangle> triangles;

  Linearised(const Body& body, const Scene& scene) : nodes(body.node_count()), k(scene.stiffness) {
    for (const auto& [i, j] : body.springs) {
      const double dx = body.x[at(j)] - body.x[at(i)], dy = body.y[at(j)] - body.y[at(i)];
      const double length = std::sqrt(dx * dx + dy * dy);
      springs.push_back({i, j, dx / length, dy / length});
    }
    if (!(scene.pressure > 0)) return;
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
      if (!(body.rest_area[t] >= scene.min_pressure_area)) continue;
      Triangle triangle{body.triangles[t], {}, {}, scene.pressure / body.rest_area[t]};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto a = at(triangle.node[(c + 1) % 3]), b = at(triangle.node[(c + 2) % 3]);
        triangle.gx[c] = 0.5 * (body.y[a] - body.y[b]);
        triangle.gy[c] = 0.5 * (body.x[b] - body.x[a]);
      }
      triangles.push_back(triangle);
    }
  }

  /// Row-sum bound of (ks K_springs + kp K_pressure): no eigenvalue is larger.
  double row_sum(double ks, double kp) const {
    std::vector<double> sx(at(nodes)), sy(at(nodes));
    for (const Spring& s : springs) {
      // The rows of node i hold n n^T and -n n^T: |nx| (|nx| + |ny|) twice.
      const double spread = 2 * ks * (std::abs(s.nx) + std::abs(s.ny));
      for (const Index n : {s.i, s.j}) {
        sx[at(n)] += spread * std::abs(s.nx);
        sy[at(n)] += spread * std::abs(s.ny);
      }
    }
    for (const Triangle& t : triangles) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(t.gx[c]) + std::abs(t.gy[c]);
      for (std::size_t c = 0; c < 3; ++c) {
        sx[at(t.node[c])] += kp * t.stiffness * std::abs(t.gx[c]) * sum;
        sy[at(t.node[c])] += kp * t.stiffness * std::abs(t.gy[c]) * sum;
      }
    }
    double largest = 0;
    for (std::size_t n = 0; n < sx.size(); ++n) largest = std::max({largest, sx[n], sy[n]});
    return largest;
  }

  /// Largest eigenvalue of the same matrix, by power iteration from below.
  double largest_eigenvalue(double ks, double kp) const {
    const std::size_t size = 2 * at(nodes);
    std::vector<double> v(size), w(size);
    for (std::size_t n = 0; n < size; ++n)
      v[n] = static_cast<double>((n * 7919 + 13) % 1009) / 504.0 - 1.0;
    double value = 0;
    for (int iteration = 0; iteration < 60; ++iteration) {
      double norm = 0;
      for (double e : v) norm += e * e;
      norm = std::sqrt(norm);
      if (!(norm > 0)) return 0;
      for (double& e : v) e /= norm;
      std::fill(w.begin(), w.end(), 0.0);
      for (const Spring& s : springs) {
        const auto i = 2 * at(s.i), j = 2 * at(s.j);
        const double along = ks * ((v[i] - v[j]) * s.nx + (v[i + 1] - v[j + 1]) * s.ny);
        w[i] += along * s.nx;
        w[i + 1] += along * s.ny;
        w[j] -= along * s.nx;
        w[j + 1] -= along * s.ny;
      }
      for (const Triangle& t : triangles) {
        double change = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          change += t.gx[c] * v[2 * at(t.node[c])] + t.gy[c] * v[2 * at(t.node[c]) + 1];
        }
        change *= kp * t.stiffness;
        for (std::size_t c = 0; c < 3; ++c) {
          w[2 * at(t.node[c])] += change * t.gx[c];
          w[2 * at(t.node[c]) + 1] += change * t.gy[c];
        }
      }
      double rayleigh = 0;
      for (std::size_t n = 0; n < size; ++n) rayleigh += v[n] * w[n];
      const bool settled = std::abs(rayleigh - value) < 1e-3 * rayleigh;
      value = rayleigh;
      v.swap(w);
      if (settled && iteration > 8) break;
    }
    return value;
  }
};

double damping_weight(Method method) { return method == Method::drift_kick_drift ? 4 : 2; }

/// The largest h with bound(h) <= 4, where bound grows with h.
template <class Bound>
double largest_step(Bound&& bound) {
  double low = 0, high = 1;
  while (high < 1e6 && bound(high) <= 4) high *= 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (bound(middle) <= 4 ? low : high) = middle;
  }
  return low;
}

}  // namespace

StepLimit step_limit(const Body& body, const Scene& scene, double damping, Method method) {
  const Linearised linear(body, scene);
  const double weight = damping_weight(method);
  const auto spring_part = [&](double h) { return h * h * linear.k + weight * h * damping; };
  return {largest_step([&](double h) { return linear.row_sum(spring_part(h), h * h); }),
          largest_step([&](double h) { return linear.largest_eigenvalue(spring_part(h), h * h); })};
}

bool step_is_stable(const Body& body, const Scene& scene, Method method) {
  const Linearised linear(body, scene);
  const auto stable = [&](double h, double damping, Method phase_method) {
    const double springs = h * h * linear.k + damping_weight(phase_method) * h * damping;
    return linear.row_sum(springs, h * h) <= 4 || linear.largest_eigenvalue(springs, h * h) <= 4;
  };
  return stable(scene.step, scene.damping, method) &&
         (!scene.ground ||
          stable(scene.settle_step, scene.settle_damping, Method::symplectic_euler));
}

}  // namespace metamorph::core
