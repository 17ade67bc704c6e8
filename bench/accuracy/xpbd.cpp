#include "bench/accuracy/xpbd.h"

#include <cmath>

#include "kernels/reference/actuation.h"
#include "kernels/reference/pressure.h"
#include "kernels/reference/solid.h"

namespace metamorph::bench {
namespace {

namespace ref = kernels::reference;

core::Scene without_body_forces(core::Scene scene) {
  scene.stiffness = scene.damping = scene.pressure = 0;
  return scene;
}

}  // namespace

Xpbd::Xpbd(const core::Body& body, const core::Scene& scene)
    : body_(body),
      scene_(scene),
      outside_(body, without_body_forces(scene)),
      length_(body.rest_length),
      fx_(body.x.size()),
      fy_(body.x.size()) {}

void Xpbd::step(core::ReferenceSystem& system, double t, double h) {
  const double amplitude =
      scene_.amplitude * ref::ramp(t + h, scene_.ramp_steps * core::paper_step);
  ref::actuate(body_.springs, body_.rest_length, {body_.period, body_.phase}, amplitude, t + h,
               length_);
  outside_.forces(system.nodes(), t, {fx_, fy_});
  x_ = system.x;
  y_ = system.y;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    system.x[i] += h * (system.vx[i] + h * fx_[i] / system.mass);
    system.y[i] += h * (system.vy[i] + h * fy_[i] / system.mass);
  }
  project_springs(system, h);
  if (scene_.pressure > 0) project_triangles(system, h);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    system.vx[i] = (system.x[i] - x_[i]) / h;
    system.vy[i] = (system.y[i] - y_[i]) / h;
  }
  ref::keep_apart(system.solid(), h, x_, y_, system.vx, system.vy);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    system.x[i] = x_[i] + h * system.vx[i];
    system.y[i] = y_[i] + h * system.vy[i];
  }
}

void Xpbd::project_springs(core::ReferenceSystem& system, double h) {
  const double compliance = 1 / (scene_.stiffness * h * h);
  const double gamma = scene_.damping / (scene_.stiffness * h);
  for (std::size_t s = 0; s < body_.springs.size(); ++s) {
    const auto [i, j] = ref::places(body_.springs[s]);
    const double dx = system.x[j] - system.x[i], dy = system.y[j] - system.y[i];
    const double distance = std::hypot(dx, dy);
    const double nx = dx / distance, ny = dy / distance;
    const double moved = nx * ((system.x[j] - x_[j]) - (system.x[i] - x_[i])) +
                         ny * ((system.y[j] - y_[j]) - (system.y[i] - y_[i]));
    const double lambda =
        (-(distance - length_[s]) - gamma * moved) / ((1 + gamma) * 2 / system.mass + compliance);
    const double shift = lambda / system.mass;
    system.x[i] -= shift * nx;
    system.y[i] -= shift * ny;
    system.x[j] += shift * nx;
    system.y[j] += shift * ny;
  }
}

void Xpbd::project_triangles(core::ReferenceSystem& system, double h) {
  const double compliance = 1 / (h * h);
  for (std::size_t s = 0; s < body_.triangles.size(); ++s) {
    const double rest = body_.rest_area[s];
    if (rest < scene_.min_pressure_area) continue;
    const auto corners = ref::places(body_.triangles[s]);
    const double area = ref::signed_area(body_.triangles[s], system.x, system.y);
    const double energy = scene_.pressure * (area - rest - rest * std::log(area / rest));
    if (!(energy > 1e-14)) continue;
    // C = sqrt(2 U), negative while compressed; dC/dS = U'(S) / C.
    const double c = std::copysign(std::sqrt(2 * energy), area - rest);
    const double slope = scene_.pressure * (1 - rest / area) / c;
    double gx[3], gy[3], squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = corners[(k + 1) % 3], last = corners[(k + 2) % 3];
      gx[k] = slope * (system.y[next] - system.y[last]) / 2;
      gy[k] = slope * (system.x[last] - system.x[next]) / 2;
      squared += (gx[k] * gx[k] + gy[k] * gy[k]) / system.mass;
    }
    const double lambda = -c / (squared + compliance);
    for (std::size_t k = 0; k < 3; ++k) {
      system.x[corners[k]] += lambda * gx[k] / system.mass;
      system.y[corners[k]] += lambda * gy[k] / system.mass;
    }
  }
}

}  // namespace metamorph::bench
