#pragma once

// The reference simulator's methods and their orders, for parameterised tests.

#include <array>
#include <ostream>
#include <string>

#include "metamorph/reference.h"

namespace metamorph::tests {

struct MethodOfOrder {
  std::string name;
  core::ReferenceMethod method;
  int order;
};

inline std::ostream& operator<<(std::ostream& out, const MethodOfOrder& m) { return out << m.name; }

inline const std::array<MethodOfOrder, 5> reference_methods = {{
    {"SymplecticEuler", core::ReferenceMethod::symplectic_euler, 1},
    {"DriftKickDrift", core::ReferenceMethod::drift_kick_drift, 2},
    {"VelocityVerlet", core::ReferenceMethod::velocity_verlet, 2},
    {"Midpoint", core::ReferenceMethod::midpoint, 2},
    {"RungeKutta4", core::ReferenceMethod::runge_kutta_4, 4},
}};

}  // namespace metamorph::tests
