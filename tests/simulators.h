#pragma once

// The simulators that must all pass the tests of whole evaluations.

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "core/body.h"
#include "core/locomotion.h"
#include "core/outcome.h"
#include "core/reference_simulation.h"
#include "core/scene.h"
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

inline Simulator reference_simulator() {
  return {"reference", round_off_64,
          [](const core::Body& body, const core::Scene& scene, int every, const Observer& observe) {
            core::ReferenceOptions options;
            options.observe_every = every;
            options.observe = observe;
            return core::simulate_reference(body, scene, options);
          }};
}

inline std::vector<Simulator> simulators() { return {reference_simulator()}; }

}  // namespace metamorph::tests
