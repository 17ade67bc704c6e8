#include "evolve/view/panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "evolve/view/mesh.h"

namespace metamorph::evolve {
namespace {

constexpr double cell_radius = 0.5;  // d
constexpr double body_margin = 0.25;

Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point operator*(double s, Point p) { return {s * p.x, s * p.y}; }

using Points = std::vector<Point>;
using Segments = std::vector<std::array<Point, 2>>;

Points points_of(std::span<const double> x, std::span<const double> y) {
  Points points(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) points[i] = {x[i], y[i]};
  return points;
}

void draw_mesh(Canvas& canvas, const core::Body& body, const Points& points, double pixel,
               const Colour& springs, bool nodes) {
  canvas.stroke_lines(segments_of(body.springs, points), springs, std::max(0.035, 0.35 * pixel));
  canvas.stroke_lines(segments_of(core::outline_of(body.triangles), points), colours::ink,
                      std::max(0.11, 0.9 * pixel));
  if (!nodes) return;
  for (const Point& p : points) {
    canvas.fill_circle(p, std::max(0.085, 0.7 * pixel), colours::ink);
  }
}

Box box_of(const Points& points, double margin) {
  Box box;
  for (const Point& p : points) box.include(p, margin);
  return box;
}

// An arrow of length 3 beginning where the body ends in that direction.
Points arrow_for(const Points& points, Point direction) {
  const double length = std::hypot(direction.x, direction.y);
  const Point along = (1 / length) * direction, across{-along.y, along.x};
  Point centre;
  for (const Point& p : points) centre = centre + (1.0 / static_cast<double>(points.size())) * p;
  double reach = 0;
  for (const Point& p : points) {
    // What lies beside the arrow's path does not push it away.
    const Point from{p.x - centre.x, p.y - centre.y};
    if (std::abs(from.x * across.x + from.y * across.y) < 1.2) {
      reach = std::max(reach, from.x * along.x + from.y * along.y);
    }
  }
  const auto place = [&](double forward, double sideways) {
    return centre + (reach + 0.8 + forward) * along + sideways * across;
  };
  return {place(0, 0.18),    place(1.8, 0.18),  place(1.8, 0.65), place(3, 0),
          place(1.8, -0.65), place(1.8, -0.18), place(0, -0.18)};
}

void draw_ground(Canvas& canvas, const Box& box, double height, double pixel) {
  const double width = std::max(0.06, 0.8 * pixel);
  const std::array line{Point{box.left, height}, Point{box.right, height}};
  canvas.stroke_line(line, colours::ground, width);
  Segments hatches;
  for (double x = box.left + 0.6; x <= box.right; x += 0.9) {
    hatches.push_back({Point{x, height}, Point{x - 0.5, height - 0.5}});
  }
  canvas.stroke_lines(hatches, colours::ground, 0.6 * width);
}

}  // namespace

void Box::include(Point point, double margin) {
  if (empty) {
    *this = {point.x - margin, point.y - margin, point.x + margin, point.y + margin, false};
    return;
  }
  left = std::min(left, point.x - margin);
  right = std::max(right, point.x + margin);
  bottom = std::min(bottom, point.y - margin);
  top = std::max(top, point.y + margin);
}

int birth_stage(int birth_step, std::span<const int> starts) {
  return static_cast<int>(std::upper_bound(starts.begin(), starts.end(), birth_step) -
                          starts.begin());
}

BirthStages birth_stages(const core::Body& body, const core::Embryo& embryo,
                         std::span<const int> starts) {
  BirthStages stages;
  stages.reserve(body.cell.size());
  for (const core::Index cell : body.cell) {
    stages.push_back(birth_stage(embryo.birth_step[static_cast<std::size_t>(cell)], starts));
  }
  return stages;
}

Panel embryo_panel(const core::Embryo& embryo, std::span<const int> starts) {
  Panel panel;
  const Points points = points_of(embryo.x, embryo.y);
  panel.box = box_of(points, cell_radius + 0.1);
  std::vector<Colour> of_birth;
  for (const int step : embryo.birth_step) {
    of_birth.push_back(birth_colour(birth_stage(step, starts)));
  }
  panel.draw = [embryo, points, of_birth](Canvas& canvas, double pixel) {
    const double line = std::max(0.05, 0.5 * pixel);
    for (std::size_t i = 0; i < points.size(); ++i) {
      canvas.fill_circle(points[i], cell_radius, pale(of_birth[i]));
      canvas.stroke_circle(points[i], cell_radius - line / 2, mix(of_birth[i], colours::ink, 0.35),
                           line);
    }
    Colour links = colours::ink;
    links.alpha = 0.55;
    canvas.stroke_lines(segments_of(embryo.links, points), links, std::max(0.045, 0.4 * pixel));
  };
  return panel;
}

namespace {

struct CellStyle {
  std::vector<Colour> colours;
  double springs = 0.5;  ///< opacity
  bool nodes = true;
};

/// A body at rest.
Panel resting_panel(const core::Body& body, const CellStyle& style, std::optional<Point> direction,
                    bool ground) {
  Panel panel;
  const Points points = points_of(body.x, body.y);
  panel.box = box_of(points, body_margin);
  if (points.empty()) return panel;
  const double floor = panel.box.bottom + body_margin;
  Points arrow;
  if (direction && std::hypot(direction->x, direction->y) > 0) {
    arrow = arrow_for(points, *direction);
    for (const Point& p : arrow) panel.box.include(p);
  }
  if (ground) panel.box.include({panel.box.left, floor - 0.6});
  const Box box = panel.box;
  panel.draw = [=](Canvas& canvas, double pixel) {
    if (ground) draw_ground(canvas, box, floor, pixel);
    fill_cells(canvas, body, points, style.colours);
    Colour springs = colours::ink;
    springs.alpha = style.springs;
    draw_mesh(canvas, body, points, pixel, springs, style.nodes);
    if (!arrow.empty()) canvas.fill_polygon(arrow, colours::ink);
  };
  return panel;
}

}  // namespace

Panel body_panel(const core::Body& body, const BirthStages& born, std::optional<Point> direction,
                 bool ground) {
  std::vector<Colour> colours(body.x.size(), pale(birth_colour(0)));
  for (std::size_t i = 0; i < born.size(); ++i) colours[i] = pale(birth_colour(born[i]));
  return resting_panel(body, {colours}, direction, ground);
}

Panel motion_panel(const core::Body& body, std::span<const double> x, std::span<const double> y,
                   bool ground) {
  Panel panel;
  const Points points = points_of(x, y);
  panel.box = box_of(points, body_margin);
  if (ground) panel.box.include({panel.box.left, -0.6});
  const Box box = panel.box;
  panel.draw = [=](Canvas& canvas, double pixel) {
    if (ground) draw_ground(canvas, box, 0, pixel);
    fill_areas(canvas, body, points);
    Colour springs = colours::ink;
    springs.alpha = 0.25;
    draw_mesh(canvas, body, points, pixel, springs, false);
  };
  return panel;
}

Panel phase_panel(const core::Body& body, std::optional<Point> direction, bool ground) {
  std::vector<Colour> colours;
  for (const double phase : body.phase) colours.push_back(phase_colour(phase));
  return resting_panel(body, {colours, 0.3, false}, direction, ground);
}

}  // namespace metamorph::evolve
