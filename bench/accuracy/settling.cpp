#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "bench/accuracy/evaluation.h"
#include "bench/accuracy/methods.h"
#include "bench/accuracy/parallel.h"
#include "bench/accuracy/studies.h"
#include "metamorph/reference.h"

namespace metamorph::bench {
namespace {

using core::ReferenceMethod;
using core::Scene;
using Run = std::function<Measured(const core::Body&, const Scene&)>;

struct Variant {
  std::string name;
  Run run;
};

/// The default evaluation in a scene that is changed first.
Run changed(std::function<void(Scene&)> change) {
  return [change = std::move(change)](const core::Body& body, const Scene& scene) {
    Scene own = scene;
    change(own);
    return method("DKD float64").run(body, own);
  };
}

Run with(double drag, int quiet, double speed = 0.01, double damping = 0.8) {
  return changed([=](Scene& scene) {
    scene.settle_drag = drag;
    scene.settle_quiet_steps = quiet;
    scene.settle_speed = speed;
    scene.settle_damping = damping;
  });
}

Run with_step(double step) {
  return changed([=](Scene& scene) { scene.settle_step = step; });
}

/// Settles by drift-kick-drift at some step, then runs as always, on the plain simulator.
Run by_drift_kick_drift(double step) {
  return [=](const core::Body& body, const Scene& scene) {
    Scene own = scene;
    own.settle_step = step;
    return evaluate(body, own, ReferenceMethod::drift_kick_drift,
                    [](core::ReferenceSystem& system, double t, double h) {
                      system.step(ReferenceMethod::drift_kick_drift, t, h);
                    });
  };
}

/// Ways to come to rest; the first is the default.
std::vector<Variant> variants() {
  std::vector<Variant> all = {{"default", changed([](Scene&) {})}};
  all.push_back({"nodes moved by 1e-6", [](const core::Body& body, const Scene& scene) {
                   return method("DKD float64").run(moved(body, 1e-6), scene);
                 }});
  all.push_back({"near true rest", changed([](Scene& scene) {
                   scene.settle_quiet_steps = 6000;
                   scene.settle_max_steps = 30000;
                   scene.settle_speed = 0.001;
                 })});
  for (const double drag : {0.01, 0.02, 0.03, 0.1, 0.3})
    for (const int quiet : {800, 400, 100})
      all.push_back({fmt::format("drag {} quiet {}", drag, quiet), with(drag, quiet)});
  for (const double speed : {0.02, 0.005})
    all.push_back({fmt::format("speed {}", speed), with(0.01, 800, speed)});
  all.push_back({"damping 0.4", with(0.01, 800, 0.01, 0.4)});
  for (const int most : {3000, 1500})
    all.push_back({fmt::format("at most {} steps", most),
                   changed([=](Scene& scene) { scene.settle_max_steps = most; })});
  for (const double step : {0.28, 0.1, 0.05})
    all.push_back({fmt::format("SE at {}", step), with_step(step)});
  all.push_back({"DKD at 0.1", by_drift_kick_drift(0.1)});
  return all;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Distance of two rests after the bodies are laid over each other without turning them.
double pose_difference(Measured a, const Measured& b) {
  if (a.x0.size() != b.x0.size() || a.x0.empty()) return std::nan("");
  const double dx = mean(b.x0) - mean(a.x0), dy = mean(b.y0) - mean(a.y0);
  for (double& x : a.x0) x += dx;
  for (double& y : a.y0) y += dy;
  return rms_distance(a.x0, a.y0, b.x0, b.y0);
}

std::string rows_of(const Specimen& specimen, const Scene& scene) {
  std::string text;
  Measured base;
  for (const Variant& variant : variants()) {
    const Measured m = variant.run(specimen.body, scene);
    if (variant.name == "default") base = m;
    text +=
        fmt::format("{},{},{},{},{},{},{:.9g},{:.6g},{:.4g},{:.4g}\n", scene.name, specimen.name,
                    specimen.evolved ? 1 : 0, m.outcome.cells, variant.name,
                    core::name(m.outcome.status), travel(scene, m.outcome), m.outcome.settle_time,
                    rms_distance(m.x0, m.y0, base.x0, base.y0), pose_difference(m, base));
  }
  return text;
}

}  // namespace

void settling(std::span<const Specimen> specimens, std::ostream& out) {
  out << "scene,specimen,evolved,cells,variant,status,distance,settle_time,rest_error,pose_error\n";
  const Scene scene = core::land_scene();
  for (const std::string& text :
       in_parallel(specimens.size(), [&](std::size_t i) { return rows_of(specimens[i], scene); }))
    out << text;
}

}  // namespace metamorph::bench
