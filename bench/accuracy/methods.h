#pragma once

#include <functional>
#include <string>
#include <vector>

#include "metamorph/body.h"
#include "metamorph/outcome.h"
#include "metamorph/scene.h"

namespace metamorph::bench {

/// One whole evaluation by one method: settling, run, distance.
struct Measured {
  core::Outcome outcome;
  std::vector<double> x0, y0;  ///< [nodes] positions at the start of actuation, d
  std::vector<double> x, y;    ///< [nodes] at the end, d; empty after a failure
  double evaluations = 0;      ///< of all forces
  double seconds = 0;          ///< of processor time of one thread
};

/// Every method behind one signature: body and scene in, with the scene's step.
struct Method {
  std::string name;
  std::function<Measured(const core::Body&, const core::Scene&)> run;
};

/// float32 and float64 kernels (drift-kick-drift, symplectic Euler), the plain methods of the
/// reference, and what is here for comparison only: linearly implicit Euler, ROS2 and XPBD.
const std::vector<Method>& all_methods();

/// One of them by name; std::out_of_range if there is none.
const Method& method(const std::string& name);

/// What bodies are compared by, d: the distance, but on the slope the displacement with its sign
/// (the distance of all that slide down is 0). 0 after a failure.
double travel(const core::Scene& scene, const core::Outcome& outcome);

/// The body with every coordinate of its nodes moved by up to `size`, d; rest lengths and areas are
/// kept.
core::Body moved(core::Body body, double size);

/// Processor time of the calling thread, seconds.
double thread_seconds();

/// Root of the mean squared distance between two sets of points.
double rms_distance(const std::vector<double>& x1, const std::vector<double>& y1,
                    const std::vector<double>& x2, const std::vector<double>& y2);

}  // namespace metamorph::bench
