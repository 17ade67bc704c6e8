#include <fmt/format.h>

#include <cmath>

#include "bench/accuracy/methods.h"
#include "bench/accuracy/parallel.h"
#include "bench/accuracy/studies.h"
#include "metamorph/locomotion.h"

namespace metamorph::bench {
namespace {

constexpr double perturbation = 1e-6;  // d, of every coordinate
constexpr int frames = 60;

struct Film {
  core::Outcome outcome;
  std::vector<double> time;
  std::vector<std::vector<double>> x, y;
};

Film film(const core::Body& body, const core::Scene& scene) {
  Film result;
  const auto every =
      static_cast<int>(std::lround(scene.run_steps * core::paper_step / scene.step / frames));
  result.outcome = core::simulate_observed(
      {&body, &scene}, {core::Precision::float64, core::Method::drift_kick_drift, 1}, every,
      [&](const core::Frame& frame) {
        result.time.push_back(frame.time);
        result.x.emplace_back(frame.x.begin(), frame.x.end());
        result.y.emplace_back(frame.y.begin(), frame.y.end());
      });
  return result;
}

}  // namespace

void predictability(std::span<const Specimen> specimens, std::ostream& out) {
  out << "scene,specimen,evolved,cells,time,difference,distance\n";
  for (core::Scene scene : {core::water_scene(), core::land_scene(), core::slope_scene()}) {
    scene.run_steps *= 2;
    const auto rows = in_parallel(specimens.size(), [&](std::size_t i) {
      const Film one = film(specimens[i].body, scene);
      const Film two = film(moved(specimens[i].body, perturbation), scene);
      std::string text;
      for (std::size_t n = 0; n < std::min(one.time.size(), two.time.size()); ++n)
        text +=
            fmt::format("{},{},{},{},{:.6g},{:.4g},{:.6g}\n", scene.name, specimens[i].name,
                        specimens[i].evolved ? 1 : 0, one.outcome.cells, one.time[n],
                        rms_distance(one.x[n], one.y[n], two.x[n], two.y[n]), one.outcome.distance);
      return text;
    });
    for (const std::string& text : rows) out << text;
    out.flush();
  }
}

}  // namespace metamorph::bench
