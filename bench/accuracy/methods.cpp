#include "bench/accuracy/methods.h"

#include <time.h>

#include <cmath>
#include <stdexcept>

#include "bench/accuracy/evaluation.h"
#include "bench/accuracy/linearly_implicit.h"
#include "bench/accuracy/xpbd.h"
#include "metamorph/locomotion.h"
#include "metamorph/random.h"
#include "metamorph/reference.h"

namespace metamorph::bench {
namespace {

std::int64_t run_length(const core::Scene& scene) {
  return std::llround(scene.run_steps * core::paper_step / scene.step);
}

/// Of all forces: one in every step of settling, so many in every step of the run.
double evaluations(const core::Outcome& outcome, const core::Scene& scene, int per_step) {
  const double settling = std::round(outcome.settle_time / scene.settle_step);
  return settling + per_step * (static_cast<double>(outcome.steps) - settling);
}

/// Keeps the first and the last frame that a simulator shows.
auto keeper(Measured& result, std::int64_t last) {
  return [&result, last](const core::Frame& frame) {
    if (frame.step == 0) {
      result.x0.assign(frame.x.begin(), frame.x.end());
      result.y0.assign(frame.y.begin(), frame.y.end());
    }
    if (frame.step == last) {
      result.x.assign(frame.x.begin(), frame.x.end());
      result.y.assign(frame.y.begin(), frame.y.end());
    }
  };
}

Method fast(const std::string& name, core::Precision precision, core::Method kind) {
  return {name, [=](const core::Body& body, const core::Scene& scene) {
            Measured result;
            const std::int64_t steps = run_length(scene);
            const double begin = thread_seconds();
            result.outcome = core::simulate_observed(
                {&body, &scene}, {precision, kind, 1},
                static_cast<int>(std::max<std::int64_t>(steps, 1)), keeper(result, steps));
            result.seconds = thread_seconds() - begin;
            result.evaluations = static_cast<double>(result.outcome.steps);
            return result;
          }};
}

Method plain(const std::string& name, core::ReferenceMethod kind, int evaluations_per_step) {
  return {name, [=](const core::Body& body, const core::Scene& scene) {
            Measured result;
            core::ReferenceOptions options;
            options.method = kind;
            const std::int64_t steps = run_length(scene);
            options.observe_every = static_cast<int>(std::max<std::int64_t>(steps, 1));
            options.observe = keeper(result, steps);
            const double begin = thread_seconds();
            result.outcome = core::simulate_reference(body, scene, options);
            result.seconds = thread_seconds() - begin;
            result.evaluations = evaluations(result.outcome, scene, evaluations_per_step);
            return result;
          }};
}

/// A method that exists only here, made anew for every body. Settled as everybody is.
template <class Stepper>
Method comparison(const std::string& name) {
  return {name, [](const core::Body& body, const core::Scene& scene) {
            Stepper stepper(body, scene);
            Measured result = evaluate(body, scene, core::ReferenceMethod::symplectic_euler,
                                       [&](core::ReferenceSystem& system, double t, double h) {
                                         stepper.step(system, t, h);
                                       });
            result.evaluations = evaluations(result.outcome, scene, Stepper::evaluations_per_step);
            return result;
          }};
}

}  // namespace

const std::vector<Method>& all_methods() {
  using core::Precision;
  using core::ReferenceMethod;
  static const std::vector<Method> methods = {
      fast("DKD float32", Precision::float32, core::Method::drift_kick_drift),
      fast("DKD float64", Precision::float64, core::Method::drift_kick_drift),
      fast("SE float32", Precision::float32, core::Method::symplectic_euler),
      fast("SE float64", Precision::float64, core::Method::symplectic_euler),
      plain("SE", ReferenceMethod::symplectic_euler, 1),
      plain("DKD", ReferenceMethod::drift_kick_drift, 1),
      plain("velocity Verlet", ReferenceMethod::velocity_verlet, 2),
      plain("midpoint", ReferenceMethod::midpoint, 2),
      plain("RK4", ReferenceMethod::runge_kutta_4, 4),
      comparison<LinearlyImplicitEuler>("linearly implicit Euler"),
      comparison<Rosenbrock2>("ROS2"),
      comparison<Xpbd>("XPBD"),
  };
  return methods;
}

const Method& method(const std::string& name) {
  for (const Method& candidate : all_methods())
    if (candidate.name == name) return candidate;
  throw std::out_of_range("no method " + name);
}

double travel(const core::Scene& scene, const core::Outcome& outcome) {
  if (core::is_failure(outcome.status)) return 0;
  return scene.slope_degrees != 0 ? outcome.mean_position[0] : outcome.distance;
}

core::Body moved(core::Body body, double size) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 0);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    body.x[i] += size * (2 * random.uniform() - 1);
    body.y[i] += size * (2 * random.uniform() - 1);
  }
  return body;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double rms_distance(const std::vector<double>& x1, const std::vector<double>& y1,
                    const std::vector<double>& x2, const std::vector<double>& y2) {
  if (x1.size() != x2.size() || x1.empty()) return std::nan("");
  double sum = 0;
  for (std::size_t i = 0; i < x1.size(); ++i)
    sum += (x1[i] - x2[i]) * (x1[i] - x2[i]) + (y1[i] - y2[i]) * (y1[i] - y2[i]);
  return std::sqrt(sum / static_cast<double>(x1.size()));
}

}  // namespace metamorph::bench
