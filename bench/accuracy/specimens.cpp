#include "bench/accuracy/specimens.h"

#include <algorithm>
#include <array>
#include <span>

#include "evolve/files/genome_file.h"
#include "evolve/genetics/population.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"
#include "metamorph/genome.h"

namespace metamorph::bench {
namespace {

constexpr std::uint64_t random_seed = 2016;

/// The larvae and adults that these genomes grow into; genomes without a body leave none.
std::vector<Specimen> grow(std::span<const evolve::Genome> genomes,
                           std::span<const std::string> names, bool evolved) {
  static constexpr std::array stages = {600, 1200};
  std::vector<core::Network> networks;
  for (const evolve::Genome& genome : genomes) networks.push_back(compile(genome));
  const auto embryos = core::develop(networks, {}, stages, 0);
  std::vector<Specimen> result;
  for (std::size_t i = 0; i < genomes.size(); ++i) {
    for (std::size_t s = 0; s < stages.size(); ++s) {
      core::Extraction extraction = core::extract_body(embryos[i][s]);
      if (extraction.status != core::Status::ok) continue;
      result.push_back(
          {names[i] + (s == 0 ? "-larva" : "-adult"), evolved, std::move(extraction.body)});
    }
  }
  return result;
}

std::vector<Specimen> grow_random(std::size_t count) {
  const std::vector<evolve::Genome> genomes = evolve::first_generation({}, random_seed).genomes;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < genomes.size(); ++i) names.push_back("random-" + std::to_string(i));
  std::vector<Specimen> all = grow(genomes, names, false);
  std::stable_sort(all.begin(), all.end(), [](const Specimen& a, const Specimen& b) {
    return a.body.node_count() < b.body.node_count();
  });
  if (all.size() <= count) return all;
  std::vector<Specimen> chosen;
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(all[i * (all.size() - 1) / std::max<std::size_t>(count - 1, 1)]);
  return chosen;
}

}  // namespace

std::vector<Specimen> grow_specimens(const std::vector<std::filesystem::path>& genomes,
                                     std::size_t random) {
  std::vector<evolve::Genome> evolved;
  std::vector<std::string> names;
  for (const auto& file : genomes) {
    evolved.push_back(evolve::read_genome(file));
    names.push_back(file.stem().string());
  }
  std::vector<Specimen> result = grow(evolved, names, true);
  for (Specimen& specimen : grow_random(random)) result.push_back(std::move(specimen));
  return result;
}

}  // namespace metamorph::bench
