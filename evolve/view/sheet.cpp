#include "evolve/view/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "evolve/view/legend.h"

namespace metamorph::evolve {
namespace {

constexpr double margin = 28;  // around the sheet, layout pixels
constexpr double gap = 30;     // between panels
constexpr double heading_size = 19;
constexpr double title_size = 14;
constexpr double text_size = 12;
constexpr double line_height = 18;
constexpr double bar_length = 5;  // d

struct Layout {
  std::vector<double> column_width;  // layout pixels
  std::vector<double> row_height;    // drawing alone
  std::vector<double> row_title;     // room above the drawings of a row
  std::vector<double> row_caption;   // and below
  double scale = 1;                  // layout pixels per d
  double head = 0, foot = 0;
  double width = 0, height = 0;
};

double label_width(const Panel& panel) {
  return std::max(text_width(panel.title, title_size, true), text_width(panel.caption, text_size));
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

Layout lay_out(const Sheet& sheet) {
  Layout layout;
  std::size_t columns = 0;
  for (const auto& row : sheet.rows) columns = std::max(columns, row.size());
  std::vector<double> extent(columns, 0.0);  // d
  for (const auto& row : sheet.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      extent[c] = std::max(extent[c], row[c].box.width());
    }
  }
  const double gaps = gap * static_cast<double>(columns > 0 ? columns - 1 : 0);
  const double room = sheet.width - 2 * margin - gaps;
  double tall = 0;  // d
  for (const auto& row : sheet.rows) {
    double height = 0;
    for (const Panel& panel : row) height = std::max(height, panel.box.height());
    tall += height;
  }
  const double fitting =
      std::min(room / std::max(sum(extent), 1e-9), sheet.height / std::max(tall, 1e-9));
  layout.scale = std::clamp(fitting, 0.5, sheet.max_scale);

  for (const double e : extent) layout.column_width.push_back(e * layout.scale);
  for (const auto& row : sheet.rows) {
    double height = 0, title = 0, caption = 0;
    for (std::size_t c = 0; c < row.size(); ++c) {
      height = std::max(height, row[c].box.height() * layout.scale);
      if (!row[c].title.empty()) title = line_height + 8;
      if (!row[c].caption.empty()) caption = line_height + 4;
      layout.column_width[c] = std::max(layout.column_width[c], label_width(row[c]));
    }
    layout.row_height.push_back(height);
    layout.row_title.push_back(title);
    layout.row_caption.push_back(caption);
  }
  layout.head = (sheet.heading.empty() ? 0 : line_height + 8) +
                (sheet.remark.empty() ? 0 : line_height) +
                (sheet.heading.empty() && sheet.remark.empty() ? 0 : 14);
  layout.foot = 46;
  const double least = std::max(
      {text_width(sheet.heading, heading_size, true), text_width(sheet.remark, text_size), 420.0});
  layout.width = 2 * margin + std::max(sum(layout.column_width) + gaps, least);
  layout.height = 2 * margin + layout.head + sum(layout.row_height) + sum(layout.row_title) +
                  sum(layout.row_caption) +
                  gap * static_cast<double>(std::max<std::size_t>(sheet.rows.size(), 1) - 1) +
                  layout.foot;
  return layout;
}

void draw_scale_bar(Canvas& canvas, Point right_end, double scale) {
  const double left = right_end.x - bar_length * scale;
  const std::array bar{Point{left, right_end.y}, right_end};
  canvas.stroke_line(bar, colours::faint_ink, 2);
  for (const Point& end : bar) {
    const std::array tick{Point{end.x, end.y - 4}, Point{end.x, end.y + 4}};
    canvas.stroke_line(tick, colours::faint_ink, 2);
  }
  canvas.text({(left + right_end.x) / 2, right_end.y - 8}, "5 d", text_size, colours::faint_ink,
              Align::centre);
}

void draw_legend(Canvas& canvas, const Sheet& sheet, Point at) {
  switch (sheet.legend) {
    case Legend::none:
      break;
    case Legend::birth:
      draw_discs(canvas, at, birth_discs(sheet.stages), text_size);
      break;
    case Legend::strain:
      draw_strip(canvas, at, {"contracted", "at rest", "expanded"}, text_size,
                 [](double t) { return strain_colour(0.6 + 0.8 * t); });
      break;
    case Legend::phase:
      draw_strip(canvas, at, {"\u2212\u03c0", "phase 0", "\u03c0"}, text_size,
                 [](double t) { return phase_colour(std::numbers::pi * (2 * t - 1)); });
      break;
  }
}

void draw_head(Canvas& canvas, const Sheet& sheet) {
  double y = margin + 14;
  if (!sheet.heading.empty()) {
    canvas.text({margin, y}, sheet.heading, heading_size, colours::ink, Align::left, true);
    y += line_height + 5;
  }
  if (!sheet.remark.empty()) {
    canvas.text({margin, y}, sheet.remark, text_size, colours::faint_ink);
  }
}

// Middles of the box on the middle of its place; the mapping of d to layout pixels.
void draw_panel(Canvas& canvas, const Panel& panel, Point centre, const Layout& layout,
                std::size_t row) {
  const double half = layout.row_height[row] / 2;
  if (!panel.title.empty()) {
    canvas.text({centre.x, centre.y - half - 10}, panel.title, title_size, colours::ink,
                Align::centre, true);
  }
  if (!panel.caption.empty()) {
    canvas.text({centre.x, centre.y + half + line_height}, panel.caption, text_size,
                colours::faint_ink, Align::centre);
  }
  if (panel.box.empty || !panel.draw) return;
  const double scale = layout.scale;
  canvas.look_at({centre.x - scale * (panel.box.left + panel.box.right) / 2,
                  centre.y + scale * (panel.box.bottom + panel.box.top) / 2},
                 scale);
  panel.draw(canvas, 1 / scale);
  canvas.look_at_layout();
}

}  // namespace

void write_sheet(const Sheet& sheet, const std::string& file, Overwrite overwrite) {
  const Layout layout = lay_out(sheet);
  Canvas canvas(file, layout.width, layout.height, sheet.density);
  draw_head(canvas, sheet);

  const double gaps =
      gap * static_cast<double>(std::max<std::size_t>(layout.column_width.size(), 1) - 1);
  const double first = (layout.width - sum(layout.column_width) - gaps) / 2;
  double y = margin + layout.head;
  for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
    y += layout.row_title[r];
    double x = first;
    for (std::size_t c = 0; c < sheet.rows[r].size(); ++c) {
      const Point centre{x + layout.column_width[c] / 2, y + layout.row_height[r] / 2};
      draw_panel(canvas, sheet.rows[r][c], centre, layout, r);
      x += layout.column_width[c] + gap;
    }
    y += layout.row_height[r] + layout.row_caption[r] + gap;
  }

  for (const int column : sheet.lines_after) {
    double x = first - gap / 2;
    for (int c = 0; c <= column; ++c) {
      x += layout.column_width[static_cast<std::size_t>(c)] + gap;
    }
    const std::array line{Point{x, margin + layout.head}, Point{x, y - gap}};
    canvas.stroke_line(line, colours::faint_ink, 1.2, true);
  }

  const double foot = layout.height - margin;
  draw_legend(canvas, sheet, {margin, foot});
  draw_scale_bar(canvas, {layout.width - margin, foot}, layout.scale);
  write_file(file, canvas.finish(), overwrite);
}

}  // namespace metamorph::evolve
