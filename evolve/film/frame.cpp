#include "evolve/film/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "evolve/view/legend.h"

namespace metamorph::evolve {
namespace {

constexpr double short_side = 540;  ///< layout pixels
constexpr double margin = 24;
constexpr double head = 56, foot = 62, cell_head = 56;
constexpr double heading_size = 17, text_size = 13, least_size = 7;
constexpr double largest_scale = 46;  ///< layout pixels per d
constexpr double air = 0.8;           ///< d around what the camera must show
constexpr double fade = 0.35;         ///< seconds that births and deaths are seen
constexpr double longest_fade = 100;  ///< development steps, however fast the film is

/// The largest size, up to `size`, at which words fit.
double fitting_size(const std::string& words, double size, double width, bool bold) {
  const double full = text_width(words, size, bold);
  return full <= width ? size : std::max(least_size, size * width / full);
}

void draw_fitting(Canvas& canvas, Point at, const std::string& words, double size, double width,
                  const Colour& colour, bool bold = false) {
  canvas.text(at, words, fitting_size(words, size, width, bold), colour, Align::left, bold);
}

/// How far it is from where it started, by the scene's rule.
double distance_at(const Motion& motion, const View& view, int frame) {
  const Point& from = view.centres.front();
  const Point& to = view.centres[static_cast<std::size_t>(frame)];
  return core::travelled(motion.scene.distance, to.x - from.x, to.y - from.y);
}

bool has_failed(const Motion& motion) {
  return motion.outcome.status != core::Status::ok &&
         motion.outcome.status != core::Status::not_settled;
}

std::string caption_of_motion(const Actor& actor, const Moment& moment, bool brief) {
  const auto number = static_cast<std::size_t>(moment.shot.motion);
  const Motion& motion = actor.life.motions[number];
  const int frame = frame_at(motion, moment);
  const double distance = distance_at(motion, actor.views[number], frame);
  std::string words =
      brief ? fmt::format("{}, {}: {:.1f} d", motion.name, motion.scene.name, distance)
            : fmt::format("{} in scene {}, t = {:.0f} of {:.0f} time units, {:.2f} d", motion.name,
                          motion.scene.name, frame * motion.track.interval, moment.shot.length,
                          distance);
  if (has_failed(motion) && frame == motion.track.frame_count() - 1) {
    words += fmt::format(", failed: {}", core::name(motion.outcome.status));
  }
  return words;
}

std::string cells_text(int count) { return fmt::format("{} cell{}", count, count == 1 ? "" : "s"); }

std::string caption_of(const Actor& actor, const Moment& moment, bool brief) {
  const Life& life = actor.life;
  if (moment.shot.kind == Shot::Kind::motion) return caption_of_motion(actor, moment, brief);
  if (moment.shot.kind == Shot::Kind::cut) {
    const Motion& motion = life.motions[static_cast<std::size_t>(moment.shot.motion)];
    if (motion.track.frame_count() > 0) return fmt::format("{} is cut out", motion.name);
    const core::Status status =
        motion.status == core::Status::ok ? motion.outcome.status : motion.status;
    return fmt::format("{}: {}", motion.name, core::name(status));
  }
  const core::Embryo& embryo = life.embryos[static_cast<std::size_t>(step_at(moment))];
  if (brief) return fmt::format("step {}: {}", embryo.step, cells_text(embryo.cell_count()));
  return fmt::format("development, step {} of {}: {}, {} born, {} died", embryo.step, life.end,
                     cells_text(embryo.cell_count()), embryo.created - 1, embryo.died);
}

/// Name of a run, and which of it; a file has a name only.
std::pair<std::string, std::string> heading_of(const Life& life) {
  const std::size_t colon = life.heading.find(": ");
  if (colon == std::string::npos) return {life.heading, ""};
  return {life.heading.substr(0, colon), life.heading.substr(colon + 2)};
}

/// Points where it goes in all of the motion.
void draw_arrow(Canvas& canvas, const Actor& actor, const Moment& moment, Point middle) {
  if (moment.shot.kind != Shot::Kind::motion) return;
  const auto number = static_cast<std::size_t>(moment.shot.motion);
  const Motion& motion = actor.life.motions[number];
  const View& view = actor.views[number];
  const Point from = view.centres.front(), to = view.centres.back();
  const Point way =
      view.turned(to.x - from.x, core::shows_ground(motion.scene) ? 0 : to.y - from.y);
  const double length = std::hypot(way.x, way.y);
  if (length <= 0) return;
  const Point along{way.x / length, -way.y / length}, across{-along.y, along.x};
  const auto place = [&](double forward, double sideways) {
    return Point{middle.x + forward * along.x + sideways * across.x,
                 middle.y + forward * along.y + sideways * across.y};
  };
  const std::array arrow{place(-9, 1.6), place(2, 1.6),  place(2, 5),    place(10, 0),
                         place(2, -5),   place(2, -1.6), place(-9, -1.6)};
  canvas.fill_polygon(arrow, colours::ink);
}

/// A length in d that is round and of a fitting size.
double ruler_length(double scale) {
  for (const double length : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0}) {
    if (length * scale >= 50) return length;
  }
  return 500;
}

void draw_ruler(Canvas& canvas, Point left, double scale) {
  const double length = ruler_length(scale);
  const std::array bar{left, Point{left.x + length * scale, left.y}};
  canvas.stroke_line(bar, colours::faint_ink, 2);
  for (const Point& end : bar) {
    canvas.stroke_line(std::array{Point{end.x, end.y - 4}, Point{end.x, end.y + 4}},
                       colours::faint_ink, 2);
  }
  canvas.text({(bar[0].x + bar[1].x) / 2, left.y - 8}, fmt::format("{:.0f} d", length), text_size,
              colours::faint_ink, Align::centre);
}

double draw_scale(Canvas& canvas, double right, double base,
                  const std::array<std::string, 3>& words,
                  const std::function<Colour(double)>& colour) {
  draw_strip(canvas, {right - strip_length, base}, words, text_size, colour);
  return right - strip_length;
}

/// Returns where it begins.
double draw_legend(Canvas& canvas, double right, double base, ColourKind kind,
                   const Scales& scales) {
  std::vector<Disc> discs;
  switch (kind) {
    case ColourKind::area:
      return draw_scale(canvas, right, base, {"contracted", "at rest", "expanded"},
                        [](double t) { return strain_colour(0.6 + 0.8 * t); });
    case ColourKind::phase:
      return draw_scale(canvas, right, base, {"\u2212\u03c0", "phase 0", "\u03c0"},
                        [](double t) { return phase_colour(std::numbers::pi * (2 * t - 1)); });
    case ColourKind::period:
      return draw_scale(canvas, right, base,
                        {fmt::format("{:.0f}", scales.shortest_period), "period, time units",
                         fmt::format("{:.0f}", scales.longest_period)},
                        sequential_colour);
    case ColourKind::speed:
      return draw_scale(
          canvas, right, base,
          {"0", "speed, d per time unit", fmt::format("{:.2f}", scales.highest_speed)},
          sequential_colour);
    case ColourKind::birth:
      discs = birth_discs(scales.stages);
      break;
    case ColourKind::contact:
      discs = {{contact_colour(Contact::ground), "touches the ground"},
               {contact_colour(Contact::itself), "itself"},
               {contact_colour(Contact::none), "nothing"}};
      break;
  }
  double width = -20;
  for (const Disc& disc : discs) width += 18 + text_width(disc.words, text_size) + 20;
  draw_discs(canvas, {right - width, base}, discs, text_size);
  return right - width;
}

/// What outlines beside the body are.
std::string ghosts_of(const std::vector<Actor>& actors) {
  std::size_t copies = 0;
  bool reference = false;
  for (const Actor& actor : actors) {
    for (const Motion& motion : actor.life.motions) {
      copies = std::max(copies, motion.copies.size());
      reference = reference || motion.reference.has_value();
    }
  }
  std::string words;
  if (copies > 0) words = fmt::format("grey: {} nearby start{}", copies, copies == 1 ? "" : "s");
  if (reference) words += words.empty() ? "green: reference" : "; green: reference";
  return words;
}

/// As many columns as make the places largest.
int columns_of(int count, double width, double height) {
  int best = 1;
  double largest = 0;
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const double side = std::min(width / columns, height / rows - cell_head);
    if (side > largest) {
      largest = side;
      best = columns;
    }
  }
  return best;
}

std::vector<Place> places_of(int count, double width, double height) {
  if (count == 1) return {{0, head, width, height - head - foot}};
  const double tall = height - foot - margin / 2;
  const int columns = columns_of(count, width, tall);
  const int rows = (count + columns - 1) / columns;
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const double w = width / columns, h = tall / rows;
    places.push_back(
        {w * (i % columns), margin / 2 + h * (i / columns) + cell_head, w, h - cell_head});
  }
  return places;
}

/// The scale at which all that a camera must show is in its place.
double scale_of(const std::vector<Actor>& actors, const std::vector<Place>& places) {
  double scale = largest_scale;
  for (std::size_t a = 0; a < actors.size(); ++a) {
    const auto fit = [&](const View& view) {
      scale = std::min({scale, places[a].width / 2 / (view.half_width + air),
                        places[a].height / 2 / (view.half_height + air)});
    };
    for (const Shot& shot : actors[a].shots) {
      if (shot.kind == Shot::Kind::development) fit(actors[a].development);
      if (shot.kind == Shot::Kind::motion)
        fit(actors[a].views[static_cast<std::size_t>(shot.motion)]);
    }
  }
  return scale;
}

ColourKind shown_kind(const Moment& moment, ColourKind kind) {
  const bool embryo = moment.shot.kind == Shot::Kind::development ||
                      (moment.shot.kind == Shot::Kind::cut && moment.part < 0.3);
  return embryo ? of_embryos(kind) : kind;
}

}  // namespace

FrameArtist::FrameArtist(std::vector<Actor> actors, const FrameStyle& style)
    : actors_(std::move(actors)),
      style_(style),
      density_(std::min(style.width, style.height) / short_side),
      width_(style.width / density_),
      height_(style.height / density_),
      places_(places_of(static_cast<int>(actors_.size()), width_, height_)) {
  std::vector<const Life*> lives;
  life_style_.colour = style.colour;
  for (const Actor& actor : actors_) {
    lives.push_back(&actor.life);
    seconds_ = std::max(seconds_, seconds_of(actor.shots));
  }
  life_style_.scales = scales_of(lives);
  life_style_.scale = scale_of(actors_, places_);
  life_style_.fade_steps = std::clamp(fade * style.speed / core::paper_step, 1.0, longest_fade);
}

std::string FrameArtist::draw(double second, Canvas::Frame form) const {
  Canvas canvas(form, style_.width, style_.height, density_);
  if (actors_.size() == 1) {
    draw_one(canvas, second);
  } else {
    draw_grid(canvas, second);
  }
  draw_foot(canvas, second);
  return canvas.finish();
}

void FrameArtist::draw_one(Canvas& canvas, double second) const {
  const Actor& actor = actors_.front();
  const Moment moment = moment_at(actor.shots, second);
  draw_life(canvas, places_.front(), actor, moment, life_style_);
  const double room = width_ - 2 * margin;
  draw_fitting(canvas, {margin, 28}, actor.life.heading, heading_size, room - 30, colours::ink,
               true);
  draw_fitting(canvas, {margin, 48}, caption_of(actor, moment, false), text_size, room,
               colours::faint_ink);
  draw_arrow(canvas, actor, moment, {width_ - margin - 12, 24});
}

void FrameArtist::draw_grid(Canvas& canvas, double second) const {
  for (std::size_t a = 0; a < actors_.size(); ++a) {
    const Actor& actor = actors_[a];
    const Place& place = places_[a];
    const Moment moment = moment_at(actor.shots, second);
    draw_life(canvas, place, actor, moment, life_style_);
    const double left = place.left + margin / 2, room = place.width - margin;
    const auto [name, rest] = heading_of(actor.life);
    draw_fitting(canvas, {left, place.top - 40}, name, text_size, room, colours::ink, true);
    draw_fitting(canvas, {left, place.top - 24}, rest, text_size - 1, room, colours::faint_ink);
    draw_fitting(canvas, {left, place.top - 8}, caption_of(actor, moment, true), text_size - 1,
                 room - 26, colours::faint_ink);
    draw_arrow(canvas, actor, moment, {place.left + place.width - margin / 2 - 10, place.top - 12});
  }
}

void FrameArtist::draw_foot(Canvas& canvas, double second) const {
  const double base = height_ - 28;
  const std::vector<Shot>& shots = actors_.front().shots;
  draw_ruler(canvas, {margin, base - 2}, life_style_.scale);
  std::string words = fmt::format("{:.3g} time units per second", style_.speed);
  const std::string ghosts = ghosts_of(actors_);
  if (!ghosts.empty()) words += "; " + ghosts;
  const double legend =
      draw_legend(canvas, width_ - margin, base,
                  shown_kind(moment_at(shots, second), style_.colour), life_style_.scales);
  const double left = margin + ruler_length(life_style_.scale) * life_style_.scale + 24;
  const double room = legend - 24 - left;
  // In a narrow frame the legend matters more.
  if (text_width(words, least_size) <= room) {
    draw_fitting(canvas, {left, base + 2}, words, text_size, room, colours::faint_ink);
  }
  // The whole film as a line, with gaps where bodies are cut out.
  const double whole = width_ - 2 * margin, y = height_ - 9;
  double start = 0;
  for (const Shot& shot : shots) {
    const double end = start + shot.seconds;
    const auto place = [&](double s) { return Point{margin + whole * s / seconds_, y}; };
    if (shot.kind != Shot::Kind::cut) {
      canvas.stroke_line(std::array{place(start), place(end)}, Colour{0.87, 0.88, 0.90}, 4);
      if (second > start) {
        canvas.stroke_line(std::array{place(start), place(std::min(second, end))},
                           colours::faint_ink, 4);
      }
    }
    start = end;
  }
}

}  // namespace metamorph::evolve
