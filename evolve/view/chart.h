#pragma once

#include <string>
#include <vector>

#include "evolve/view/colour.h"

namespace metamorph::evolve {

/// A line over whole numbers from 0, with a band around it. Values are below 1e100 in magnitude.
struct ChartCurve {
  std::vector<double> values;     ///< NaN: a gap
  std::vector<double> low, high;  ///< as many, with gaps where values have them; empty: no band
  Colour colour;
  bool dashed = false;
};

/// Axes with curves. The vertical axis begins at 0, or below where a curve does.
struct ChartPanel {
  std::string title;
  std::string quantity;  ///< with its unit, below the title
  std::vector<ChartCurve> curves;
};

struct ChartKey {
  std::string label;
  Colour colour;
  bool dashed = false;
  bool banded = true;  ///< has a band
};

/// Panels in rows, with one horizontal axis for all.
struct Chart {
  std::string heading;
  std::string remark;          ///< below the heading, smaller
  std::vector<ChartKey> keys;  ///< what the colours mean
  std::string across;          ///< what the horizontal axis counts
  int columns = 1;
  std::vector<ChartPanel> panels;
  std::vector<std::string> notes;  ///< at the foot, a line each
};

/// The picture as bytes of .svg, .png or .pdf, by the ending of `file`, which is not written. The
/// same chart gives the same bytes of SVG and PNG. Throws std::runtime_error if it cannot be drawn.
std::string draw_chart(const Chart& chart, const std::string& file);

}  // namespace metamorph::evolve
