#include "evolve/view/zoo.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace metamorph::evolve {
namespace {

constexpr double sheet_width = 1200;  // layout pixels
constexpr double block_height = 640;  // layout pixels, at most

std::string place_of(const Stage& stage) {
  return fmt::format("{} {}", stage.ground ? "on" : "in", stage.scene);
}

/// "larva in water", if that is what a row of stages has in common.
std::string common_name(std::span<const Exhibit> exhibits, std::size_t row) {
  std::string name;
  for (const Exhibit& exhibit : exhibits) {
    if (row >= exhibit.stages.size()) return "";
    const Stage& stage = exhibit.stages[row];
    const std::string own = fmt::format("{} {}", stage.title, place_of(stage));
    if (!name.empty() && own != name) return "";
    name = own;
  }
  return name;
}

std::string caption_of(const Stage& stage, bool moving, bool tells_place) {
  const core::Status status = stage.outcome ? stage.outcome->status : core::Status::ok;
  if (stage.body.node_count() == 0) {
    if (status == core::Status::empty) return "no cell alive";
    return core::is_failure(status) ? fmt::format("no body ({})", core::name(status)) : "no body";
  }
  if (!moving || !stage.outcome) return "";
  std::string caption = fmt::format("{:.1f} d", stage.outcome->distance);
  if (tells_place) caption = fmt::format("{} {}", caption, place_of(stage));
  if (status != core::Status::ok) caption += fmt::format(" ({})", core::name(status));
  return caption;
}

Panel panel_of(const Exhibit& exhibit, const Stage& stage, const ZooStyle& style) {
  const std::optional<Point> direction = style.moving ? direction_of(stage) : std::nullopt;
  const bool ground = style.moving && stage.ground;
  if (style.colours == CellColours::phase) return phase_panel(stage.body, direction, ground);
  // A body from a file has no embryo, and its cells no births.
  const BirthStages born = stage.embryo.cell_count() == 0
                               ? BirthStages{}
                               : birth_stages(stage.body, stage.embryo, exhibit.starts);
  return body_panel(stage.body, born, direction, ground);
}

/// Bodies of a row that stand on the ground stand on one line.
void stand_in_line(std::vector<Panel>& row) {
  double tallest = 0;
  for (const Panel& panel : row) tallest = std::max(tallest, panel.box.height());
  for (Panel& panel : row) {
    if (!panel.box.empty) panel.box.top = panel.box.bottom + tallest;
  }
}

}  // namespace

Sheet zoo_sheet(std::span<const Exhibit> exhibits, const ZooStyle& style) {
  Sheet sheet;
  sheet.legend = style.colours == CellColours::phase ? Legend::phase : Legend::birth;
  sheet.stages = 1;
  std::size_t rows = 0;
  for (const Exhibit& exhibit : exhibits) {
    rows = std::max(rows, exhibit.stages.size());
    sheet.stages = std::max(sheet.stages, static_cast<int>(exhibit.starts.size()) + 1);
  }
  std::vector<std::string> names;
  bool all_named = true;
  for (std::size_t r = 0; r < rows; ++r) {
    names.push_back(common_name(exhibits, r));
    all_named = all_named && !names.back().empty();
  }
  if (all_named && rows > 0) {
    sheet.remark = fmt::format("{}{}", rows > 1 ? "from above: " : "", fmt::join(names, ", "));
  }

  const std::size_t most = static_cast<std::size_t>(std::max(1, style.columns));
  const std::size_t blocks = (exhibits.size() + most - 1) / most;
  const std::size_t columns = blocks == 0 ? 0 : (exhibits.size() + blocks - 1) / blocks;
  for (std::size_t first = 0; first < exhibits.size(); first += columns) {
    const auto block = exhibits.subspan(first, std::min(columns, exhibits.size() - first));
    for (std::size_t r = 0; r < rows; ++r) {
      std::vector<Panel> row;
      bool grounded = style.moving;
      for (const Exhibit& exhibit : block) {
        if (r >= exhibit.stages.size()) {
          row.emplace_back();
          continue;
        }
        const Stage& stage = exhibit.stages[r];
        grounded = grounded && stage.ground;
        Panel panel = panel_of(exhibit, stage, style);
        panel.caption = caption_of(stage, style.moving, !all_named);
        if (r == 0) panel.title = exhibit.title;
        row.push_back(std::move(panel));
      }
      if (grounded) stand_in_line(row);
      sheet.rows.push_back(std::move(row));
    }
  }
  sheet.width = sheet_width;
  sheet.height = block_height * static_cast<double>(blocks);
  return sheet;
}

}  // namespace metamorph::evolve
