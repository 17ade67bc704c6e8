#include "core/reference/stability.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <vector>

#include "core/reference/system.h"

namespace metamorph::core {
namespace {

using Eigen::MatrixXd;

/// Only what acts on a body at rest: drag has no slope there, ground and outline act by impulses or
/// not at all. A force that is not switched off here counts.
Scene bare(Scene scene, double damping) {
  scene.damping = damping;
  scene.amplitude = 0;
  scene.drag = scene.ground = scene.self_collision = false;
  return scene;
}

/// -d force / d position and -d force / d velocity by central differences; row 2 i + axis.
struct Linear {
  MatrixXd stiffness, damping;

  Linear(const Body& body, const Scene& scene) {
    ReferenceSystem system(body, scene);
    const std::size_t nodes = body.x.size();
    const auto size = static_cast<Eigen::Index>(2 * nodes);
    std::vector<double> fx(nodes), fy(nodes);
    const auto slopes = [&](std::vector<double>& along_x, std::vector<double>& along_y) {
      constexpr double delta = 1e-5;
      MatrixXd matrix(size, size);
      for (Eigen::Index column = 0; column < size; ++column) {
        std::vector<double>& along = column % 2 == 0 ? along_x : along_y;
        double& value = along[static_cast<std::size_t>(column / 2)];
        const double rest = value;
        Eigen::VectorXd difference = Eigen::VectorXd::Zero(size);
        for (const double sign : {-1.0, 1.0}) {
          value = rest + sign * delta;
          system.forces(system.nodes(), 0, {fx, fy});
          for (Eigen::Index i = 0; i < size / 2; ++i) {
            difference[2 * i] += sign * fx[static_cast<std::size_t>(i)];
            difference[2 * i + 1] += sign * fy[static_cast<std::size_t>(i)];
          }
        }
        value = rest;
        matrix.col(column) = -difference / (2 * delta);
      }
      return matrix;
    };
    stiffness = slopes(system.x, system.y);
    damping = slopes(system.vx, system.vy);
  }
};

/// The largest h below `high` for which `stable` holds, where it holds up to a limit.
template <class Stable>
double largest_step(double high, Stable&& stable) {
  double low = 0;
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

double linear_step_limit(const Body& body, const Scene& scene, double damping,
                         ReferenceMethod method) {
  if (method == ReferenceMethod::velocity_verlet)
    throw std::invalid_argument("linear_step_limit: velocity_verlet has no closed form");
  const Linear linear(body, bare(scene, damping));
  const Eigen::Index size = linear.stiffness.rows();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(linear.stiffness, Eigen::EigenvaluesOnly);
  const double frequency = std::sqrt(modes.eigenvalues().maxCoeff());
  const double high = 4 / frequency;  // RK4 reaches 2.8 / frequency, lightly damped 2.9

  if (method == ReferenceMethod::symplectic_euler || method == ReferenceMethod::drift_kick_drift) {
    const double weight = method == ReferenceMethod::drift_kick_drift ? 4 : 2;
    return largest_step(high, [&](double h) {
      const MatrixXd sum = h * h * linear.stiffness + weight * h * linear.damping;
      return Eigen::SelfAdjointEigenSolver<MatrixXd>(sum, Eigen::EigenvaluesOnly)
                 .eigenvalues()
                 .maxCoeff() <= 4;
    });
  }

  MatrixXd first_order = MatrixXd::Zero(2 * size, 2 * size);
  first_order.topRightCorner(size, size).setIdentity();
  first_order.bottomLeftCorner(size, size) = -linear.stiffness;
  first_order.bottomRightCorner(size, size) = -linear.damping;
  const Eigen::VectorXcd lambda = first_order.eigenvalues();
  const int order = method == ReferenceMethod::runge_kutta_4 ? 4 : 2;
  return largest_step(high, [&](double h) {
    for (Eigen::Index i = 0; i < lambda.size(); ++i) {
      const std::complex<double> z = h * lambda[i];
      std::complex<double> sum = 1, term = 1;
      for (int n = 1; n <= order; ++n) {
        term *= z / static_cast<double>(n);
        sum += term;
      }
      // The double zero of a rigid motion comes out as about +-1e-5.
      if (std::abs(sum) > 1 + 1e-4) return false;
    }
    return true;
  });
}

}  // namespace metamorph::core
