#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "bench/accuracy/evaluation.h"
#include "bench/accuracy/methods.h"
#include "bench/accuracy/parallel.h"
#include "bench/accuracy/studies.h"
#include "core/reference_simulation.h"

namespace metamorph::bench {
namespace {

struct Variant {
  std::string name;
  std::string method = "DKD float32";
  std::function<void(core::Scene&)> change = [](core::Scene&) {};
};

Variant changed(const std::string& name, std::function<void(core::Scene&)> change) {
  return {name, "DKD float32", std::move(change)};
}

/// A term less, a luxury more or less; the first is the default.
std::vector<Variant> variants(const core::Scene& scene) {
  using core::Scene;
  std::vector<Variant> all = {{"default"}};
  all.push_back({"float64", "DKD float64"});
  all.push_back({"symplectic Euler", "SE float32"});
  all.push_back(changed("no pressure", [](Scene& s) { s.pressure = 0; }));
  all.push_back(changed("no self-collision", [](Scene& s) { s.self_collision = false; }));
  if (scene.drag) {
    all.push_back(changed("no tangential drag", [](Scene& s) { s.drag_tangential = 0; }));
    all.push_back(changed("no normal drag", [](Scene& s) { s.drag_normal = 0; }));
  } else {
    all.push_back(changed("no friction", [](Scene& s) { s.friction = 0; }));
    all.push_back(changed("no ground damping", [](Scene& s) { s.ground_damping = 0; }));
    all.push_back(changed("no settling", [](Scene& s) { s.settle_max_steps = 0; }));
  }
  for (const double factor : {1.5, 0.5, 0.25, 0.125})
    all.push_back(changed(fmt::format("step x {}", factor), [=](Scene& s) { s.step *= factor; }));
  for (const int steps : {750, 1500, 6000})
    all.push_back(
        changed(fmt::format("run of {} steps", steps), [=](Scene& s) { s.run_steps = steps; }));
  all.push_back(changed("damping + 10 %", [](Scene& s) { s.damping *= 1.1; }));
  return all;
}

struct Settling {
  std::string name;
  std::function<void(core::Scene&)> change;
};

void set(core::Scene& s, double drag, int quiet, double damping = 0.8, double speed = 0.01) {
  s.settle_drag = drag;
  s.settle_quiet_steps = quiet;
  s.settle_damping = damping;
  s.settle_speed = speed;
}

/// Ways to come to rest; the first is the default, the second as near to rest as we care to go.
std::vector<Settling> settlings() {
  std::vector<Settling> all = {{"default", [](core::Scene&) {}}, {"long", [](core::Scene& s) {
                                                                    set(s, 0.01, 6000, 0.8, 0.001);
                                                                    s.settle_max_steps = 30000;
                                                                  }}};
  for (const double drag : {0.01, 0.03, 0.1, 0.2, 0.3})
    for (const int quiet : {800, 400, 200, 100})
      all.push_back({fmt::format("drag {} quiet {}", drag, quiet),
                     [=](core::Scene& s) { set(s, drag, quiet); }});
  for (const double drag : {0.03, 0.1})
    for (const int quiet : {400, 100})
      all.push_back({fmt::format("drag {} quiet {} speed 0.003", drag, quiet),
                     [=](core::Scene& s) { set(s, drag, quiet, 0.8, 0.003); }});
  all.push_back(
      {"drag 0.01 quiet 800 damping 0.4", [](core::Scene& s) { set(s, 0.01, 800, 0.4); }});
  all.push_back({"drag 0.1 quiet 200 damping 0.4", [](core::Scene& s) { set(s, 0.1, 200, 0.4); }});
  all.push_back({"at most 3000 steps", [](core::Scene& s) { s.settle_max_steps = 3000; }});
  all.push_back({"at most 1500 steps", [](core::Scene& s) { s.settle_max_steps = 1500; }});
  return all;
}

}  // namespace

void ablation(std::span<const Specimen> specimens, std::ostream& out) {
  out << "scene,specimen,evolved,cells,variant,status,distance,steps,seconds,min_area_ratio\n";
  for (const core::Scene& scene : {core::water_scene(), core::land_scene(), core::slope_scene()}) {
    const std::vector<Variant> all = variants(scene);
    const auto rows = in_parallel(specimens.size(), [&](std::size_t i) {
      std::string text;
      for (const Variant& variant : all) {
        core::Scene own = scene;
        variant.change(own);
        const Measured m = method(variant.method).run(specimens[i].body, own);
        text += fmt::format("{},{},{},{},{},{},{:.9g},{},{:.4g},{:.4g}\n", scene.name,
                            specimens[i].name, specimens[i].evolved ? 1 : 0, m.outcome.cells,
                            variant.name, core::name(m.outcome.status), m.outcome.distance,
                            m.outcome.steps, m.seconds, m.outcome.min_area_ratio);
      }
      return text;
    });
    for (const std::string& text : rows) out << text;
    out.flush();
  }
}

void settling(std::span<const Specimen> specimens, std::ostream& out) {
  out << "scene,specimen,evolved,cells,variant,status,distance,settle_time,seconds,rest_error,"
         "rest_shift\n";
  const std::vector<Settling> all = settlings();
  for (const core::Scene& scene : {core::land_scene(), core::slope_scene()}) {
    const auto rows = in_parallel(specimens.size(), [&](std::size_t i) {
      std::string text;
      Measured base;
      for (const Settling& variant : all) {
        core::Scene own = scene;
        variant.change(own);
        const Measured m = method("DKD float64").run(specimens[i].body, own);
        if (variant.name == "default") base = m;
        double shift = 0;
        for (std::size_t n = 0; n < m.x0.size() && n < base.x0.size(); ++n)
          shift += (m.x0[n] - base.x0[n]) / static_cast<double>(m.x0.size());
        text += fmt::format("{},{},{},{},{},{},{:.9g},{:.6g},{:.4g},{:.4g},{:.4g}\n", scene.name,
                            specimens[i].name, specimens[i].evolved ? 1 : 0, m.outcome.cells,
                            variant.name, core::name(m.outcome.status), m.outcome.distance,
                            m.outcome.settle_time, m.seconds,
                            rms_distance(m.x0, m.y0, base.x0, base.y0), shift);
      }
      return text;
    });
    for (const std::string& text : rows) out << text;
    out.flush();
  }
}

}  // namespace metamorph::bench
