#pragma once

#include <filesystem>
#include <string>

#include "evolve/files/output_file.h"
#include "metamorph/locomotion.h"

namespace metamorph::evolve {

/// Writes a motion as CSV: step, time, node, x, y, vx, vy, one line per frame and node, every
/// number in the shortest form that reads back to the same bits. Step and time count from the start
/// of actuation (integrator steps; time units), node is the position in the body. The file appears
/// with finish().
class TrajectoryWriter {
 public:
  TrajectoryWriter(const std::filesystem::path& file, Overwrite overwrite);

  void write(const core::Frame& frame);
  void finish() { output_.commit(); }

 private:
  OutputFile output_;
  std::string text_;
};

}  // namespace metamorph::evolve
