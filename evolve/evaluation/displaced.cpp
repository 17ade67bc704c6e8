#include "evolve/evaluation/displaced.h"

namespace metamorph::evolve {

core::Body displaced(core::Body body, double displacement, RandomStream random) {
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    body.x[i] += displacement * (2 * random.uniform() - 1);
    body.y[i] += displacement * (2 * random.uniform() - 1);
  }
  return body;
}

}  // namespace metamorph::evolve
