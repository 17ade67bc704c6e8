#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace metamorph::evolve {

/// Numbers of novelty search (MODEL section 6).
struct NoveltySettings {
  int neighbours = 15;             ///< k of eq 8
  double archive_threshold = 1.0;  ///< d, at the start
  double archive_floor = 0.05;     ///< d
  int archive_many = 8;            ///< more additions than this in a row raise the threshold
  int archive_idle = 50;           ///< generations without an addition lower it
  double archive_raise = 1.1;
  double archive_lower = 0.9;
  bool archive_copies = false;              ///< a behaviour equal to an entry's may enter
  bool archive_per_generation = true;       ///< a row of additions is what a generation adds
  bool records_restart = true;              ///< species do not age by scores that fall with time
  bool scaled = false;                      ///< behaviour is divided by its spread, trial by trial
  std::vector<std::string> behaviour = {};  ///< descriptors that are compared; none: all positions
};

/// An entry of the novelty archive.
struct ArchiveEntry {
  std::int64_t individual = 0;
  int generation = 0;
  double novelty = 0;
  std::vector<double> behaviour;  ///< [descriptors]
  bool operator==(const ArchiveEntry&) const = default;
};

/// What novelty search remembers between generations.
struct NoveltyState {
  std::vector<ArchiveEntry> archive;
  std::set<std::vector<double>> behaviours;  ///< of the archive, each once
  double archive_threshold = 0;
  int added_in_a_row = 0;
  int idle_generations = 0;
  int copies = 0;  ///< behaviours of the last generation that would have entered as copies
  bool operator==(const NoveltyState&) const = default;
};

/// What belongs together in a behaviour: [descriptors] a number from 0 on, ascending, for the trial
/// that the descriptor is told of.
using Groups = std::vector<int>;

/// [groups] variance of the behaviours (empty ones left out), summed over the descriptors of a
/// group; 0 if there is no behaviour.
std::vector<double> group_variances(std::span<const std::vector<double>> behaviours,
                                    const Groups& groups);

/// [groups] factors that give every group the same variance and keep the sum of all; 1 for a group
/// without any.
std::vector<double> levelling_factors(std::span<const double> variances);

/// Novelty (eq 8) of every behaviour among all of them and the archive, [behaviours]. An empty
/// behaviour scores 0 and is nobody's neighbour. The only behaviour there is scores `alone`.
/// Descriptor d counts `factors[d]` times its value; factors empty: all 1.
std::vector<double> novelty(std::span<const std::vector<double>> behaviours,
                            std::span<const ArchiveEntry> archive, int neighbours, double alone,
                            int threads, std::span<const double> factors = {});

/// Adds what is newer than the threshold to the archive, in index order, and adapts the threshold:
/// raised after more than settings.archive_many additions in a row, lowered after
/// settings.archive_idle generations without one. As the paper has it, whoever is not added ends
/// the row, failed ones too, and a row goes on into the next generation; per generation, a row is
/// what a generation adds, whoever stands between. A behaviour equal to an entry's is not added
/// unless settings.archive_copies.
void update_archive(const NoveltySettings& settings, NoveltyState& state,
                    std::span<const std::vector<double>> behaviours,
                    std::span<const double> novelties, std::span<const std::int64_t> individuals,
                    int generation);

}  // namespace metamorph::evolve
