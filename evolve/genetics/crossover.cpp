#include "metamorph/variation.h"

#include <cstdint>

namespace metamorph::evolve {

Genome cross(const Genome& fitter, const Genome& other, bool averaging, RandomStream& stream) {
  Genome child = fitter;
  auto mate = other.links.begin();
  std::uint32_t coins = 0;  // one random bit per matching link, taken from 32-bit draws
  int coins_left = 0;
  for (LinkGene& link : child.links) {
    while (mate != other.links.end() && mate->innovation < link.innovation) ++mate;
    if (mate == other.links.end()) break;
    if (mate->innovation != link.innovation) continue;
    if (averaging) {
      link.weight = 0.5 * (link.weight + mate->weight);
      continue;
    }
    if (coins_left == 0) {
      coins = stream.bits();
      coins_left = 32;
    }
    if (coins & 1u) link.weight = mate->weight;
    coins >>= 1;
    --coins_left;
  }
  return child;
}

}  // namespace metamorph::evolve
