// The step as the library runs it: simulate() on one thread, packing and checks included.

#include <array>
#include <string>

#include "bench/bodies.h"
#include "bench/measure.h"
#include "metamorph/locomotion.h"

namespace metamorph::bench {
namespace {

using core::Body;
using core::Precision;
using core::Scene;

/// Simulates `batch` copies of the bodies in one scene; time per spring and step.
void simulate(benchmark::State& state, const std::vector<Body>& bodies, const Scene& scene,
              Precision precision, int batch) {
  std::vector<core::LocomotionTask> tasks;
  for (int i = 0; i < batch; ++i) {
    tasks.push_back({&bodies[static_cast<std::size_t>(i) % bodies.size()], &scene});
  }
  core::LocomotionOptions options;
  options.precision = precision;
  options.threads = 1;
  double springs_steps = 0, flop = 0, failed = 0;
  std::vector<core::Outcome> outcomes;
  const HardwareCounters counters;
  for (auto _ : state) outcomes = core::simulate(tasks, options);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const auto steps = static_cast<double>(outcomes[i].steps);
    springs_steps += steps * outcomes[i].springs;
    flop += steps * water_step_flop(*tasks[i].body);
    failed += outcomes[i].failed_step >= 0;
  }
  report(state, counters, springs_steps, "spring-step");
  if (scene.drag && !core::settles(scene)) report_flop(state, flop);
  state.counters["cells"] = outcomes.front().cells;
  state.counters["failed"] = failed;
}

void add(const std::string& name, std::vector<Body> bodies, Scene scene,
         Precision precision = Precision::float32, int batch = 1) {
  benchmark::RegisterBenchmark(name.c_str(), [bodies = std::move(bodies), scene, precision,
                                              batch](benchmark::State& state) {
    simulate(state, bodies, scene, precision, batch);
  })->Unit(benchmark::kMillisecond);
}

void add_all() {
  const Scene water = plain(core::water_scene()), land = plain(core::land_scene());
  const Scene slope = plain(core::slope_scene());
  const Body disc = lattice_disc(128);
  const std::string sizes = "size/", scenes = "scene/", batches = "batch/";

  for (const int cells : {8, 16, 32, 48, 64, 96, 128, 160, 192, 224, 256}) {
    add(sizes + "water/float/" + std::to_string(cells), {lattice_disc(cells)}, water);
    add(sizes + "land/float/" + std::to_string(cells), {lattice_disc(cells)}, land);
    add(sizes + "water/double/" + std::to_string(cells), {lattice_disc(cells)}, water,
        Precision::float64);
  }

  add(scenes + "water/float", {disc}, water);
  add(scenes + "land/float", {disc}, land);
  add(scenes + "slope/float", {disc}, slope);
  Body own_periods = disc;
  own_periods.period.front() *= 2;
  add(scenes + "water-own-periods/float", {own_periods}, water);
  add(scenes + "water/double", {disc}, water, Precision::float64);
  add(scenes + "land/double", {disc}, land, Precision::float64);

  // Settling alone: from rest until quiet, no actuation.
  Scene settling = core::land_scene();
  settling.self_collision = false;
  settling.run_steps = 0;
  add(scenes + "land-settling/float", {disc}, settling);

  // With self-collision where nothing touches (discs), and in bodies as evolution makes them.
  const std::vector<Body> larvae = grown_bodies(600), adults = grown_bodies(1200);
  for (const bool collision : {false, true}) {
    Scene wet = water, dry = land;
    wet.self_collision = dry.self_collision = collision;
    const std::string suffix = collision ? "/collision" : "/no-collision";
    const auto several = [](const auto& list) { return static_cast<int>(list.size()); };
    add("collision/disc/water" + suffix, {disc}, wet);
    add("collision/disc/land" + suffix, {disc}, dry);
    add("collision/larvae/water" + suffix, larvae, wet, Precision::float32, several(larvae));
    add("collision/adults/water" + suffix, adults, wet, Precision::float32, several(adults));
    add("collision/adults/land" + suffix, adults, dry, Precision::float32, several(adults));
  }

  for (const int batch : {1, 10, 100, 1000, 10000}) {
    add(batches + "water/float/" + std::to_string(batch), {lattice_disc(64)}, water,
        Precision::float32, batch);
  }
}

}  // namespace
}  // namespace metamorph::bench

int main(int argc, char** argv) {
  return metamorph::bench::run(argc, argv, metamorph::bench::add_all);
}
