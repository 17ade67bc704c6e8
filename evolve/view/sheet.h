#pragma once

#include <string>
#include <vector>

#include "evolve/files/output_file.h"
#include "evolve/view/panel.h"

namespace metamorph::evolve {

/// What the colours mean, at the foot of a sheet.
enum class Legend { none, birth, strain, phase };

/// Panels in rows and columns, all to one scale, with a heading, a scale bar and a legend. A row
/// may be shorter than others, and a panel with an empty box stays blank.
struct Sheet {
  std::string heading;
  std::string remark;  ///< below the heading, smaller
  Legend legend = Legend::none;
  int stages = 2;  ///< of life, that the legend of births has to name
  std::vector<std::vector<Panel>> rows;
  std::vector<int> lines_after;  ///< columns with a dashed line behind them (figure 4)
  double width = 1000;           ///< layout pixels the sheet may take
  double height = 640;           ///< layout pixels the drawings may take, all rows together
  double max_scale = 26;         ///< layout pixels per d, at most
  double density = 2;            ///< pixels of a PNG per layout pixel
};

/// Writes the sheet as .svg, .png or .pdf, by the ending of `file`. The same sheet gives the same
/// bytes of SVG and PNG. The file appears whole or not at all (output_file.h). Throws
/// std::runtime_error if it cannot be drawn, InputError if it cannot be written.
void write_sheet(const Sheet& sheet, const std::string& file, Overwrite overwrite);

}  // namespace metamorph::evolve
