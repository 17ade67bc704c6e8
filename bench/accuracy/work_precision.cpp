#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bench/accuracy/methods.h"
#include "bench/accuracy/parallel.h"
#include "bench/accuracy/studies.h"

namespace metamorph::bench {
namespace {

/// A method, the steps it is tried at, and on which specimens: every so many. The fast kernels are
/// tried on all, the slow methods on a sample.
struct Ladder {
  std::string method;
  std::vector<double> steps;
  std::size_t every = 1;
};

core::Scene at_step(core::Scene scene, double step) {
  scene.step = step;
  return scene;
}

/// The converged solution: by a method at a step, its error bar by the same at twice the step.
struct Truth {
  Measured fine;
  double distance_bar = 0, node_bar = 0;
};

// In water everything is smooth: RK4. On the ground its order is one, as friction is an impulse
// between steps, and drift-kick-drift at a much smaller step is the better reference.
Truth converge(const core::Body& body, const core::Scene& scene) {
  const Method& truth = method(core::has_impacts(scene) ? "DKD float64" : "RK4");
  const double step = core::has_impacts(scene) ? scene.step / 16 : scene.step / 4;
  Truth result{truth.run(body, at_step(scene, step)), 0, 0};
  const Measured coarse = truth.run(body, at_step(scene, 2 * step));
  result.distance_bar =
      std::fabs(travel(scene, result.fine.outcome) - travel(scene, coarse.outcome));
  result.node_bar = rms_distance(result.fine.x, result.fine.y, coarse.x, coarse.y);
  return result;
}

std::vector<Ladder> ladders(const core::Scene& scene) {
  if (!core::has_impacts(scene)) {
    return {{"DKD float32", {0.3, 0.2, 0.1, 0.05, 0.025}},
            {"DKD float64", {0.3, 0.2, 0.1, 0.05, 0.025}},
            {"SE float32", {0.4, 0.2, 0.1, 0.05, 0.025}},
            {"SE float64", {0.4, 0.2, 0.1, 0.05, 0.025}},
            {"velocity Verlet", {0.4, 0.2, 0.1}, 4},
            {"midpoint", {0.4, 0.2}, 4},
            {"RK4", {0.8, 0.6, 0.4, 0.2}},
            {"linearly implicit Euler", {0.8, 0.4, 0.2}, 8},
            {"ROS2", {0.8, 0.4, 0.2}, 8},
            {"XPBD", {0.4, 0.2, 0.1}, 4}};
  }
  return {{"DKD float32", {0.2, 0.15, 0.1, 0.075, 0.0375, 0.01875}},
          {"DKD float64", {0.2, 0.15, 0.1, 0.075, 0.0375, 0.01875}},
          {"SE float32", {0.2, 0.15, 0.075, 0.0375, 0.01875}},
          {"SE float64", {0.2, 0.15, 0.075, 0.0375, 0.01875}},
          {"velocity Verlet", {0.3, 0.15}, 8},
          {"RK4", {0.4, 0.2}, 8},
          {"linearly implicit Euler", {0.4, 0.2}, 8},
          {"ROS2", {0.4, 0.2}, 8},
          {"XPBD", {0.15, 0.075}, 8}};
}

std::string rows_of(std::span<const Specimen> specimens, std::size_t index,
                    const core::Scene& scene) {
  const Specimen& specimen = specimens[index];
  const Truth truth = converge(specimen.body, scene);
  std::string rows;
  const auto add = [&](const std::string& name, double step, const Measured& m, double distance,
                       double nodes) {
    rows += fmt::format("{},{},{},{},{},{},{},{:.9g},{},{:.4g},{:.4g},{:.4g}\n", scene.name,
                        specimen.name, specimen.evolved ? 1 : 0, m.outcome.cells, name, step,
                        core::name(m.outcome.status), travel(scene, m.outcome), m.evaluations,
                        m.seconds, distance, nodes);
  };
  add("reference", 0, truth.fine, truth.distance_bar, truth.node_bar);
  for (const Ladder& ladder : ladders(scene)) {
    if (index % ladder.every != 0) continue;
    for (const double step : ladder.steps) {
      const Measured m = method(ladder.method).run(specimen.body, at_step(scene, step));
      add(ladder.method, step, m,
          std::fabs(travel(scene, m.outcome) - travel(scene, truth.fine.outcome)),
          rms_distance(m.x, m.y, truth.fine.x, truth.fine.y));
    }
  }
  return rows;
}

void work_precision(std::span<const Specimen> specimens, const core::Scene& scene,
                    std::ostream& out) {
  out << "scene,specimen,evolved,cells,method,step,status,distance,evaluations,seconds,"
         "distance_error,node_error\n";
  for (const std::string& rows :
       in_parallel(specimens.size(), [&](std::size_t i) { return rows_of(specimens, i, scene); }))
    out << rows;
}

}  // namespace

void work_precision_water(std::span<const Specimen> specimens, std::ostream& out) {
  work_precision(specimens, core::water_scene(), out);
}

void work_precision_land(std::span<const Specimen> specimens, std::ostream& out) {
  work_precision(specimens, core::land_scene(), out);
}

void work_precision_land_third(std::span<const Specimen> specimens, std::ostream& out) {
  core::Scene scene = core::land_scene();
  scene.name = "first third on land";
  scene.run_steps /= 3;
  work_precision(specimens, scene, out);
}

void work_precision_slope(std::span<const Specimen> specimens, std::ostream& out) {
  work_precision(specimens, core::slope_scene(), out);
}

}  // namespace metamorph::bench
