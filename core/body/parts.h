#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace metamorph::core {

/// Which of a number of things hang together.
class Parts {
 public:
  explicit Parts(std::size_t things) : part_(things) {
    std::iota(part_.begin(), part_.end(), std::size_t{0});
  }
  void join(std::size_t a, std::size_t b) {
    a = first(a);
    b = first(b);
    part_[std::max(a, b)] = std::min(a, b);
  }
  /// The first thing of the part that a thing belongs to.
  std::size_t first(std::size_t thing) {
    while (part_[thing] != thing) thing = part_[thing] = part_[part_[thing]];
    return thing;
  }
  bool is_first(std::size_t thing) const { return part_[thing] == thing; }

 private:
  std::vector<std::size_t> part_;
};

}  // namespace metamorph::core
