#include "evolve/view/mesh.h"

#include <algorithm>
#include <cmath>

#include "evolve/view/colour.h"

namespace metamorph::evolve {
namespace {

const Point& at(std::span<const Point> points, core::Index i) {
  return points[static_cast<std::size_t>(i)];
}

Point middle_of(Point a, Point b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }

double area_of(Point a, Point b, Point c) {
  return 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
}

/// Tiles of a body by their colour, in the order in which colours come up.
class Tiles {
 public:
  void add(const Colour& colour, std::vector<Point> tile) {
    const auto found = std::find_if(groups_.begin(), groups_.end(),
                                    [&](const Group& group) { return group.colour == colour; });
    Group& group = found == groups_.end() ? groups_.emplace_back(Group{colour, {}}) : *found;
    group.tiles.push_back(std::move(tile));
  }
  void draw(Canvas& canvas) const {
    for (const Group& group : groups_) canvas.fill_tiles(group.tiles, group.colour);
  }

 private:
  struct Group {
    Colour colour;
    std::vector<std::vector<Point>> tiles;
  };
  std::vector<Group> groups_;
};

}  // namespace

void fill_cells(Canvas& canvas, const core::Body& body, std::span<const Point> points,
                std::span<const Colour> colours) {
  const auto colour = [&](core::Index i) { return colours[static_cast<std::size_t>(i)]; };
  Tiles tiles;
  for (const auto& [i, j, k] : body.triangles) {
    const Point a = at(points, i), b = at(points, j), c = at(points, k);
    if (colour(i) == colour(j) && colour(j) == colour(k)) {
      tiles.add(colour(i), {a, b, c});
      continue;
    }
    const Point centre{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
    tiles.add(colour(i), {a, middle_of(a, b), centre, middle_of(c, a)});
    tiles.add(colour(j), {b, middle_of(b, c), centre, middle_of(a, b)});
    tiles.add(colour(k), {c, middle_of(c, a), centre, middle_of(b, c)});
  }
  tiles.draw(canvas);
}

void fill_areas(Canvas& canvas, const core::Body& body, std::span<const Point> points,
                double unit) {
  Tiles tiles;
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    const auto& [i, j, k] = body.triangles[t];
    const Point a = at(points, i), b = at(points, j), c = at(points, k);
    tiles.add(strain_colour(area_of(a, b, c) / (unit * unit * body.rest_area[t])), {a, b, c});
  }
  tiles.draw(canvas);
}

std::vector<std::array<Point, 2>> segments_of(std::span<const std::array<core::Index, 2>> edges,
                                              std::span<const Point> points) {
  std::vector<std::array<Point, 2>> segments;
  segments.reserve(edges.size());
  for (const auto& [i, j] : edges) segments.push_back({at(points, i), at(points, j)});
  return segments;
}

}  // namespace metamorph::evolve
