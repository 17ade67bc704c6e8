#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "evolve/files/output_file.h"
#include "evolve/life/life.h"
#include "evolve/run/lineage.h"

namespace metamorph::evolve {

/// Where an animat of the page comes from, if from a run.
struct PlaceInRun {
  int run = -1;  ///< counts the runs of the page; -1: from a file
  std::int64_t individual = -1;
  double eq6 = 0;
};

/// A run as the page tells of it: fitness by generation, and the ancestors of its animats.
struct RunInPage {
  std::string name;
  std::vector<GenerationFitness> fitness;
  std::map<std::int64_t, Ancestor> ancestors;  ///< by individual
};

/// Writes a page that replays lives: one HTML file that needs nothing else. Its own sources are
/// the HTML, CSS and JavaScript of this folder.
class PageWriter {
 public:
  /// `command`: what made the page, as a person would type it. Throws InputError (output_file.h).
  PageWriter(const std::filesystem::path& file, Overwrite overwrite, const std::string& title,
             const std::string& command);

  void add(const Life& life, const PlaceInRun& place);
  /// Ends the page: the file appears.
  void finish(const std::vector<RunInPage>& runs);

  std::size_t bytes() const { return bytes_; }

 private:
  void write(std::string_view text);

  OutputFile output_;
  std::string command_;
  std::size_t bytes_ = 0;
  int lives_ = 0;
};

}  // namespace metamorph::evolve
