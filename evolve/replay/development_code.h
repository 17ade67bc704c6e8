#pragma once

#include <span>
#include <string>
#include <vector>

#include "metamorph/development.h"

namespace metamorph::evolve {

inline constexpr double period_step = 0.25;                             ///< time units
inline constexpr double phase_step = 2 * 3.14159265358979323846 / 256;  ///< radians

/// A development as it lies in a page: zlib streams of varints (track_code.h), a frame per step.
struct PackedDevelopment {
  int frames = 0;
  /// Number of cells; of each, ascending by id: id less the one before (of the first: id), id of
  /// the mother + 1, first frame, number of frames, zigzag(step of birth - first frame).
  std::string cells;
  /// Number of links; of each, ascending by cells: first cell (position in `cells`) less that of
  /// the link before, second less first, first frame, number of frames.
  std::string links;
  /// Of each cell: number of changes; of each change: frames since the one before (since the first
  /// frame), zigzag of the differences of period and phase in the steps above.
  std::string signals;
  std::vector<std::string> chunks;  ///< courses of the cells
};

/// Embryos of successive steps.
PackedDevelopment pack(std::span<const core::Embryo> embryos);

}  // namespace metamorph::evolve
