#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "core/body.h"
#include "core/reference_system_detail.h"
#include "core/scene.h"

namespace metamorph::bench {

/// Linearly implicit Euler, for comparison (Baraff & Witkin 1998): (m + h C + h^2 K) dv =
/// h (f - h K v), one sparse factorisation per step. K and C hold springs, dampers, pressure and
/// the ground, K without its indefinite geometric part (so it can be factorised by Cholesky; a
/// method of first order stays one with any K). Friction is an impulse, as everywhere. For runs,
/// not for settling.
class LinearlyImplicitEuler {
 public:
  LinearlyImplicitEuler(const core::Body& body, const core::Scene& scene);
  void step(core::ReferenceSystem& system, double t, double h);

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  void assemble(const core::ReferenceSystem& system, double h);

  core::Body body_;
  core::Scene scene_;
  bool analysed_ = false;
  std::vector<double> fx_, fy_, normal_;
  std::vector<Eigen::Triplet<double>> left_, stiffness_;
  Matrix left_side_, stiffness_matrix_;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

}  // namespace metamorph::bench
