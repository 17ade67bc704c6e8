#include "evolve/run/checkpoint.h"

#include <fmt/format.h>

#include <bit>
#include <concepts>
#include <cstring>

#include "evolve/files/input_error.h"

namespace metamorph::evolve {
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are written little-endian");

constexpr char magic[8] = {'m', 'e', 't', 'a', 'c', 'h', 'k', 'p'};
constexpr std::uint32_t version = 1;
constexpr std::size_t header_size = sizeof magic + 4 + 8 + 8;

/// FNV-1a: tells damage, not malice.
std::uint64_t checksum(std::span<const std::uint8_t> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}

/// Appends fields to a byte string.
class Writer {
 public:
  template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(const T& value) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), data, data + sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& values);

  std::vector<std::uint8_t> bytes;
};

/// Takes fields from a byte string; `whole` turns false where they run out.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : left(bytes) {}

  template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(T& value) {
    if (left.size() < sizeof value) {
      whole = false;
      return;
    }
    std::memcpy(&value, left.data(), sizeof value);
    left = left.subspan(sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& values);

  std::span<const std::uint8_t> left;
  bool whole = true;
};

// One list of fields per type serves both directions.
template <class Archive, class T>
  requires std::same_as<std::remove_const_t<T>, double>
void fields(Archive& a, T& value) {
  a(value);
}

template <class Archive, class T>
  requires std::same_as<std::remove_const_t<T>, NodeGene>
void fields(Archive& a, T& node) {
  a(node.id), a(node.kind);
}

template <class Archive, class T>
  requires std::same_as<std::remove_const_t<T>, LinkGene>
void fields(Archive& a, T& link) {
  a(link.innovation), a(link.from), a(link.to), a(link.weight);
}

template <class Archive, class T>
  requires std::same_as<std::remove_const_t<T>, Genome>
void fields(Archive& a, T& genome) {
  a(genome.nodes), a(genome.links);
}

template <class Archive, class T>
  requires std::same_as<std::remove_const_t<T>, Individual>
void fields(Archive& a, T& individual) {
  a(individual.id), a(individual.parent_a), a(individual.parent_b), a(individual.species);
}

template <class Archive, class T>
  requires std::same_as<std::remove_const_t<T>, Species>
void fields(Archive& a, T& species) {
  a(species.id), fields(a, species.representative), a(species.age), a(species.best_ever);
  a(species.stagnant), a(species.size);
}

template <class Archive, class T>
  requires std::same_as<std::remove_const_t<T>, Checkpoint>
void fields(Archive& a, T& checkpoint) {
  auto& p = checkpoint.population;
  a(p.seed), a(p.generation), a(p.genomes), a(p.individuals), a(p.species), a(p.next_individual);
  a(p.next_species), a(p.next_innovation), a(p.next_node), a(p.compatibility_threshold);
  auto& s = checkpoint.search;
  a(s.archive_threshold), a(s.added_in_a_row), a(s.idle_generations);
  auto& b = checkpoint.best;
  a(b.generation), a(b.individual), a(b.eq6), a(b.score), a(b.distances), fields(a, b.genome);
}

template <class T>
void Writer::operator()(const std::vector<T>& values) {
  (*this)(static_cast<std::uint64_t>(values.size()));
  for (const T& value : values) fields(*this, value);
}

template <class T>
void Reader::operator()(std::vector<T>& values) {
  std::uint64_t count = 0;
  (*this)(count);
  if (count > left.size()) whole = false;  // every element takes at least a byte
  if (!whole) return;
  values.resize(count);
  for (T& value : values) fields(*this, value);
}

}  // namespace

std::vector<std::uint8_t> encode(const Checkpoint& checkpoint) {
  Writer body;
  fields(body, checkpoint);
  Writer all;
  for (const char c : magic) all(c);
  all(version);
  all(static_cast<std::uint64_t>(body.bytes.size()));
  all(checksum(body.bytes));
  all.bytes.insert(all.bytes.end(), body.bytes.begin(), body.bytes.end());
  return all.bytes;
}

Checkpoint decode(std::span<const std::uint8_t> bytes, const std::string& source) {
  const auto refuse = [&](const std::string& why) -> InputError {
    return InputError(fmt::format("{}: checkpoint {}", source, why));
  };
  if (bytes.size() < header_size || std::memcmp(bytes.data(), magic, sizeof magic) != 0) {
    throw refuse("is missing or damaged: expected one written by metamorph evolve");
  }
  Reader header(bytes.subspan(sizeof magic));
  std::uint32_t found_version = 0;
  std::uint64_t length = 0, sum = 0;
  header(found_version), header(length), header(sum);
  if (found_version != version) {
    throw refuse(fmt::format("has version {}: expected {}", found_version, version));
  }
  if (header.left.size() != length) {
    throw refuse(fmt::format("is {} bytes long: expected {}", header.left.size(), length));
  }
  if (checksum(header.left) != sum) throw refuse("is damaged: its checksum does not match");
  Checkpoint checkpoint;
  Reader body(header.left);
  fields(body, checkpoint);
  if (!body.whole || !body.left.empty()) throw refuse("is damaged: its fields do not fill it");
  return checkpoint;
}

}  // namespace metamorph::evolve
