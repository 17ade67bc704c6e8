#pragma once

#include <vector>

#include "core/reference/system.h"
#include "metamorph/body.h"
#include "metamorph/scene.h"

namespace metamorph::bench {

/// XPBD with small steps (Macklin et al. 2016, 2019), for comparison: one sweep over the springs
/// (compliance 1/k, Rayleigh damping c) and the triangles per step. Pressure is the constraint
/// sqrt(2 U) of its exact energy. Everything else acts as a force before the sweep; what is solid
/// acts by impulses on the velocity after it. For runs, not for settling.
class Xpbd {
 public:
  static constexpr int evaluations_per_step = 1;

  Xpbd(const core::Body& body, const core::Scene& scene);
  void step(core::ReferenceSystem& system, double t, double h);

 private:
  void project_springs(core::ReferenceSystem& system, double h);
  void project_triangles(core::ReferenceSystem& system, double h);

  core::Body body_;
  core::Scene scene_;
  core::ReferenceSystem outside_;  ///< the same scene without springs, dampers and pressure
  std::vector<double> length_, fx_, fy_, x_, y_;
};

}  // namespace metamorph::bench
