#include "metamorph/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace metamorph::core {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double damping_weight(Method method) { return method == Method::drift_kick_drift ? 4 : 2; }

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
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
      if (!(scene.pressure > 0 && body.rest_area[t] >= scene.min_pressure_area)) continue;
      Triangle triangle{body.triangles[t], {}, {}, scene.pressure / body.rest_area[t]};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto a = at(triangle.node[(c + 1) % 3]), b = at(triangle.node[(c + 2) % 3]);
        triangle.gx[c] = 0.5 * (body.y[a] - body.y[b]);
        triangle.gy[c] = 0.5 * (body.x[b] - body.x[a]);
      }
      triangles.push_back(triangle);
    }
  }

  /// The largest step that row sums allow: the sum of a row's absolute values is no smaller than
  /// the largest eigenvalue. The two rows of a node are those of x and y.
  double row_sum_limit(double damping, Method method) const {
    struct Row {
      double springs = 0, pressure = 0;
    };
    std::vector<Row> rows(2 * at(nodes));
    for (const Spring& s : springs) {
      // The rows of node i hold n n^T and -n n^T: |nx| (|nx| + |ny|) twice.
      const double spread = 2 * (std::abs(s.nx) + std::abs(s.ny));
      for (const Index n : {s.i, s.j}) {
        rows[2 * at(n)].springs += spread * std::abs(s.nx);
        rows[2 * at(n) + 1].springs += spread * std::abs(s.ny);
      }
    }
    for (const Triangle& t : triangles) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(t.gx[c]) + std::abs(t.gy[c]);
      for (std::size_t c = 0; c < 3; ++c) {
        rows[2 * at(t.node[c])].pressure += t.stiffness * std::abs(t.gx[c]) * sum;
        rows[2 * at(t.node[c]) + 1].pressure += t.stiffness * std::abs(t.gy[c]) * sum;
      }
    }
    double limit = std::numeric_limits<double>::infinity();
    for (const Row& row : rows) {
      limit = std::min(
          limit, mode_step_limit(k * row.springs + row.pressure, damping * row.springs, method));
    }
    return limit;
  }

  /// The largest stable step for damping c, by power iteration: a vector v with stiffness a = v^T
  /// K_springs v and b = v^T K_pressure v bounds it from above, the better the closer v is to the
  /// fastest mode. Products are weighted as they count at the step found so far, at first `h`.
  /// enough(n, limit, before) tells after each product whether to end.
  template <class Enough>
  double iterated_limit(double damping, Method method, double h, Enough&& enough) const {
    const std::size_t size = 2 * at(nodes);
    std::vector<double> v(size), w(size);
    for (std::size_t n = 0; n < size; ++n)
      v[n] = static_cast<double>((n * 7919 + 13) % 1009) / 504.0 - 1.0;
    double limit = std::numeric_limits<double>::infinity();
    for (int n = 1;; ++n) {
      double norm = 0;
      for (double e : v) norm += e * e;
      norm = std::sqrt(norm);
      if (!(norm > 0)) return limit;
      for (double& e : v) e /= norm;
      std::fill(w.begin(), w.end(), 0.0);
      const double ks = h * k + damping_weight(method) * damping, kp = h;
      double a = 0, b = 0;
      for (const Spring& s : springs) {
        const auto i = 2 * at(s.i), j = 2 * at(s.j);
        const double along = (v[i] - v[j]) * s.nx + (v[i + 1] - v[j + 1]) * s.ny;
        a += along * along;
        w[i] += ks * along * s.nx;
        w[i + 1] += ks * along * s.ny;
        w[j] -= ks * along * s.nx;
        w[j + 1] -= ks * along * s.ny;
      }
      for (const Triangle& t : triangles) {
        double change = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          change += t.gx[c] * v[2 * at(t.node[c])] + t.gy[c] * v[2 * at(t.node[c]) + 1];
        }
        b += t.stiffness * change * change;
        change *= kp * t.stiffness;
        for (std::size_t c = 0; c < 3; ++c) {
          w[2 * at(t.node[c])] += change * t.gx[c];
          w[2 * at(t.node[c]) + 1] += change * t.gy[c];
        }
      }
      const double before = limit;
      limit = std::min(limit, mode_step_limit(k * a + b, damping * a, method));
      if (enough(n, limit, before)) return limit;
      if (limit < std::numeric_limits<double>::infinity()) h = limit;
      v.swap(w);
    }
  }
};

// After 6 products the limit found was at most 1.24 times the true one on 12,000 bodies of evolved
// populations (median 1.08); where it settles, 1.02 times for 99 % of them and 1.07 at most.
constexpr int few_products = 6;
constexpr double few_products_reach = 0.8;

constexpr int fewest_products = 8, most_products = 120;

bool settled(int n, double limit, double before) {
  return n >= most_products || (n >= fewest_products && before - limit <= 2e-4 * limit);
}

}  // namespace

double mode_step_limit(double stiffness, double damping, Method method) {
  const double b = damping_weight(method) * damping;
  return 8 / (b + std::sqrt(b * b + 16 * stiffness));
}

double safe_step_limit(const Body& body, const Scene& scene, double damping, Method method) {
  return Linearised(body, scene).row_sum_limit(damping, method);
}

StepLimit step_limit(const Body& body, const Scene& scene, double damping, Method method) {
  const Linearised linear(body, scene);
  const double safe = linear.row_sum_limit(damping, method);
  return {safe, linear.iterated_limit(damping, method, std::min(safe, 1.0), settled)};
}

StepPhase step_phase(const Scene& scene, Method method, bool settling) {
  if (settling) {
    return {scene.settle_step, scene.settle_damping, Method::symplectic_euler, settling_margin};
  }
  return {scene.step, scene.damping, method, has_impacts(scene) ? land_margin : water_margin};
}

StepFinding assess_steps(const Body& body, const Scene& scene, Method method) {
  const Linearised linear(body, scene);
  StepFinding worst;
  for (const bool settling : {false, true}) {
    if (settling && !settles(scene)) continue;
    const StepPhase phase = step_phase(scene, method, settling);
    const double wanted = phase.step / phase.margin;
    // Most steps stay far below the margin, which shows long before the limit is known.
    const auto decided = [&](int n, double limit, double before) {
      return limit < phase.step || (n >= few_products && wanted <= few_products_reach * limit) ||
             settled(n, limit, before);
    };
    const double limit = linear.iterated_limit(phase.damping, phase.method, phase.step, decided);
    const StepUse use = limit < phase.step ? StepUse::too_large
                        : limit < wanted   ? StepUse::close
                                           : StepUse::safe;
    if (use > worst.use) worst = {use, settling};
  }
  return worst;
}

}  // namespace metamorph::core
