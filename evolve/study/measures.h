#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "evolve/experiment/experiment.h"
#include "evolve/run/run_reader.h"

namespace metamorph::evolve {

/// Something that was measured in every generation of a run.
struct Measure {
  std::string what;            ///< "best", "died": what --curves calls it
  std::string where;           ///< trial, scene or metamorphosis that it belongs to; may be empty
  std::string title;           ///< of the panel that it is drawn in
  std::string quantity;        ///< with its unit, for the axis
  std::vector<double> values;  ///< [generations] NaN where there is none
};

/// What trials of different experiments are matched by.
enum class MatchedBy { trial, scene };

/// A run as it is read for a plot.
struct Source {
  const RunReader& run;
  Experiment experiment;
  int generations = 0;  ///< that are read; more may have been recorded meanwhile
  MatchedBy matched_by = MatchedBy::trial;

  /// [trials] What the measures of each trial are told apart by.
  std::vector<std::string> places() const;
  /// Values of every generation, none known yet.
  std::vector<double> unknown() const;
  /// Throws InputError: what a plot needs and the run lacks.
  [[noreturn]] void lacks(std::string_view what, std::string_view expected) const;
};

/// A kind of plot.
struct PlotKind {
  std::string_view name;
  std::string_view heading;
  std::string_view help;
  std::vector<Measure> (*read)(const Source& source);
};

const std::vector<PlotKind>& plot_kinds();

/// [generations] Whether every individual was evaluated in every trial: else there is no telling of
/// eq 6 of all of them (progressive search spares trials).
std::vector<bool> fully_evaluated(const Source& source);

/// A name as the beginning of a title.
std::string titled(std::string name);

// What a search does not decide.
std::vector<Measure> read_fitness(const Source& source);
std::vector<Measure> read_distances(const Source& source);
std::vector<Measure> read_cells(const Source& source);
std::vector<Measure> read_metamorphosis(const Source& source);

// How a search fares.
std::vector<Measure> read_species(const Source& source);
std::vector<Measure> read_archive(const Source& source);
std::vector<Measure> read_failures(const Source& source);
std::vector<Measure> read_time(const Source& source);

}  // namespace metamorph::evolve
