#include "bench/accuracy/linearly_implicit.h"

#include <cmath>
#include <numbers>

#include "kernels/reference/pressure.h"
#include "kernels/reference/solid.h"

namespace metamorph::bench {
namespace {

namespace ref = kernels::reference;

int row(core::Index node, int axis) { return 2 * node + axis; }

/// Two coordinates per node as one vector.
Eigen::VectorXd joined(const std::vector<double>& x, const std::vector<double>& y) {
  Eigen::VectorXd both(2 * static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    both[2 * static_cast<Eigen::Index>(i)] = x[i];
    both[2 * static_cast<Eigen::Index>(i) + 1] = y[i];
  }
  return both;
}

}  // namespace

ImplicitMatrix::ImplicitMatrix(const core::Body& body, const core::Scene& scene)
    : body_(body),
      scene_(scene),
      left_side_(2 * body.node_count(), 2 * body.node_count()),
      stiffness_matrix_(2 * body.node_count(), 2 * body.node_count()) {}

void ImplicitMatrix::factorise(const core::ReferenceSystem& system, double of_damping,
                               double of_stiffness) {
  const double damping = scene_.damping;
  left_.clear();
  stiffness_.clear();
  const auto add = [&](int r, int c, double k, double d) {
    stiffness_.emplace_back(r, c, k);
    left_.emplace_back(r, c, of_damping * d + of_stiffness * k);
  };
  for (const auto& [i, j] : body_.springs) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double dx = system.x[b] - system.x[a], dy = system.y[b] - system.y[a];
    const double n[2] = {dx / std::hypot(dx, dy), dy / std::hypot(dx, dy)};
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        const double k = scene_.stiffness * n[p] * n[q], d = damping * n[p] * n[q];
        add(row(i, p), row(i, q), k, d);
        add(row(j, p), row(j, q), k, d);
        add(row(i, p), row(j, q), -k, -d);
        add(row(j, p), row(i, q), -k, -d);
      }
  }
  for (std::size_t s = 0; s < body_.triangles.size(); ++s) {
    const double rest = body_.rest_area[s];
    if (rest < scene_.min_pressure_area) continue;
    const auto& corners = body_.triangles[s];
    const double area = ref::signed_area(corners, system.x, system.y);
    const double k = scene_.pressure * rest / (area * area);
    double g[6];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto next = static_cast<std::size_t>(corners[(c + 1) % 3]);
      const auto last = static_cast<std::size_t>(corners[(c + 2) % 3]);
      g[2 * c] = (system.y[next] - system.y[last]) / 2;
      g[2 * c + 1] = (system.x[last] - system.x[next]) / 2;
    }
    for (std::size_t p = 0; p < 6; ++p)
      for (std::size_t q = 0; q < 6; ++q)
        add(row(corners[p / 2], static_cast<int>(p % 2)),
            row(corners[q / 2], static_cast<int>(q % 2)), k * g[p] * g[q], 0);
  }
  for (core::Index i = 0; i < body_.node_count(); ++i) {
    left_.emplace_back(row(i, 0), row(i, 0), system.mass);
    left_.emplace_back(row(i, 1), row(i, 1), system.mass);
  }
  stiffness_matrix_.setFromTriplets(stiffness_.begin(), stiffness_.end());
  left_side_.setFromTriplets(left_.begin(), left_.end());
  if (!analysed_) solver_.analyzePattern(left_side_);
  analysed_ = true;
  solver_.factorize(left_side_);
}

Eigen::VectorXd ImplicitMatrix::solve(const Eigen::VectorXd& right_side) const {
  return solver_.solve(right_side);
}

LinearlyImplicitEuler::LinearlyImplicitEuler(const core::Body& body, const core::Scene& scene)
    : matrix_(body, scene), fx_(body.x.size()), fy_(body.x.size()) {}

void LinearlyImplicitEuler::step(core::ReferenceSystem& system, double t, double h) {
  system.forces(system.nodes(), t + h, {fx_, fy_});
  matrix_.factorise(system, h, h * h);
  const Eigen::VectorXd kick = matrix_.solve(
      h * (joined(fx_, fy_) - h * (matrix_.stiffness() * joined(system.vx, system.vy))));
  for (std::size_t i = 0; i < system.x.size(); ++i) {
    const auto place = 2 * static_cast<Eigen::Index>(i);
    system.vx[i] += kick[place];
    system.vy[i] += kick[place + 1];
  }
  ref::keep_apart(system.solid(), h, system.x, system.y, system.vx, system.vy);
  for (std::size_t i = 0; i < system.x.size(); ++i) {
    system.x[i] += h * system.vx[i];
    system.y[i] += h * system.vy[i];
  }
}

Rosenbrock2::Rosenbrock2(const core::Body& body, const core::Scene& scene)
    : matrix_(body, scene),
      x_(body.x.size()),
      y_(body.x.size()),
      vx_(body.x.size()),
      vy_(body.x.size()),
      fx_(body.x.size()),
      fy_(body.x.size()) {}

// With k = (kx, kv) and a right side (rx, rv), the rows of (1 - g h A) k = r are kx = rx + g h kv
// and (m + g h C + g^2 h^2 K) kv = m rv - g h K rx.
void Rosenbrock2::step(core::ReferenceSystem& system, double t, double h) {
  const double gh = (1 - std::numbers::sqrt2 / 2) * h;
  system.forces(system.nodes(), t, {fx_, fy_});
  matrix_.factorise(system, gh, gh * gh);
  const auto& stiffness = matrix_.stiffness();
  const Eigen::VectorXd v = joined(system.vx, system.vy);
  const Eigen::VectorXd kv1 = matrix_.solve(joined(fx_, fy_) - gh * (stiffness * v));
  const Eigen::VectorXd kx1 = v + gh * kv1;

  for (std::size_t i = 0; i < x_.size(); ++i) {
    const auto place = 2 * static_cast<Eigen::Index>(i);
    x_[i] = system.x[i] + h * kx1[place];
    y_[i] = system.y[i] + h * kx1[place + 1];
    vx_[i] = system.vx[i] + h * kv1[place];
    vy_[i] = system.vy[i] + h * kv1[place + 1];
  }
  system.forces({x_, y_, vx_, vy_}, t + h, {fx_, fy_});
  const Eigen::VectorXd rx = v + h * kv1 - 2 * kx1;
  const Eigen::VectorXd kv2 =
      matrix_.solve(joined(fx_, fy_) - 2 * system.mass * kv1 - gh * (stiffness * rx));
  const Eigen::VectorXd kx2 = rx + gh * kv2;

  const Eigen::VectorXd drift = 1.5 * kx1 + 0.5 * kx2;
  const Eigen::VectorXd kick = h * (1.5 * kv1 + 0.5 * kv2);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const auto place = 2 * static_cast<Eigen::Index>(i);
    vx_[i] = drift[place];
    vy_[i] = drift[place + 1];
  }
  ref::keep_apart(system.solid(), h, system.x, system.y, vx_, vy_);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const auto place = 2 * static_cast<Eigen::Index>(i);
    system.x[i] += h * vx_[i];
    system.y[i] += h * vy_[i];
    system.vx[i] += kick[place] + (vx_[i] - drift[place]);
    system.vy[i] += kick[place + 1] + (vy_[i] - drift[place + 1]);
  }
}

}  // namespace metamorph::bench
