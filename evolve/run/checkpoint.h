#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "metamorph/genome.h"

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

/// Everything that decides how a run goes on, between two generations, but for what the tables of
/// its search hold: a novelty archive would make every checkpoint megabytes long.
struct Checkpoint {
  int generation = 0;                ///< about to be evaluated
  std::vector<std::uint8_t> search;  ///< Search::save()
  BestEver best;
  std::uint64_t chain = 0;  ///< of the digests of all that the record holds (run/integrity.h)
  bool operator==(const Checkpoint&) const = default;
};

/// Exact binary form: a mark, a checksum, and the fields as CBOR.
std::vector<std::uint8_t> encode(const Checkpoint& checkpoint);
/// The inverse. Throws InputError("<source>: checkpoint ...") if the bytes are of another version,
/// truncated, or damaged.
Checkpoint decode(std::span<const std::uint8_t> bytes, const std::string& source);

}  // namespace metamorph::evolve
