#include "evolve/view/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace metamorph::evolve {
namespace {

std::string caption_of(const Stage& stage) {
  if (stage.body.node_count() == 0) return "no body";
  std::string caption =
      fmt::format("{} nodes, {} springs", stage.body.node_count(), stage.body.springs.size());
  if (stage.outcome) {
    caption += fmt::format("; {:.2f} d {} {}", stage.outcome->distance, stage.ground ? "on" : "in",
                           stage.scene);
    if (stage.outcome->status != core::Status::ok) {
      caption += fmt::format(" ({})", core::name(stage.outcome->status));
    }
  }
  return caption;
}

/// An empty sheet whose legend explains the colours of all stages.
Sheet birth_sheet(std::span<const int> starts) {
  Sheet sheet;
  sheet.legend = Legend::birth;
  sheet.stages = static_cast<int>(starts.size()) + 1;
  return sheet;
}

}  // namespace

std::optional<Point> direction_of(const Stage& stage) {
  if (!stage.outcome || stage.outcome->distance <= 0) return std::nullopt;
  const auto& [x, y] = stage.outcome->mean_position;
  return stage.ground ? Point{x, 0} : Point{x, y};
}

Sheet champion_sheet(std::span<const Stage> stages, std::span<const int> starts) {
  Sheet sheet = birth_sheet(starts);
  sheet.rows.resize(2);
  for (const Stage& stage : stages) {
    Panel embryo = embryo_panel(stage.embryo, starts);
    embryo.title = fmt::format("{}, step {}", stage.title, stage.embryo.step);
    embryo.caption = fmt::format("{} cells", stage.embryo.cell_count());
    sheet.rows[0].push_back(std::move(embryo));
    const BirthStages born = birth_stages(stage.body, stage.embryo, starts);
    Panel body = body_panel(stage.body, born, direction_of(stage), stage.ground);
    body.caption = caption_of(stage);
    sheet.rows[1].push_back(std::move(body));
  }
  return sheet;
}

Sheet development_sheet(std::span<const core::Embryo> embryos, std::span<const core::Body> bodies,
                        std::span<const int> starts) {
  Sheet sheet = birth_sheet(starts);
  sheet.rows.resize(2);
  for (std::size_t i = 0; i < embryos.size(); ++i) {
    Panel embryo = embryo_panel(embryos[i], starts);
    embryo.title = fmt::format("t = {}", embryos[i].step);
    sheet.rows[0].push_back(std::move(embryo));
    sheet.rows[1].push_back(body_panel(bodies[i], birth_stages(bodies[i], embryos[i], starts)));
  }
  for (const int start : starts) {
    const auto after = std::find_if(embryos.begin(), embryos.end(),
                                    [&](const core::Embryo& e) { return e.step > start; });
    if (after == embryos.begin() || after == embryos.end()) continue;
    sheet.lines_after.push_back(static_cast<int>(after - embryos.begin()) - 1);
  }
  return sheet;
}

Sheet motion_sheet(const core::Body& body, std::span<const Snapshot> snapshots, bool ground,
                   int columns) {
  Sheet sheet;
  sheet.legend = Legend::strain;
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) == 0) sheet.rows.emplace_back();
    Panel panel = motion_panel(body, snapshots[i].x, snapshots[i].y, ground);
    panel.caption = fmt::format("t = {:.0f}", snapshots[i].time / core::paper_step);
    sheet.rows.back().push_back(std::move(panel));
  }
  return sheet;
}

Sheet phase_sheet(std::span<const Stage> stages) {
  Sheet sheet;
  sheet.legend = Legend::phase;
  sheet.rows.resize(1);
  for (const Stage& stage : stages) {
    Panel panel = phase_panel(stage.body);
    panel.title = stage.title;
    sheet.rows[0].push_back(std::move(panel));
  }
  return sheet;
}

}  // namespace metamorph::evolve
