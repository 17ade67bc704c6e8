#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "core/reference/system.h"
#include "metamorph/body.h"
#include "metamorph/scene.h"

namespace metamorph::bench {

/// What linearly implicit methods solve with: m + a C + b K, one sparse factorisation per step. K
/// and C hold springs, dampers and pressure, K without its indefinite geometric part, which is 0 at
/// rest (so it can be factorised by Cholesky).
class ImplicitMatrix {
 public:
  ImplicitMatrix(const core::Body& body, const core::Scene& scene);

  /// At the places of the system.
  void factorise(const core::ReferenceSystem& system, double of_damping, double of_stiffness);
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;
  const Eigen::SparseMatrix<double>& stiffness() const { return stiffness_matrix_; }
  const Eigen::SparseMatrix<double>& left_side() const { return left_side_; }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  core::Body body_;
  core::Scene scene_;
  bool analysed_ = false;
  std::vector<Eigen::Triplet<double>> left_, stiffness_;
  Matrix left_side_, stiffness_matrix_;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

/// Linearly implicit Euler, for comparison (Baraff & Witkin 1998): (m + h C + h^2 K) dv =
/// h (f - h K v). A method of first order stays one with any K. What is solid acts by
/// impulses before the drift, as everywhere. For runs, not for settling.
class LinearlyImplicitEuler {
 public:
  static constexpr int evaluations_per_step = 1;

  LinearlyImplicitEuler(const core::Body& body, const core::Scene& scene);
  void step(core::ReferenceSystem& system, double t, double h);

 private:
  ImplicitMatrix matrix_;
  std::vector<double> fx_, fy_;
};

/// ROS2, for comparison (Verwer, Spee, Blom & Hundsdorfer 1999): of second order with any matrix
/// A in the place of the Jacobian, as is needed here. With y = (x, v), y' = F(t, y), g = 1 -
/// 1/sqrt(2):
///   (1 - g h A) k1 = F(t, y),  (1 - g h A) k2 = F(t + h, y + h k1) - 2 k1,
///   y += 3/2 h k1 + 1/2 h k2.
/// Two evaluations, one factorisation, two solves. What is solid acts by impulses on the mean
/// velocity of the step, and on the velocity alike. For runs, not for settling.
class Rosenbrock2 {
 public:
  static constexpr int evaluations_per_step = 2;

  Rosenbrock2(const core::Body& body, const core::Scene& scene);
  void step(core::ReferenceSystem& system, double t, double h);

 private:
  ImplicitMatrix matrix_;
  std::vector<double> x_, y_, vx_, vy_;  // the second stage, then the mean velocity of the step
  std::vector<double> fx_, fy_;
};

}  // namespace metamorph::bench
