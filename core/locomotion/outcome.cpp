#include "metamorph/outcome.h"

#include <algorithm>

namespace metamorph::core {

Outcome describe(const Body& body) {
  Outcome outcome;
  outcome.cells = body.node_count();
  outcome.springs = static_cast<int>(body.springs.size());
  outcome.triangles = static_cast<int>(body.triangles.size());
  int above = 0;
  for (const double length : body.rest_length) {
    outcome.longest_spring = std::max(outcome.longest_spring, length);
    if (length > 1.5) ++above;
  }
  if (outcome.springs > 0) outcome.long_spring_share = static_cast<double>(above) / outcome.springs;
  return outcome;
}

}  // namespace metamorph::core
