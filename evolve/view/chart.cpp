#include "evolve/view/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "evolve/view/axis.h"
#include "evolve/view/canvas.h"

namespace metamorph::evolve {
namespace {

// Layout pixels.
constexpr double margin = 20, gap_across = 26, gap_down = 8;
constexpr double heading_size = 16, title_size = 12.5, text_size = 11.5;
constexpr double line_height = 17, swatch = 24;
constexpr double labels_left = 46, labels_below = 20, titles_above = 44;
constexpr double curve_width = 1.5, axis_width = 0.8, grid_width = 0.7;
constexpr double band_opacity = 0.16, edge_opacity = 0.5, edge_width = 0.5;
constexpr double least_shown = 1e-100;
constexpr double headroom = 0.02;  // of what is shown
constexpr int marks_across = 6, marks_up = 6;

/// Room for the curves of a panel.
struct Frame {
  double left = 0, top = 0, width = 0, height = 0;
  double bottom() const { return top + height; }
  double right() const { return left + width; }
};

Frame frame_size(int columns) {
  if (columns == 1) return {0, 0, 480, 280};
  if (columns == 2) return {0, 0, 340, 210};
  return {0, 0, 240, 160};
}

/// From values to layout pixels.
struct Scale {
  Frame frame;
  double most_across = 1;
  Ticks up;
  double top = 1;  ///< what the vertical axis ends at; marks may lie above

  double x(double value) const { return frame.left + value / most_across * frame.width; }
  double y(double value) const {
    return frame.bottom() - (value - up.low()) / (top - up.low()) * frame.height;
  }
};

/// Ranges [begin, end) without a gap.
std::vector<std::array<std::size_t, 2>> pieces_of(const std::vector<double>& values) {
  std::vector<std::array<std::size_t, 2>> pieces;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (i == 0 || std::isnan(values[i - 1])) pieces.push_back({i, i});
    pieces.back()[1] = i + 1;
  }
  return pieces;
}

Scale scale_of(const ChartPanel& panel, const Frame& frame, double most_across) {
  double low = 0, high = 0;
  for (const ChartCurve& curve : panel.curves) {
    for (const auto* values : {&curve.values, &curve.low, &curve.high}) {
      for (const double value : *values) {
        if (std::isnan(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  if (high - low < least_shown) high = low + 1;
  return {frame, most_across, ticks_around(low, high, marks_up), high + headroom * (high - low)};
}

void draw_band(Canvas& canvas, const ChartCurve& curve, const Scale& scale) {
  if (curve.low.empty()) return;
  Colour colour = curve.colour;
  for (const auto& [begin, end] : pieces_of(curve.values)) {
    std::vector<Point> high, low;
    for (std::size_t i = begin; i < end; ++i) {
      high.push_back({scale.x(static_cast<double>(i)), scale.y(curve.high[i])});
      low.push_back({scale.x(static_cast<double>(i)), scale.y(curve.low[i])});
    }
    std::vector<Point> outline = high;
    outline.insert(outline.end(), low.rbegin(), low.rend());
    colour.alpha = band_opacity;
    canvas.fill_polygon(outline, colour);
    // Where bands lie upon each other their edges tell them apart.
    colour.alpha = edge_opacity;
    canvas.stroke_line(high, colour, edge_width);
    canvas.stroke_line(low, colour, edge_width);
  }
}

void draw_line(Canvas& canvas, const ChartCurve& curve, const Scale& scale) {
  for (const auto& [begin, end] : pieces_of(curve.values)) {
    std::vector<Point> line;
    for (std::size_t i = begin; i < end; ++i) {
      line.push_back({scale.x(static_cast<double>(i)), scale.y(curve.values[i])});
    }
    if (line.size() == 1) {
      canvas.fill_circle(line[0], curve_width, curve.colour);
      if (curve.low.empty()) continue;
      // A band of no width would not be seen.
      const std::array ends{Point{line[0].x, scale.y(curve.low[begin])},
                            Point{line[0].x, scale.y(curve.high[begin])}};
      canvas.stroke_line(ends, curve.colour, grid_width);
      continue;
    }
    canvas.stroke_line(line, curve.colour, curve_width, curve.dashed);
  }
}

void draw_axes(Canvas& canvas, const Scale& scale, const Ticks& across, bool numbered) {
  const Frame& frame = scale.frame;
  for (const double value : scale.up.values()) {
    if (value > scale.top) continue;
    const double y = scale.y(value);
    const std::array line{Point{frame.left, y}, Point{frame.right(), y}};
    canvas.stroke_line(line, colours::grid, grid_width);
    canvas.text({frame.left - 7, y + 4}, scale.up.label(value), text_size, colours::faint_ink,
                Align::right);
  }
  const double base = scale.y(std::max(0.0, scale.up.low()));
  const std::array axis{Point{frame.left, base}, Point{frame.right(), base}};
  canvas.stroke_line(axis, colours::faint_ink, axis_width);
  for (const double value : across.values()) {
    if (value > scale.most_across) continue;
    const double x = scale.x(value);
    const std::array mark{Point{x, base}, Point{x, base + 4}};
    canvas.stroke_line(mark, colours::faint_ink, axis_width);
    if (numbered) {
      canvas.text({x, frame.bottom() + 17}, across.label(value), text_size, colours::faint_ink,
                  Align::centre);
    }
  }
}

void draw_panel(Canvas& canvas, const ChartPanel& panel, const Frame& frame, double most_across,
                bool numbered) {
  const Scale scale = scale_of(panel, frame, most_across);
  const double left = frame.left - labels_left;
  canvas.text({left, frame.top - 30}, panel.title, title_size, colours::ink, Align::left, true);
  canvas.text({left, frame.top - 15}, panel.quantity, text_size, colours::faint_ink);
  draw_axes(canvas, scale, ticks_around(0, most_across, marks_across, true), numbered);
  for (const ChartCurve& curve : panel.curves) draw_band(canvas, curve, scale);
  for (const ChartCurve& curve : panel.curves) draw_line(canvas, curve, scale);
}

double key_width(const ChartKey& key) { return swatch + 7 + text_width(key.label, text_size) + 20; }

/// [keys] Where each begins: as many in a line as there is room for.
std::vector<Point> places_of(const std::vector<ChartKey>& keys, double width) {
  std::vector<Point> places;
  double x = 0, y = 0;
  for (const ChartKey& key : keys) {
    const double needed = key_width(key);
    if (x > 0 && x + needed > width) {
      x = 0;
      y += line_height;
    }
    places.push_back({x, y});
    x += needed;
  }
  return places;
}

void draw_key(Canvas& canvas, const ChartKey& key, Point at) {
  const double y = at.y - 4;
  if (key.banded) {
    Colour band = key.colour;
    band.alpha = band_opacity;
    const std::array outline{Point{at.x, y - 5}, Point{at.x + swatch, y - 5},
                             Point{at.x + swatch, y + 5}, Point{at.x, y + 5}};
    canvas.fill_polygon(outline, band);
  }
  canvas.stroke_line(std::array{Point{at.x, y}, Point{at.x + swatch, y}}, key.colour, curve_width,
                     key.dashed);
  canvas.text({at.x + swatch + 7, at.y}, key.label, text_size, colours::ink);
}

/// The last of the values that the horizontal axis has to reach, 1 at least.
double most_across(const Chart& chart) {
  std::size_t most = 2;
  for (const ChartPanel& panel : chart.panels) {
    for (const ChartCurve& curve : panel.curves) most = std::max(most, curve.values.size());
  }
  return static_cast<double>(most - 1);
}

}  // namespace

std::string draw_chart(const Chart& chart, const std::string& file) {
  const int columns =
      std::max(1, std::min<int>(chart.columns, static_cast<int>(chart.panels.size())));
  const int rows = (static_cast<int>(chart.panels.size()) + columns - 1) / columns;
  const Frame size = frame_size(columns);
  const double panel_width = labels_left + size.width;
  double inner = columns * panel_width + (columns - 1) * gap_across;
  inner = std::max(
      {inner, text_width(chart.heading, heading_size, true), text_width(chart.remark, text_size)});
  for (const ChartKey& key : chart.keys) inner = std::max(inner, key_width(key));
  for (const std::string& note : chart.notes) inner = std::max(inner, text_width(note, text_size));

  const std::vector<Point> keys = places_of(chart.keys, inner);
  const double head = 14 + line_height + (chart.remark.empty() ? 0 : line_height) +
                      (keys.empty() ? 0 : keys.back().y + line_height + 4);
  const double panel_height = titles_above + size.height + labels_below;
  const double foot = line_height + line_height * static_cast<double>(chart.notes.size());
  const double width = 2 * margin + inner;
  const double height = 2 * margin + head + rows * panel_height + (rows - 1) * gap_down + foot - 4;
  Canvas canvas(file, width, height);

  double y = margin + 12;
  canvas.text({margin, y}, chart.heading, heading_size, colours::ink, Align::left, true);
  y += line_height + 2;
  if (!chart.remark.empty()) {
    canvas.text({margin, y}, chart.remark, text_size, colours::faint_ink);
    y += line_height + 4;
  }
  for (std::size_t k = 0; k < keys.size(); ++k) {
    draw_key(canvas, chart.keys[k], {margin + keys[k].x, y + keys[k].y});
  }

  const double most = most_across(chart);
  const int count = static_cast<int>(chart.panels.size());
  for (int p = 0; p < count; ++p) {
    Frame frame = size;
    frame.left = margin + labels_left + (p % columns) * (panel_width + gap_across);
    frame.top = margin + head + titles_above + (p / columns) * (panel_height + gap_down);
    const bool lowest = p + columns >= count;
    draw_panel(canvas, chart.panels[static_cast<std::size_t>(p)], frame, most, lowest);
    if (lowest) {
      canvas.text({frame.left + frame.width / 2, frame.bottom() + labels_below + 14}, chart.across,
                  text_size, colours::faint_ink, Align::centre);
    }
  }
  y = height - margin - line_height * static_cast<double>(chart.notes.size()) + 14;
  for (const std::string& note : chart.notes) {
    canvas.text({margin, y}, note, text_size, colours::faint_ink);
    y += line_height;
  }
  return canvas.finish();
}

}  // namespace metamorph::evolve
