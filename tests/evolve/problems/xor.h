#pragma once

#include <array>
#include <cmath>

#include "metamorph/evaluation.h"
#include "tests/evolve/problems/controller.h"

namespace metamorph::evolve::testing {

/// Exclusive or of two inputs that are 0 or 1; the output's interval is mapped onto [0, 1]. As in
/// Stanley and Miikkulainen (2002): fitness is (4 - sum of the four errors)^2, and it is solved
/// if every answer is on the right side of 1/2.
inline bool evaluate_xor(const core::Network& network, double slope, Evaluation& evaluation) {
  Controller controller(network, slope);
  double errors = 0;
  bool right = true;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      const double wanted = x != y ? 1 : 0;
      const double answer = (1 + controller(std::array{x, y})[0]) / 2;
      errors += std::abs(wanted - answer);
      right &= answer != 0.5 && (answer > 0.5) == (wanted == 1);
    }
  }
  evaluation.objectives = {(4 - errors) * (4 - errors)};
  return right;
}

}  // namespace metamorph::evolve::testing
