#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "evolve/study/bootstrap.h"
#include "evolve/study/measures.h"

namespace metamorph::evolve {

/// One measure of all runs of an experiment, together.
struct Curve {
  std::size_t experiment = 0;  ///< of Study::experiments
  Measure measure;  ///< its values: the centre of the runs'; NaN: not known of all of them
  std::vector<double> low, high;  ///< [generations] the band; empty: of one run there is none
};

/// Runs that differ in their seed alone.
struct StudiedExperiment {
  std::string label;
  std::vector<std::uint64_t> seeds;  ///< ascending
};

/// What several runs show together. The order in which they were given does not matter.
struct Study {
  std::vector<StudiedExperiment> experiments;  ///< by label
  std::vector<Curve> curves;                   ///< by measure, then by experiment
  std::vector<std::string> notes;              ///< what a reader has to know, a line each
};

/// Reads what a kind of plot shows of these runs. Experiments of one name are told apart by the
/// settings in which they differ; the number of generations is no such setting, unless the search
/// is paced by it. A curve goes as far as all runs of its experiment do. `wanted`: what is drawn
/// (Measure::what); empty: all. Throws InputError: a run that cannot be read, has no generation,
/// lacks what is to be drawn or is given twice.
Study study_of(std::span<const std::filesystem::path> runs, const PlotKind& kind, Centre centre,
               std::span<const std::string> wanted);

/// Every point of the curves: experiment, curve, generation, centre, low, high, runs. Numbers read
/// back to the same bits; without a band low and high are empty.
std::string csv_of(const Study& study);

}  // namespace metamorph::evolve
