#include "evolve/evaluation/fingerprint.h"

#include <Random123/threefry.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

namespace metamorph::evolve {
namespace {

/// Takes in arrays, each with its length, so that no two sequences of arrays look alike.
class Absorber {
 public:
  template <class List>
  void operator()(const List& list) {
    using Element = std::remove_cvref_t<decltype(list[0])>;
    static_assert(std::has_unique_object_representations_v<Element> ||
                  std::is_floating_point_v<Element>);  // no padding, whose bits say nothing
    const auto bytes = std::as_bytes(std::span(list));
    Cipher::ctr_type length{};
    length[0] = bytes.size();
    absorb(length);
    for (std::size_t at = 0; at < bytes.size(); at += sizeof length) {
      Cipher::ctr_type block{};
      std::memcpy(block.data(), bytes.data() + at, std::min(sizeof block, bytes.size() - at));
      absorb(block);
    }
  }

  Fingerprint result() const { return {{state_[0], state_[1]}}; }

 private:
  using Cipher = r123::Threefry4x64_R<20>;

  void absorb(const Cipher::ctr_type& block) {
    const Cipher::ctr_type cipher = Cipher{}(block, state_);
    for (std::size_t i = 0; i < block.size(); ++i) state_[i] = cipher[i] ^ block[i];
  }

  Cipher::key_type state_{};
};

template <class... Lists>
void absorb_all(Absorber& absorber, const Lists&... lists) {
  (absorber(lists), ...);
}

}  // namespace

// The bindings name every field: a new one does not compile before it is thought of here.

Fingerprint fingerprint(std::span<const core::Network> life) {
  Absorber absorber;
  for (const auto& [inputs, first_link, source, weight, output] : life) {
    absorb_all(absorber, std::array{inputs}, first_link, source, weight, output);
  }
  return absorber.result();
}

Fingerprint fingerprint(const core::Body& body) {
  const auto& [x, y, period, phase, triangles, springs, rest_length, rest_area, cell] = body;
  Absorber absorber;
  absorb_all(absorber, x, y, period, phase, triangles, springs, rest_length, rest_area);
  return absorber.result();
}

}  // namespace metamorph::evolve
