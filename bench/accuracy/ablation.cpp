#include <fmt/format.h>

#include <functional>

#include "bench/accuracy/methods.h"
#include "bench/accuracy/parallel.h"
#include "bench/accuracy/studies.h"

namespace metamorph::bench {
namespace {

using core::Scene;

struct Variant {
  std::string name;
  std::string method = "DKD float32";
  double moved = 0;  ///< d, of every node before the evaluation
  std::function<void(Scene&)> change = [](Scene&) {};
};

/// A term less, a luxury more or less; the first is the default.
std::vector<Variant> variants(const Scene& scene) {
  std::vector<Variant> all = {{"default"}};
  const auto add = [&](const std::string& name, std::function<void(Scene&)> change) {
    all.push_back({name, "DKD float32", 0, std::move(change)});
  };
  // What any change must be judged against: nothing but the nodes a little elsewhere.
  for (const double size : {1e-6, 1e-3})
    all.push_back({fmt::format("nodes moved by {:g}", size), "DKD float32", size, [](Scene&) {}});
  all.push_back({"float64", "DKD float64", 0, [](Scene&) {}});
  all.push_back({"symplectic Euler", "SE float32", 0, [](Scene&) {}});
  for (const double factor : {1.5, 0.5, 0.25, 0.125})
    add(fmt::format("step x {}", factor), [=](Scene& s) { s.step *= factor; });
  add("no pressure", [](Scene& s) { s.pressure = 0; });
  add("no self-collision", [](Scene& s) { s.self_collision = false; });
  if (scene.drag) {
    add("no tangential drag", [](Scene& s) { s.drag_tangential = 0; });
    add("no normal drag", [](Scene& s) { s.drag_normal = 0; });
  } else {
    add("no friction", [](Scene& s) { s.friction = 0; });
    add("no settling", [](Scene& s) { s.settle_max_steps = 0; });
  }
  for (const int steps : {750, 1500, 6000})
    add(fmt::format("run of {} steps", steps), [=](Scene& s) { s.run_steps = steps; });
  add("damping + 10 %", [](Scene& s) { s.damping *= 1.1; });
  return all;
}

std::string rows_of(const Specimen& specimen, const Scene& scene) {
  std::string text;
  for (const Variant& variant : variants(scene)) {
    Scene own = scene;
    variant.change(own);
    const Measured m = method(variant.method).run(moved(specimen.body, variant.moved), own);
    text += fmt::format("{},{},{},{},{},{},{:.9g},{},{:.4g},{:.4g}\n", scene.name, specimen.name,
                        specimen.evolved ? 1 : 0, m.outcome.cells, variant.name,
                        core::name(m.outcome.status), travel(scene, m.outcome), m.outcome.steps,
                        m.seconds, m.outcome.min_area_ratio);
  }
  return text;
}

}  // namespace

void ablation(std::span<const Specimen> specimens, std::ostream& out) {
  out << "scene,specimen,evolved,cells,variant,status,distance,steps,seconds,min_area_ratio\n";
  for (const Scene& scene : {core::water_scene(), core::land_scene(), core::slope_scene()}) {
    for (const std::string& text :
         in_parallel(specimens.size(), [&](std::size_t i) { return rows_of(specimens[i], scene); }))
      out << text;
    out.flush();
  }
}

}  // namespace metamorph::bench
