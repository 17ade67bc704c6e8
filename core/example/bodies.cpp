// Bodies of one's own, simulated in water and on land as one batch.

#include <metamorph/body.h>
#include <metamorph/locomotion.h>
#include <metamorph/scene.h>
#include <metamorph/status.h>

#include <cstdio>
#include <vector>

using namespace metamorph::core;

/// A strip of two rows of nodes 1 d apart, joined by triangles. A wave runs along it; the rows
/// swing against each other, so that the strip bends.
static Body strip(int length) {
  constexpr double pi = 3.14159265358979323846, height = 0.866, wave = -0.6;  // radians per node
  Body body;
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < length; ++i) {
      body.x.push_back(i + (row == 1 ? 0.5 : 0.0));
      body.y.push_back(row == 1 ? height : 0.0);
      body.period.push_back(45);
      body.phase.push_back((row == 1 ? pi : 0.0) + wave * i);
    }
  }
  for (int i = 0; i + 1 < length; ++i) {
    body.triangles.push_back({i, i + 1, length + i});
    body.triangles.push_back({i + 1, length + i + 1, length + i});
  }
  set_rest_from_nodes(body);
  return body;
}

int main() {
  std::vector<Body> bodies;
  for (const int length : {6, 10, 16}) bodies.push_back(strip(length));
  for (const Body& body : bodies) {
    for (const BodyFault& fault : check(body)) std::printf("unsound: %s\n", fault.what.c_str());
  }

  const Scene scenes[] = {water_scene(), land_scene()};
  std::vector<LocomotionTask> tasks;
  for (const Scene& scene : scenes) {
    for (const Body& body : bodies) tasks.push_back({&body, &scene});
  }
  const std::vector<Outcome> outcomes = simulate(tasks, {});
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    std::printf("%2d nodes, %-5s: %.9g d, %s\n", outcomes[i].cells, tasks[i].scene->name.c_str(),
                outcomes[i].distance, name(outcomes[i].status).data());
  }
}
