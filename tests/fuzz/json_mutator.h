#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>

// libFuzzer's own, on the bytes: returns the new size, at most max_size.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace metamorph::fuzz {

/// A change of one value somewhere in a JSON document, so that it stays one: bytes alone seldom
/// come past the parser. False if the document is nested too deep for that.
bool mutate(nlohmann::json& document, std::minstd_rand& random);

/// The text or bytes with a change: `read` makes a document of them (and may throw JSON's
/// exceptions), `write` the reverse. One change of three is of the bytes, and every one where
/// there is no document. Returns the new size.
template <class Read, class Write>
std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed,
                   Read read, Write write) {
  std::minstd_rand random(seed);
  if (random() % 3 != 0) {
    try {
      nlohmann::json document = read(data, data + size);
      if (mutate(document, random)) {
        const auto changed = write(document);
        if (changed.size() <= max_size) {
          std::copy(changed.begin(), changed.end(), data);
          return changed.size();
        }
      }
    } catch (const nlohmann::json::exception&) {  // it is none: by its bytes
    }
  }
  return LLVMFuzzerMutate(data, size, max_size);
}

}  // namespace metamorph::fuzz
