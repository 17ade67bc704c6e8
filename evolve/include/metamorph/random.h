#pragma once

#include <cstdint>

namespace metamorph::evolve {

/// Purposes of random streams: one name per use, so that no two uses share numbers.
enum class Purpose : std::uint32_t {
  initial_genome = 1,
  parent_choice = 2,
  crossover = 3,
  mutation = 4,
  species_choice = 5,
  nearby_start = 6,
  trial_start = 7,
  niche_centre = 20,
  archive_choice = 21,
  bootstrap = 30,
  test = 1000,
};

/// A counter-based stream (Philox 4x32-10): a pure function of purpose, seed, generation and
/// individual, hence independent of threads, order and interruption.
class RandomStream {
 public:
  RandomStream(Purpose purpose, std::uint64_t seed, std::uint32_t generation,
               std::uint32_t individual);

  std::uint32_t bits();                  ///< 32 random bits
  double uniform();                      ///< [0, 1), 53 bits
  double triangular();                   ///< (-1, 1): difference of two uniforms
  std::uint32_t below(std::uint32_t n);  ///< [0, n), unbiased; n > 0
  bool chance(double probability);       ///< true with this probability

 private:
  void refill();

  std::uint32_t key_[2];
  std::uint32_t counter_[4];
  std::uint32_t block_[4];
  int used_ = 4;
};

}  // namespace metamorph::evolve
