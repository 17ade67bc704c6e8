#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/body.h"
#include "core/outcome.h"
#include "core/scene.h"

namespace metamorph::core {

enum class Precision { float32, float64 };

/// drift_kick_drift: leapfrog, the velocity force at the extrapolated midpoint (default).
/// symplectic_euler: first order, the baseline.
enum class Method { drift_kick_drift, symplectic_euler };

struct LocomotionOptions {
  Precision precision = Precision::float32;
  Method method = Method::drift_kick_drift;
  int threads = 0;  ///< 0: as many as OpenMP offers
};

/// One body in one scene. Both are borrowed and must outlive the call.
struct LocomotionTask {
  const Body* body = nullptr;
  const Scene* scene = nullptr;
};

/// Chooses steps where the scene leaves them to it, settles (where there is gravity) and runs every
/// task; results by task index. The result of a task depends on its body and scene alone: the same
/// bits for any batch, order and thread count.
std::vector<Outcome> simulate(std::span<const LocomotionTask> tasks,
                              const LocomotionOptions& options);

/// State of one body at one moment, as passed to an observer.
struct Frame {
  std::int64_t step = 0;                 ///< integrator steps since the start of actuation
  double time = 0;                       ///< time units since the start of actuation
  std::span<const double> x, y, vx, vy;  ///< [nodes], order of Body
};

/// Like simulate() for one task, calling `observe` at the start of actuation and then after every
/// `every` integrator steps. Observing changes no bit of the result.
Outcome simulate_observed(const LocomotionTask& task, const LocomotionOptions& options, int every,
                          const std::function<void(const Frame&)>& observe);

}  // namespace metamorph::core
