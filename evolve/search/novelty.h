#pragma once

#include <span>
#include <vector>

#include "evolve/search/search.h"

namespace metamorph::evolve {

/// The behaviour of an individual, the final mean positions (x, y) of all trials one after the
/// other, [2 * trials]; empty if it has none: a trial was not run, failed, is empty or has no body.
std::vector<double> behaviour(const Evaluation& evaluation);

/// Novelty (eq 8) of every behaviour among all of them and the archive, [behaviours]. An empty
/// behaviour scores 0 and is nobody's neighbour. The only behaviour there is scores `alone`.
std::vector<double> novelty(std::span<const std::vector<double>> behaviours,
                            std::span<const ArchiveEntry> archive, int neighbours, double alone,
                            int threads);

/// Adds what is newer than the threshold to the archive, in index order, and adapts the threshold:
/// raised after more than settings.archive_many additions in a row (whoever is not added ends the
/// row, failed ones too; a row goes on into the next generation), lowered after
/// settings.archive_idle generations without one.
void update_archive(const SearchSettings& settings, SearchState& state,
                    std::span<const std::vector<double>> behaviours,
                    std::span<const double> novelties, std::span<const std::int64_t> individuals,
                    int generation);

}  // namespace metamorph::evolve
