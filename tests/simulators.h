#pragma once

// The simulators that must all pass the tests of whole evaluations.

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "metamorph/body.h"
#include "metamorph/locomotion.h"
#include "metamorph/outcome.h"
#include "metamorph/reference.h"
#include "metamorph/scene.h"
#include "tests/tolerance.h"

namespace metamorph::tests {

using Observer = std::function<void(const core::Frame&)>;

struct Simulator {
  std::string name;
  double round_off = 0;  ///< of the arithmetic
  std::function<core::Outcome(const core::Body&, const core::Scene&, int every, const Observer&)>
      run;
};

inline std::ostream& operator<<(std::ostream& out, const Simulator& simulator) {
  return out << simulator.name;
}

inline Simulator reference_simulator(
    core::ReferenceMethod method = core::ReferenceMethod::drift_kick_drift) {
  return {"reference", round_off_64,
          [method](const core::Body& body, const core::Scene& scene, int every,
                   const Observer& observe) {
            core::ReferenceOptions options;
            options.method = method;
            options.observe_every = every;
            options.observe = observe;
            return core::simulate_reference(body, scene, options);
          }};
}

inline Simulator fast_simulator(const std::string& name, double round_off,
                                core::Precision precision,
                                core::Method method = core::Method::drift_kick_drift) {
  return {name, round_off,
          [precision, method](const core::Body& body, const core::Scene& scene, int every,
                              const Observer& observe) {
            core::LocomotionOptions options;
            options.precision = precision;
            options.method = method;
            options.threads = 1;
            return core::simulate_observed({&body, &scene}, options, every, observe);
          }};
}

inline Simulator float64_simulator() {
  return fast_simulator("float64", round_off_64, core::Precision::float64);
}

inline Simulator float32_simulator() {
  return fast_simulator("float32", round_off_32, core::Precision::float32);
}

inline std::vector<Simulator> simulators() {
  return {reference_simulator(), float64_simulator(), float32_simulator()};
}

/// Every frame of an evaluation, copied.
struct Film {
  struct Picture {
    double time = 0;
    std::vector<double> x, y, vx, vy;
  };
  core::Outcome outcome;
  std::vector<Picture> pictures;
};

inline Film film(const Simulator& simulator, const core::Body& body, const core::Scene& scene,
                 int every) {
  Film result;
  result.outcome = simulator.run(body, scene, every, [&](const core::Frame& frame) {
    result.pictures.push_back({frame.time,
                               {frame.x.begin(), frame.x.end()},
                               {frame.y.begin(), frame.y.end()},
                               {frame.vx.begin(), frame.vx.end()},
                               {frame.vy.begin(), frame.vy.end()}});
  });
  return result;
}

}  // namespace metamorph::tests
