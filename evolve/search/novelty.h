#pragma once

#include <cstdint>
#include <span>
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
  double archive_threshold = 0;
  int added_in_a_row = 0;
  int idle_generations = 0;
  bool operator==(const NoveltyState&) const = default;
};

/// Novelty (eq 8) of every behaviour among all of them and the archive, [behaviours]. An empty
/// behaviour scores 0 and is nobody's neighbour. The only behaviour there is scores `alone`.
std::vector<double> novelty(std::span<const std::vector<double>> behaviours,
                            std::span<const ArchiveEntry> archive, int neighbours, double alone,
                            int threads);

/// Adds what is newer than the threshold to the archive, in index order, and adapts the threshold:
/// raised after more than settings.archive_many additions in a row (whoever is not added ends the
/// row, failed ones too; a row goes on into the next generation), lowered after
/// settings.archive_idle generations without one.
void update_archive(const NoveltySettings& settings, NoveltyState& state,
                    std::span<const std::vector<double>> behaviours,
                    std::span<const double> novelties, std::span<const std::int64_t> individuals,
                    int generation);

}  // namespace metamorph::evolve
