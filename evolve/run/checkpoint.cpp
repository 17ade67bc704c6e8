#include "evolve/run/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "evolve/files/input_error.h"
#include "evolve/run/table_digest.h"
#include "evolve/search/population_json.h"

namespace metamorph::evolve {
namespace {

constexpr std::string_view mark = "metachk4";
constexpr std::size_t checksum_size = 8;

/// Most significant byte first.
std::array<std::uint8_t, checksum_size> checksum(std::span<const std::uint8_t> bytes) {
  const std::uint64_t hash = hash_of({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  std::array<std::uint8_t, checksum_size> result;
  for (std::size_t i = 0; i < checksum_size; ++i) {
    result[i] = static_cast<std::uint8_t>(hash >> (8 * (checksum_size - 1 - i)));
  }
  return result;
}

}  // namespace

// The bindings name every field: a new one does not compile before it is thought of here.

std::vector<std::uint8_t> encode(const Checkpoint& checkpoint) {
  const auto& [generation, search, best, chain] = checkpoint;
  const auto& [best_generation, individual, eq6, score, distances, genome] = best;
  const std::vector<std::uint8_t> fields =
      nlohmann::json::to_cbor({{"generation", generation},
                               {"chain", chain},
                               {"search", nlohmann::json::binary(search)},
                               {"best",
                                {{"generation", best_generation},
                                 {"individual", individual},
                                 {"eq6", eq6},
                                 {"score", score},
                                 {"distances", distances},
                                 {"genome", to_json(genome)}}}});
  const auto sum = checksum(fields);
  std::vector<std::uint8_t> bytes(mark.size() + sum.size() + fields.size());
  auto end = std::copy(mark.begin(), mark.end(), bytes.begin());
  end = std::copy(sum.begin(), sum.end(), end);
  std::copy(fields.begin(), fields.end(), end);
  return bytes;
}

Checkpoint decode(std::span<const std::uint8_t> bytes, const std::string& source) {
  const auto refuse = [&](const std::string& why) -> InputError {
    return InputError(fmt::format("{}: checkpoint {}", source, why));
  };
  if (bytes.size() < mark.size() + checksum_size ||
      !std::equal(mark.begin(), mark.end(), bytes.begin())) {
    throw refuse(fmt::format("is missing or damaged, or of another version: expected {}", mark));
  }
  const auto fields = bytes.subspan(mark.size() + checksum_size);
  const auto sum = checksum(fields);
  if (!std::equal(sum.begin(), sum.end(), bytes.begin() + mark.size())) {
    throw refuse("is damaged: its checksum does not match");
  }
  try {
    const nlohmann::json json = nlohmann::json::from_cbor(fields.begin(), fields.end());
    Checkpoint checkpoint;
    auto& [generation, search, best, chain] = checkpoint;
    auto& [best_generation, individual, eq6, score, distances, genome] = best;
    read_integer(json.at("generation"), generation);
    read_integer(json.at("chain"), chain);
    search = json.at("search").get_binary();
    const nlohmann::json& of_best = json.at("best");
    read_integer(of_best.at("generation"), best_generation);
    read_integer(of_best.at("individual"), individual);
    of_best.at("eq6").get_to(eq6);
    of_best.at("score").get_to(score);
    of_best.at("distances").get_to(distances);
    genome = genome_of(of_best.at("genome"));
    return checkpoint;
  } catch (const nlohmann::json::exception& error) {
    throw refuse(fmt::format("is damaged: {}", error.what()));
  }
}

}  // namespace metamorph::evolve
