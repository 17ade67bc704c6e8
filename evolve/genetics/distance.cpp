#include "evolve/genetics/distance.h"

#include <array>
#include <cmath>

namespace metamorph::evolve {

namespace {
constexpr std::size_t lanes = 8;

// Links that both have, but not in the same stages of life.
std::size_t moved(const LinkArrays& a, const LinkArrays& b) {
  const auto stages_of = [](const LinkArrays& arrays, std::size_t link) {
    return arrays.stages.empty() ? Stages{} : arrays.stages[link];
  };
  if (a.stages.empty() && b.stages.empty()) return 0;
  std::size_t count = 0;
  for (std::size_t i = 0, j = 0; i < a.innovation.size() && j < b.innovation.size();) {
    if (a.innovation[i] == b.innovation[j]) {
      count += stages_of(a, i++) != stages_of(b, j++);
    } else {
      ++(a.innovation[i] < b.innovation[j] ? i : j);
    }
  }
  return count;
}

}  // namespace

LinkArrays link_arrays(const Genome& genome) {
  LinkArrays arrays;
  arrays.innovation.reserve(genome.links.size());
  arrays.weight.reserve(genome.links.size());
  for (const LinkGene& link : genome.links) {
    arrays.innovation.push_back(link.innovation);
    arrays.weight.push_back(link.weight);
  }
  if (is_separated(genome)) {
    for (const LinkGene& link : genome.links) arrays.stages.push_back(link.stages);
  }
  return arrays;
}

double distance(const LinkArrays& a, const LinkArrays& b, double factor, double limit) {
  const std::size_t size_a = a.innovation.size(), size_b = b.innovation.size();
  const int* const innovation_a = a.innovation.data();
  const int* const innovation_b = b.innovation.data();
  const double* const weight_a = a.weight.data();
  const double* const weight_b = b.weight.data();

  // Relatives share long runs of links, so whole blocks are compared at once; where a block differs
  // the lists are merged link by link for a while. The partial sums are written out, so that the
  // order of summation does not depend on the instruction set.
  std::array<double, lanes> sum{};
  std::size_t i = 0, j = 0, matching = 0, unmatched = 0;
  while (i < size_a && j < size_b) {
    if (i + lanes <= size_a && j + lanes <= size_b) {
      int different = 0;
      for (std::size_t l = 0; l < lanes; ++l)
        different |= innovation_a[i + l] ^ innovation_b[j + l];
      if (different == 0) {
        for (std::size_t l = 0; l < lanes; ++l) {
          sum[l] += std::abs(weight_a[i + l] - weight_b[j + l]);
        }
        i += lanes;
        j += lanes;
        matching += lanes;
        continue;
      }
    }
    for (std::size_t merge = 0; merge < lanes && i < size_a && j < size_b; ++merge) {
      if (innovation_a[i] == innovation_b[j]) {
        sum[merge] += std::abs(weight_a[i++] - weight_b[j++]);
        ++matching;
      } else {
        ++(innovation_a[i] < innovation_b[j] ? i : j);
        ++unmatched;
      }
    }
    if (static_cast<double>(unmatched) >= limit) return static_cast<double>(unmatched);
  }
  unmatched += (size_a - i) + (size_b - j) + moved(a, b);
  if (matching == 0) return static_cast<double>(unmatched);
  double total = 0;
  for (const double part : sum) total += part;
  return static_cast<double>(unmatched) + factor * total / static_cast<double>(matching);
}

double distance(const Genome& a, const Genome& b, double factor) {
  return distance(link_arrays(a), link_arrays(b), factor);
}

}  // namespace metamorph::evolve
