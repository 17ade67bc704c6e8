#include "evolve/film/draw_life.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "evolve/view/mesh.h"

namespace metamorph::evolve {
namespace {

using Points = std::vector<Point>;

constexpr double cell_radius = 0.5;  // d
constexpr double lattice = 5;        // d between the marks that stand still
constexpr double ground_label_size = 11;
constexpr Colour of_reference{0.0, 0.45, 0.33, 0.9};

/// From d, turned, to layout pixels.
struct Lens {
  Point target;  ///< d
  Point middle;  ///< of the place, layout pixels
  double scale;

  Point operator()(Point p) const {
    return {middle.x + scale * (p.x - target.x), middle.y - scale * (p.y - target.y)};
  }
};

Lens lens_of(const Place& place, Point target, double scale) {
  return {target, {place.left + place.width / 2, place.top + place.height / 2}, scale};
}

Point between(Point a, Point b, double t) {
  return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t)};
}

double eased(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

Colour faded(Colour colour, double alpha) {
  colour.alpha *= std::clamp(alpha, 0.0, 1.0);
  return colour;
}

Points points_at(const Track& track, int frame, const View& view, const Lens& lens) {
  const auto& x = track.x[static_cast<std::size_t>(frame)];
  const auto& y = track.y[static_cast<std::size_t>(frame)];
  Points points(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) points[i] = lens(view.turned(x[i], y[i]));
  return points;
}

void draw_outline(Canvas& canvas, const std::vector<std::array<int, 2>>& edges,
                  const Points& points, const Colour& colour, double width) {
  canvas.stroke_lines(segments_of(edges, points), colour, width);
}

void draw_body(Canvas& canvas, const Actor& actor, std::size_t number, const Points& points,
               int frame, const LifeStyle& style) {
  const Motion& motion = actor.life.motions[number];
  std::vector<Colour> colours;
  if (style.colour == ColourKind::area) {
    fill_areas(canvas, motion.body, points, style.scale);
  } else {
    colours = node_colours(motion, frame, style.colour, style.scales);
    fill_cells(canvas, motion.body, points, colours);
  }
  canvas.stroke_lines(segments_of(motion.body.springs, points), faded(colours::ink, 0.25),
                      std::max(0.04 * style.scale, 0.4));
  draw_outline(canvas, actor.edges[number], points, colours::ink,
               std::max(0.12 * style.scale, 0.9));
  if (style.colour != ColourKind::contact) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (colours[i] == contact_colour(Contact::none)) continue;
    canvas.fill_circle(points[i], std::max(0.25 * style.scale, 2.0), colours[i]);
  }
}

/// A line along the ground with hatches, and how far it is from the start, which stand still.
void draw_ground(Canvas& canvas, const Place& place, const View& view, const Lens& lens,
                 double alpha) {
  const double reach = std::hypot(place.width, place.height) / lens.scale;
  // Where the camera looks, along the ground.
  const double here = view.cosine * lens.target.x + view.sine * lens.target.y;
  const double low = here - reach, high = here + reach;
  const Colour colour = faded(colours::ground, alpha);
  const double width = std::max(0.08 * lens.scale, 1.2);
  canvas.stroke_line(std::array{lens(view.turned(low, 0)), lens(view.turned(high, 0))}, colour,
                     width);
  const double start = view.centres.front().x;
  for (double s = std::floor(low); s <= high; s += 1) {
    canvas.stroke_line(std::array{lens(view.turned(s, 0)), lens(view.turned(s - 0.45, -0.45))},
                       colour, 0.5 * width);
  }
  const double step = lens.scale * lattice < 45 ? 4 * lattice : lattice;
  for (double d = step * std::floor((low - start) / step); d <= high - start; d += step) {
    canvas.stroke_line(
        std::array{lens(view.turned(start + d, 0)), lens(view.turned(start + d, -0.75))}, colour,
        width);
    const Point label = lens(view.turned(start + d, -0.75));
    canvas.text({label.x, label.y + ground_label_size + 2}, fmt::format("{:.0f}", d),
                ground_label_size, faded(colours::faint_ink, alpha), Align::centre);
  }
}

/// Dots that stand still, or nothing would show that a camera moves.
void draw_lattice(Canvas& canvas, const Place& place, const Lens& lens, double alpha) {
  const double wide = place.width / 2 / lens.scale, tall = place.height / 2 / lens.scale;
  const double step = lens.scale * lattice < 25 ? 4 * lattice : lattice;
  const Colour colour = faded(colours::faint_ink, 0.5 * alpha);
  for (double x = step * std::ceil((lens.target.x - wide) / step); x <= lens.target.x + wide;
       x += step) {
    for (double y = step * std::ceil((lens.target.y - tall) / step); y <= lens.target.y + tall;
         y += step) {
      canvas.fill_circle(lens({x, y}), 1.3, colour);
    }
  }
}

void draw_surroundings(Canvas& canvas, const Place& place, const Motion& motion, const View& view,
                       const Lens& lens, double alpha) {
  if (core::shows_ground(motion.scene)) {
    draw_ground(canvas, place, view, lens, alpha);
  } else {
    draw_lattice(canvas, place, lens, alpha);
  }
}

void draw_trail(Canvas& canvas, const View& view, int frame, const Lens& lens) {
  Points trail;
  for (std::size_t f = 0; f <= static_cast<std::size_t>(frame); ++f) {
    const Point p = lens(view.turned(view.centres[f].x, view.centres[f].y));
    // What is nearer than a pixel adds nothing but time.
    if (trail.empty() || std::hypot(p.x - trail.back().x, p.y - trail.back().y) > 1) {
      trail.push_back(p);
    }
  }
  if (trail.size() < 2) return;
  canvas.stroke_line(trail, faded(colours::faint_ink, 0.75), 1.4);
  canvas.fill_circle(trail.front(), 2.4, colours::faint_ink);
}

void draw_motion(Canvas& canvas, const Place& place, const Actor& actor, const Moment& moment,
                 const LifeStyle& style) {
  const auto number = static_cast<std::size_t>(moment.shot.motion);
  const Motion& motion = actor.life.motions[number];
  const View& view = actor.views[number];
  const int frame = frame_at(motion, moment);
  const Lens lens = lens_of(place, view.targets[static_cast<std::size_t>(frame)], style.scale);
  draw_surroundings(canvas, place, motion, view, lens, 1);
  draw_trail(canvas, view, frame, lens);
  const auto ghost = [&](const Track& track, const Colour& colour, double width) {
    if (track.frame_count() == 0) return;
    const int shown = std::min(frame, track.frame_count() - 1);
    draw_outline(canvas, actor.edges[number], points_at(track, shown, view, lens), colour, width);
  };
  for (const Track& copy : motion.copies) {
    ghost(copy, faded(colours::ink, 0.35), std::max(0.1 * style.scale, 0.8));
  }
  draw_body(canvas, actor, number, points_at(motion.track, frame, view, lens), frame, style);
  if (motion.reference) {
    ghost(*motion.reference, of_reference, std::max(0.06 * style.scale, 1.0));
  }
}

void draw_cell(Canvas& canvas, Point p, const Colour& colour, double radius) {
  const double line = std::max(0.05 * radius / cell_radius, 0.5);
  canvas.fill_circle(p, radius, colour);
  canvas.stroke_circle(p, std::max(radius - line / 2, 0.1),
                       faded(mix(colour, colours::ink, 0.35), colour.alpha), line);
}

void draw_deaths(Canvas& canvas, const Actor& actor, int step, const Lens& lens,
                 const LifeStyle& style) {
  for (const Death& death : actor.deaths) {
    const double age = (step - death.step) / style.fade_steps;
    if (age < 0 || age >= 1) continue;
    const Point p = lens(death.place);
    const double radius = cell_radius * style.scale * (1 - 0.5 * age);
    canvas.fill_circle(p, radius, faded(birth_colour(death.stage), 0.35 * (1 - age)));
    const Colour ink = faded(colours::ink, 1 - age);
    const double arm = 0.55 * radius;
    canvas.stroke_line(std::array{Point{p.x - arm, p.y - arm}, Point{p.x + arm, p.y + arm}}, ink,
                       1.4);
    canvas.stroke_line(std::array{Point{p.x - arm, p.y + arm}, Point{p.x + arm, p.y - arm}}, ink,
                       1.4);
  }
}

void draw_embryo(Canvas& canvas, const Place& place, const Actor& actor, int step,
                 const LifeStyle& style) {
  const core::Embryo& embryo = actor.life.embryos[static_cast<std::size_t>(step)];
  const Point target = actor.development.targets[static_cast<std::size_t>(step)];
  const Lens lens = lens_of(place, target, style.scale);
  draw_lattice(canvas, place, lens, 1);
  draw_deaths(canvas, actor, step, lens, style);
  const std::vector<Colour> colours =
      cell_colours(embryo, actor.life.starts, style.colour, style.scales);
  Points points;
  for (std::size_t i = 0; i < embryo.x.size(); ++i)
    points.push_back(lens({embryo.x[i], embryo.y[i]}));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double age = (step - embryo.birth_step[i]) / style.fade_steps;
    // The first cell has been there before the film.
    const bool newborn = age < 1 && embryo.mother[i] >= 0;
    const double grown = newborn ? 0.55 + 0.45 * eased(age) : 1;
    draw_cell(canvas, points[i],
              newborn ? mix(colours::paper, colours[i], 0.3 + 0.7 * age) : colours[i],
              cell_radius * style.scale * grown);
  }
  canvas.stroke_lines(segments_of(embryo.links, points), faded(colours::ink, 0.5),
                      std::max(0.045 * style.scale, 0.5));
}

Point sum_of(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point difference_of(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }

Point rotated(Point p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

Point mean_of(const Points& points) {
  Point sum;
  for (const Point& p : points) sum = sum_of(sum, p);
  const auto count = static_cast<double>(points.size());
  return {sum.x / count, sum.y / count};
}

/// A shape on its way to another place: what fell over turns, for straight ways would squeeze it.
Points on_the_way(const Points& from, const Points& to, double t) {
  const Point start = mean_of(from), end = mean_of(to);
  double along = 0, across = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Point a = difference_of(from[i], start), b = difference_of(to[i], end);
    along += a.x * b.x + a.y * b.y;
    across += a.x * b.y - a.y * b.x;
  }
  const double angle = std::atan2(across, along);  // that fits best
  const Point centre = between(start, end, t);
  Points points(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Point shape =
        between(difference_of(from[i], start), rotated(difference_of(to[i], end), -angle), t);
    points[i] = sum_of(centre, rotated(shape, t * angle));
  }
  return points;
}

/// The cells shrink to the nodes of the body, which then comes to where it begins to move.
void draw_cut(Canvas& canvas, const Place& place, const Actor& actor, const Moment& moment,
              const LifeStyle& style) {
  const auto number = static_cast<std::size_t>(moment.shot.motion);
  const Motion& motion = actor.life.motions[number];
  const View& view = actor.views[number];
  if (motion.track.frame_count() == 0) {
    draw_embryo(canvas, place, actor, moment.shot.to, style);
    return;
  }
  const auto step = static_cast<std::size_t>(moment.shot.to);
  const core::Embryo& embryo = actor.life.embryos[step];
  const Lens before = lens_of(place, actor.development.targets[step], style.scale);
  const Lens lens = lens_of(place, view.targets.front(), style.scale);
  draw_lattice(canvas, place, before, 1 - eased(2 * moment.part));
  draw_surroundings(canvas, place, motion, view, lens, eased(2 * moment.part - 1));
  const double moved = eased((moment.part - 0.35) / 0.65), shrunk = eased(moment.part / 0.6);
  Points inside;
  for (const int cell : motion.body.cell) {
    const auto c = static_cast<std::size_t>(cell);
    inside.push_back(before({embryo.x[c], embryo.y[c]}));
  }
  const Points points = on_the_way(inside, points_at(motion.track, 0, view, lens), moved);
  draw_body(canvas, actor, number, points, 0, style);
  if (shrunk >= 1) return;
  const std::vector<Colour> colours =
      cell_colours(embryo, actor.life.starts, style.colour, style.scales);
  Points cells;
  for (std::size_t i = 0; i < embryo.x.size(); ++i)
    cells.push_back(before({embryo.x[i], embryo.y[i]}));
  for (std::size_t i = 0; i < points.size(); ++i) {
    cells[static_cast<std::size_t>(motion.body.cell[i])] = points[i];
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    draw_cell(canvas, cells[i], colours[i], cell_radius * style.scale * (1 - shrunk));
  }
}

}  // namespace

int frame_at(const Motion& motion, const Moment& moment) {
  const double time = moment.part * moment.shot.length;
  const int frame = static_cast<int>(std::lround(time / motion.track.interval));
  return std::clamp(frame, 0, motion.track.frame_count() - 1);
}

int step_at(const Moment& moment) {
  return moment.shot.from +
         static_cast<int>(std::lround(moment.part * (moment.shot.to - moment.shot.from)));
}

void draw_life(Canvas& canvas, const Place& place, const Actor& actor, const Moment& moment,
               const LifeStyle& style) {
  canvas.show_only({place.left, place.top}, place.width, place.height);
  switch (moment.shot.kind) {
    case Shot::Kind::development:
      draw_embryo(canvas, place, actor, step_at(moment), style);
      break;
    case Shot::Kind::cut:
      draw_cut(canvas, place, actor, moment, style);
      break;
    case Shot::Kind::motion:
      draw_motion(canvas, place, actor, moment, style);
      break;
  }
  canvas.show_all();
}

}  // namespace metamorph::evolve
