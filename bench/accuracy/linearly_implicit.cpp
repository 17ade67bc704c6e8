#include "bench/accuracy/linearly_implicit.h"

#include <cmath>

#include "kernels/reference/ground.h"
#include "kernels/reference/pressure.h"

namespace metamorph::bench {
namespace {

namespace ref = kernels::reference;

int row(core::Index node, int axis) { return 2 * node + axis; }

}  // namespace

LinearlyImplicitEuler::LinearlyImplicitEuler(const core::Body& body, const core::Scene& scene)
    : body_(body),
      scene_(scene),
      fx_(body.x.size()),
      fy_(body.x.size()),
      normal_(body.x.size()),
      left_side_(2 * body.node_count(), 2 * body.node_count()),
      stiffness_matrix_(2 * body.node_count(), 2 * body.node_count()) {}

void LinearlyImplicitEuler::assemble(const core::ReferenceSystem& system, double h) {
  const double damping = scene_.damping;
  left_.clear();
  stiffness_.clear();
  const auto add = [&](int r, int c, double k, double d) {
    stiffness_.emplace_back(r, c, k);
    left_.emplace_back(r, c, h * d + h * h * k);
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
    const auto a = static_cast<std::size_t>(i);
    const bool touches = scene_.ground && normal_[a] > 0;
    add(row(i, 1), row(i, 1), touches ? scene_.ground_stiffness : 0,
        touches ? scene_.ground_damping : 0);
    left_.emplace_back(row(i, 0), row(i, 0), system.mass);
    left_.emplace_back(row(i, 1), row(i, 1), system.mass);
  }
  stiffness_matrix_.setFromTriplets(stiffness_.begin(), stiffness_.end());
  left_side_.setFromTriplets(left_.begin(), left_.end());
}

void LinearlyImplicitEuler::step(core::ReferenceSystem& system, double t, double h) {
  system.forces(system.nodes(), t + h, {fx_, fy_}, normal_);
  assemble(system, h);
  const Eigen::Index size = 2 * body_.node_count();
  Eigen::VectorXd velocity(size), force(size);
  for (Eigen::Index i = 0; i < size / 2; ++i) {
    const auto a = static_cast<std::size_t>(i);
    velocity[2 * i] = system.vx[a];
    velocity[2 * i + 1] = system.vy[a];
    force[2 * i] = fx_[a];
    force[2 * i + 1] = fy_[a];
  }
  if (!analysed_) solver_.analyzePattern(left_side_);
  analysed_ = true;
  solver_.factorize(left_side_);
  const Eigen::VectorXd kick = solver_.solve(h * (force - h * (stiffness_matrix_ * velocity)));
  const double friction = scene_.ground ? scene_.friction : 0;
  for (Eigen::Index i = 0; i < size / 2; ++i) {
    const auto a = static_cast<std::size_t>(i);
    system.vx[a] =
        ref::after_friction(system.vx[a] + kick[2 * i], friction * h * normal_[a] / system.mass);
    system.vy[a] += kick[2 * i + 1];
    system.x[a] += h * system.vx[a];
    system.y[a] += h * system.vy[a];
  }
}

}  // namespace metamorph::bench
