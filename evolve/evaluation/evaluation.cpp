#include "metamorph/evaluation.h"

#include <cassert>
#include <cmath>
#include <set>

namespace metamorph::evolve {

int stage_count(const Problem& problem) {
  std::set<int> stages;
  for (const Objective& objective : problem.objectives) stages.insert(objective.stage);
  return static_cast<int>(stages.size());
}

double root(double x, int n) {
  assert(x >= 0 && n > 0);
  if (n == 1 || x == 0 || !std::isfinite(x)) return x;
  if (n == 2) return std::sqrt(x);
  // Newton's method from above falls until rounding ends it. Powers of two are split off, so that
  // no power overflows.
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // [1/2, 1)
  const int whole = exponent >= 0 ? (exponent + n - 1) / n : -(-exponent / n);
  mantissa = std::ldexp(mantissa, exponent - whole * n);  // (2^-n-1, 1)
  double y = 1;
  for (;;) {
    double power = 1;
    for (int i = 1; i < n; ++i) power *= y;
    const double next = ((n - 1) * y + mantissa / power) / n;
    if (!(next < y)) return std::ldexp(y, whole);
    y = next;
  }
}

double geometric_mean(const Evaluation& evaluation) {
  assert(!evaluation.objectives.empty());
  double product = 1;
  for (const double objective : evaluation.objectives) product *= objective;
  return root(product, static_cast<int>(evaluation.objectives.size())) * evaluation.factor;
}

}  // namespace metamorph::evolve
