#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "metamorph/body.h"
#include "metamorph/named.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// Of the arithmetic.
enum class Precision { float32, float64 };
inline constexpr std::array<Named<Precision>, 2> precision_names{
    {{Precision::float32, "float32"}, {Precision::float64, "float64"}}};

/// drift_kick_drift: leapfrog, the velocity force at the extrapolated midpoint (default).
/// symplectic_euler: first order, the baseline.
enum class Method { drift_kick_drift, symplectic_euler };
inline constexpr std::array<Named<Method>, 2> method_names{
    {{Method::drift_kick_drift, "drift_kick_drift"},
     {Method::symplectic_euler, "symplectic_euler"}}};

/// How motion is computed; the steps belong to the scene.
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

/// State of one body at one moment, as passed to an observer.
struct Frame {
  std::int64_t step = 0;                 ///< integrator steps since the start of actuation
  double time = 0;                       ///< time units since the start of actuation
  std::span<const double> x, y, vx, vy;  ///< [nodes], order of Body
};

}  // namespace metamorph::core
