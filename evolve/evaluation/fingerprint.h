#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "metamorph/body.h"
#include "metamorph/network.h"

namespace metamorph::evolve {

/// 128 bits that stand for some content, bit by bit (0.0 and -0.0 differ).
///
/// Threefry, the cipher behind Skein, in Skein's chaining: no structure of the data is known to
/// make two contents agree. A run of 2000 generations makes some 1e9 comparisons; that one of them
/// takes two different contents for equal has a probability of 1e9 / 2^128 = 3e-30.
struct Fingerprint {
  std::array<std::uint64_t, 2> words{};
  bool operator==(const Fingerprint&) const = default;
};

/// The words are evenly spread already.
struct FingerprintHash {
  std::size_t operator()(const Fingerprint& f) const {
    return static_cast<std::size_t>(f.words[0]);
  }
};

/// Of all that development depends on: the networks that control it, one after the other.
Fingerprint fingerprint(std::span<const core::Network> life);
/// Of all that motion depends on: nodes, mesh, rest values and oscillators (not `cell`).
Fingerprint fingerprint(const core::Body& body);

}  // namespace metamorph::evolve
