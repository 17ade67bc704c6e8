#include "evolve/view/field.h"

#include <algorithm>
#include <cmath>

#include "evolve/view/axis.h"
#include "evolve/view/legend.h"

namespace metamorph::evolve {
namespace {

// Layout pixels.
constexpr double margin = 20, side = 400, labels_left = 52, labels_below = 40, legend_height = 44;
constexpr double heading_size = 16, text_size = 11.5, line_height = 17;
constexpr double point_radius = 2.6;
constexpr int most_marks = 8;

/// From values to layout pixels.
struct Scale {
  Point corner;  ///< of the square on the page, below left
  Point low, high;

  Point operator()(double x, double y) const {
    return {corner.x + side * (x - low.x) / (high.x - low.x),
            corner.y - side * (y - low.y) / (high.y - low.y)};
  }
  Point operator()(Point p) const { return (*this)(p.x, p.y); }
};

std::vector<double> marks_between(const Ticks& ticks, double low, double high) {
  std::vector<double> marks;
  const double slack = 1e-9 * (high - low);
  for (const double mark : ticks.values()) {
    if (mark >= low - slack && mark <= high + slack) marks.push_back(mark);
  }
  return marks;
}

void draw_axes(Canvas& canvas, const Field& field, const Scale& scale) {
  const Ticks across = ticks_around(field.low.x, field.high.x, most_marks);
  const Ticks up = ticks_around(field.low.y, field.high.y, most_marks);
  for (const double x : marks_between(across, field.low.x, field.high.x)) {
    const Point p = scale(x, field.low.y);
    canvas.stroke_line(std::array{p, Point{p.x, p.y - side}}, colours::grid, 0.7);
    canvas.text({p.x, p.y + 16}, across.label(x), text_size, colours::faint_ink, Align::centre);
  }
  for (const double y : marks_between(up, field.low.y, field.high.y)) {
    const Point p = scale(field.low.x, y);
    canvas.stroke_line(std::array{p, Point{p.x + side, p.y}}, colours::grid, 0.7);
    canvas.text({p.x - 7, p.y + 4}, up.label(y), text_size, colours::faint_ink, Align::right);
  }
  const Point middle = scale((field.low.x + field.high.x) / 2, field.low.y);
  canvas.text({middle.x, middle.y + 34}, field.across, text_size, colours::ink, Align::centre);
}

void draw_points(Canvas& canvas, const Field::Points& some, const Scale& scale) {
  if (some.steps) {
    std::vector<Point> points = some.points;
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return a.x < b.x; });
    std::vector<Point> line{scale(scale.low.x, points.front().y)};
    for (std::size_t i = 0; i < points.size(); ++i) {
      line.push_back(scale(points[i]));
      const double next = i + 1 < points.size() ? points[i + 1].y : scale.low.y;
      line.push_back(scale(points[i].x, next));
    }
    canvas.stroke_line(line, some.colour, 1.2);
  }
  for (const Point& p : some.points) canvas.fill_circle(scale(p), point_radius, some.colour);
}

}  // namespace

std::string draw_field(const Field& field, const std::string& file, double density) {
  const double words = std::max(
      {side, text_width(field.heading, heading_size, true), text_width(field.remark, text_size)});
  const double width = 2 * margin + labels_left + words;
  const double head = 2 * line_height + 8 + 22;
  const double height = 2 * margin + head + side + labels_below + legend_height;
  Canvas canvas(file, width, height, density);
  canvas.text({margin, margin + 12}, field.heading, heading_size, colours::ink, Align::left, true);
  canvas.text({margin, margin + 12 + line_height + 2}, field.remark, text_size, colours::faint_ink);
  const Scale scale{{margin + labels_left, margin + head + side}, field.low, field.high};
  canvas.text({margin, margin + head - 10}, field.up, text_size, colours::ink);
  draw_axes(canvas, field, scale);
  for (const Field::Tile& tile : field.tiles) {
    canvas.fill_polygon(std::array{scale(tile.left, tile.bottom), scale(tile.right, tile.bottom),
                                   scale(tile.right, tile.top), scale(tile.left, tile.top)},
                        tile.colour);
  }
  for (const Field::Points& some : field.points) draw_points(canvas, some, scale);
  const std::array border{scale(field.low), scale(field.high.x, field.low.y), scale(field.high),
                          scale(field.low.x, field.high.y), scale(field.low)};
  canvas.stroke_line(border, colours::faint_ink, 0.8);
  draw_strip(canvas, {scale.corner.x, height - margin - 8}, field.strip, text_size,
             field.strip_colour);
  return canvas.finish();
}

}  // namespace metamorph::evolve
