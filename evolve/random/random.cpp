#include "metamorph/random.h"

#include <Random123/philox.h>

namespace metamorph::evolve {

RandomStream::RandomStream(Purpose purpose, std::uint64_t seed, std::uint32_t generation,
                           std::uint32_t individual)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, static_cast<std::uint32_t>(purpose), generation, individual},
      block_{} {}

void RandomStream::refill() {
  const r123::Philox4x32::ctr_type counter = {{counter_[0], counter_[1], counter_[2], counter_[3]}};
  const r123::Philox4x32::key_type key = {{key_[0], key_[1]}};
  const auto block = r123::Philox4x32{}(counter, key);
  for (int i = 0; i < 4; ++i) block_[i] = block[static_cast<std::size_t>(i)];
  ++counter_[0];
  used_ = 0;
}

std::uint32_t RandomStream::bits() {
  if (used_ == 4) refill();
  return block_[used_++];
}

double RandomStream::uniform() {
  const std::uint64_t high = bits() >> 5;  // 27 bits
  const std::uint64_t low = bits() >> 6;   // 26 bits
  return static_cast<double>((high << 26) | low) * 0x1p-53;
}

double RandomStream::triangular() {
  const double a = uniform();
  return a - uniform();
}

std::uint32_t RandomStream::below(std::uint32_t n) {
  // Reject the draws that would make the first residues more likely.
  const std::uint32_t reject_below = (0u - n) % n;
  for (;;) {
    const std::uint32_t draw = bits();
    if (draw >= reject_below) return draw % n;
  }
}

bool RandomStream::chance(double probability) { return uniform() < probability; }

}  // namespace metamorph::evolve
