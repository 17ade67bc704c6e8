// For targets whose inputs are JSON as CBOR.

#include "tests/fuzz/json_mutator.h"

using Json = nlohmann::json;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  return metamorph::fuzz::mutate(
      data, size, max_size, seed,
      [](const std::uint8_t* begin, const std::uint8_t* end) {
        return Json::from_cbor(begin, end);
      },
      [](const Json& document) { return Json::to_cbor(document); });
}
