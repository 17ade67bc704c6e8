#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "bench/accuracy/linearly_implicit.h"
#include "bench/accuracy/parallel.h"
#include "bench/accuracy/studies.h"
#include "core/reference/stability.h"
#include "core/reference/system.h"
#include "metamorph/random.h"

namespace metamorph::bench {
namespace {

using core::ReferenceMethod;
using core::ReferenceSystem;

/// One step from time t of size h.
using Stepper = std::function<void(ReferenceSystem&, double t, double h)>;

struct Named {
  std::string name;
  std::function<Stepper(const core::Body&, const core::Scene&)> stepper;
  /// Largest stable step at rest by linear theory; none: there is no limit.
  std::function<double(const core::Body&, const core::Scene&)> rest_limit;
  double drag_factor;  ///< limit of quadratic drag in units of 2 m / (d_N L v); 0: not known
};

Named explicit_method(const std::string& name, ReferenceMethod method, double drag_factor) {
  return {name,
          [=](const core::Body&, const core::Scene&) -> Stepper {
            return [=](ReferenceSystem& system, double t, double h) { system.step(method, t, h); };
          },
          [=](const core::Body& body, const core::Scene& scene) {
            return linear_step_limit(body, scene, scene.damping, method);
          },
          drag_factor};
}

template <class Method>
Named implicit_method(const std::string& name) {
  return {name,
          [](const core::Body& body, const core::Scene& scene) -> Stepper {
            const auto method = std::make_shared<Method>(body, scene);
            return [=](ReferenceSystem& system, double t, double h) { method->step(system, t, h); };
          },
          {},
          0};
}

const std::vector<Named> methods = {
    explicit_method("SE", ReferenceMethod::symplectic_euler, 1),
    explicit_method("DKD", ReferenceMethod::drift_kick_drift, 0.58),
    explicit_method("RK4", ReferenceMethod::runge_kutta_4, 1.2),
    implicit_method<LinearlyImplicitEuler>("linearly implicit Euler"),
    implicit_method<Rosenbrock2>("ROS2")};

/// Steps beyond this are not tried: an actuation period has no four of them left.
constexpr double longest_step = 8;

core::Scene bare_scene() {
  core::Scene scene = core::water_scene();
  scene.amplitude = 0;
  scene.drag = false;
  scene.self_collision = false;
  return scene;
}

/// Does a disturbance of 1e-7 d stay one? A step a hundredth beyond the limit multiplies the worst
/// mode by more than 1.02 per step, and 2000 of those by 1e17; 1e-3 d per time unit is far beyond
/// what a stable motion reaches.
bool stays_small(const core::Body& body, const core::Scene& scene, const Named& named, double h) {
  ReferenceSystem system(body, scene);
  const Stepper step = named.stepper(body, scene);
  evolve::RandomStream random(evolve::Purpose::test, 7, 0, 0);
  for (double& x : system.x) x += 1e-7 * (2 * random.uniform() - 1);
  for (double& y : system.y) y += 1e-7 * (2 * random.uniform() - 1);
  for (int n = 1; n <= 2000; ++n) {
    step(system, 0, h);
    if (n % 50 == 0 && !(system.max_speed() < 1e-3)) return false;
  }
  return true;
}

/// Does a body that is thrown at a speed, or swims for `duration`, stay sound?
bool survives(const core::Body& body, const core::Scene& scene, const Named& named, double h,
              double speed, double duration) {
  ReferenceSystem system(body, scene);
  const Stepper step = named.stepper(body, scene);
  std::fill(system.vy.begin(), system.vy.end(), speed);
  const auto steps = std::llround(duration / h);
  for (std::int64_t n = 0; n < steps; ++n) {
    step(system, static_cast<double>(n) * h, h);
    const auto health = system.examine(h);
    if (health.fault != kernels::reference::Fault::none &&
        !(health.fault == kernels::reference::Fault::speed && health.max_speed < 1.5 * speed))
      return false;
  }
  return true;
}

/// Largest stable step between two; the upper one if that is stable.
template <class Stable>
double bisect(double low, double high, Stable&& stable) {
  if (stable(high)) return high;
  while (high / low > 1.005) {
    const double middle = std::sqrt(low * high);
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

/// One point of a map.
struct Point {
  std::string map;
  double value = 0;
  core::Scene scene;
  double speed = 0;
};

std::vector<Point> linear_points() {
  std::vector<Point> points;
  const auto add = [&](const std::string& map, double value, double c, double c_p, double k) {
    core::Scene scene = bare_scene();
    scene.damping = c;
    scene.pressure = c_p;
    scene.stiffness = k;
    points.push_back({map, value, scene});
  };
  for (const double c : {0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5}) add("damping", c, c, 1, 1);
  for (const double c_p : {0.0, 0.5, 1.0, 2.0, 4.0, 8.0}) add("pressure", c_p, 0.4, c_p, 1);
  for (const double k : {0.25, 0.5, 1.0, 2.0, 4.0, 16.0}) add("stiffness", k, 0.4, 1, k);
  return points;
}

std::vector<Point> nonlinear_points() {
  std::vector<Point> points;
  for (const double drag : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 40.0}) {
    core::Scene scene = bare_scene();
    scene.drag = true;
    scene.drag_normal = drag;
    points.push_back({"drag speed", drag * 1.0, scene, 1.0});
  }
  for (const double amplitude : {0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5}) {
    core::Scene scene = core::water_scene();
    scene.amplitude = amplitude;
    points.push_back({"amplitude", amplitude, scene});
  }
  // With everything that is solid: a walk on land, and how hard the outline repels itself.
  for (const double stiffness : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
    core::Scene scene = core::land_scene();
    scene.collision_stiffness = stiffness;
    points.push_back({"contact stiffness", stiffness, scene});
  }
  return points;
}

std::string row(const Specimen& specimen, const Point& point, const Named& named) {
  const core::Body& body = specimen.body;
  const bool limited = static_cast<bool>(named.rest_limit);
  const double rest = limited ? named.rest_limit(body, point.scene) : longest_step / 2;
  double theory = limited ? rest : std::numeric_limits<double>::infinity(), measured = 0;
  if (point.map == "drag speed") {
    if (named.drag_factor > 0) theory = std::min(rest, named.drag_factor * 2 / point.value);
    measured = bisect((limited ? 0.02 * theory : 0.02), 2 * rest, [&](double h) {
      return survives(body, point.scene, named, h, point.speed, 40);
    });
  } else if (point.map == "amplitude" || point.map == "contact stiffness") {
    measured = bisect(0.1 * rest, 2 * rest,
                      [&](double h) { return survives(body, point.scene, named, h, 0, 160); });
  } else {
    measured = bisect(0.5 * rest, 2 * rest,
                      [&](double h) { return stays_small(body, point.scene, named, h); });
  }
  return fmt::format("{},{},{},{},{},{:.5g},{:.5g}\n", point.map, specimen.name, body.node_count(),
                     named.name, point.value, theory, measured);
}

/// The specimens nearest to these sizes: the spectrum of a large body takes long.
std::vector<const Specimen*> of_sizes(std::span<const Specimen> specimens,
                                      std::initializer_list<int> sizes) {
  std::vector<const Specimen*> chosen;
  for (const int size : sizes) {
    const auto nearest = std::min_element(
        specimens.begin(), specimens.end(), [&](const Specimen& a, const Specimen& b) {
          return std::abs(a.body.node_count() - size) < std::abs(b.body.node_count() - size);
        });
    if (nearest != specimens.end()) chosen.push_back(&*nearest);
  }
  return chosen;
}

}  // namespace

void stability_map(std::span<const Specimen> specimens, std::ostream& out) {
  out << "map,specimen,cells,method,value,theory,measured\n";
  const auto chosen = of_sizes(specimens, {20, 50, 90});
  std::vector<Point> points = linear_points();
  for (Point& point : nonlinear_points()) points.push_back(std::move(point));
  const std::size_t per_body = points.size() * methods.size();
  for (const std::string& text : in_parallel(chosen.size() * per_body, [&](std::size_t i) {
         const std::size_t rest = i % per_body;
         return row(*chosen[i / per_body], points[rest / methods.size()],
                    methods[rest % methods.size()]);
       }))
    out << text;
}

}  // namespace metamorph::bench
