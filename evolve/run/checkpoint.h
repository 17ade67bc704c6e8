#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evolve/genetics/population.h"
#include "evolve/search/search.h"

namespace metamorph::evolve {

/// The best individual that a run has seen: by eq 6, then by score (while progressive search grows
/// only larvae, eq 6 is often 0), then the earliest.
struct BestEver {
  int generation = -1;  ///< -1: none yet
  std::int64_t individual = -1;
  double eq6 = -1;
  double score = -1;
  std::vector<double> distances;  ///< [trials] d
  Genome genome;
  bool operator==(const BestEver&) const = default;
};

/// Everything that decides how a run goes on, between two generations: `population` is about to be
/// evaluated. The novelty archive is left out of the encoding: the record holds its entries, each
/// once, and it would make every checkpoint megabytes long.
struct Checkpoint {
  PopulationState population;
  SearchState search;
  BestEver best;
};

/// Exact binary form: magic, version, length and checksum, then every field, little-endian.
std::vector<std::uint8_t> encode(const Checkpoint& checkpoint);
/// The inverse, with an empty archive. Throws InputError("<source>: checkpoint ...") if the bytes
/// are of another version, truncated, or damaged.
Checkpoint decode(std::span<const std::uint8_t> bytes, const std::string& source);

}  // namespace metamorph::evolve
