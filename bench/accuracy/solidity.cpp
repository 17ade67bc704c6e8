#include <fmt/format.h>

#include <algorithm>

#include "bench/accuracy/parallel.h"
#include "bench/accuracy/studies.h"
#include "core/body/outline_crossing.h"
#include "metamorph/locomotion.h"

namespace metamorph::bench {
namespace {

std::string row_of(const Specimen& specimen, const core::Scene& scene) {
  const auto outline = core::outline_of(specimen.body.triangles);
  int frames = 0, crossed = 0;
  double lowest = 0;
  const core::Outcome outcome = core::simulate_observed(
      {&specimen.body, &scene}, {core::Precision::float32, core::Method::drift_kick_drift, 1}, 1,
      [&](const core::Frame& frame) {
        ++frames;
        crossed += core::first_crossing(frame.x, frame.y, outline) ? 1 : 0;
        if (scene.ground) {
          lowest = std::min(lowest, *std::min_element(frame.y.begin(), frame.y.end()));
        }
      });
  return fmt::format("{},{},{},{},{},{},{},{:.3g}\n", scene.name, specimen.name,
                     specimen.evolved ? 1 : 0, outcome.cells, core::name(outcome.status), frames,
                     crossed, lowest);
}

}  // namespace

void solidity(std::span<const Specimen> specimens, std::ostream& out) {
  out << "scene,specimen,evolved,cells,status,frames,crossed,lowest\n";
  for (const core::Scene& scene : {core::water_scene(), core::land_scene(), core::slope_scene()}) {
    for (const std::string& text :
         in_parallel(specimens.size(), [&](std::size_t i) { return row_of(specimens[i], scene); }))
      out << text;
  }
}

}  // namespace metamorph::bench
