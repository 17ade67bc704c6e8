#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "evolve/app/commands.h"
#include "evolve/app/life_sources.h"
#include "evolve/app/options.h"
#include "evolve/app/streams.h"
#include "evolve/files/input_error.h"
#include "evolve/files/printable.h"
#include "evolve/film/actor.h"
#include "evolve/film/encoder.h"
#include "evolve/film/frame.h"
#include "metamorph/named.h"

namespace metamorph::evolve {
namespace {

constexpr int most_lives = 64;
constexpr std::int64_t most_frames = 1000000;

constexpr core::Named<FilmKind> kinds[] = {
    {FilmKind::life, "life"}, {FilmKind::development, "development"}, {FilmKind::motion, "motion"}};
constexpr core::Named<ColourKind> colour_kinds[] = {
    {ColourKind::area, "area"},   {ColourKind::phase, "phase"}, {ColourKind::period, "period"},
    {ColourKind::speed, "speed"}, {ColourKind::birth, "birth"}, {ColourKind::contact, "contact"}};
constexpr core::Named<CameraKind> cameras[] = {
    {CameraKind::follow, "follow"}, {CameraKind::stay, "stay"}, {CameraKind::path, "path"}};

template <class Enum, std::size_t count>
std::vector<std::string> names_of(const core::Named<Enum> (&table)[count]) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.name);
  return names;
}

/// Precondition: it is one of the names.
template <class Enum, std::size_t count>
Enum value_of(const core::Named<Enum> (&table)[count], const std::string& name) {
  return std::find_if(std::begin(table), std::end(table),
                      [&](const auto& entry) { return entry.name == name; })
      ->value;
}

struct FilmOptions {
  LifeSources sources;
  std::string out;
  std::string kind;  ///< empty: life, or motion where a trial is named
  std::string trial;
  std::string size = "1280x720";
  int fps = 30;
  double speed = 40;   ///< time units per second
  double seconds = 0;  ///< 0: as the speed has it
  std::string colour = "area";
  std::string camera = "follow";
  int copies = 0;
  bool reference = false;
  bool overwrite = false;
};

bool read_size(const std::string& text, int& width, int& height) {
  const char* end = text.data() + text.size();
  const auto [cross, error] = std::from_chars(text.data(), end, width);
  if (error != std::errc() || cross == end || *cross != 'x') return false;
  const auto [rest, fault] = std::from_chars(cross + 1, end, height);
  return fault == std::errc() && rest == end && std::min(width, height) >= 64 &&
         std::max(width, height) <= 7680;
}

CLI::Validator is_size() {
  return CLI::Validator(
      [](const std::string& text) {
        int width = 0, height = 0;
        return read_size(text, width, height)
                   ? std::string()
                   : text + ": expected WIDTHxHEIGHT in pixels, each from 64 to 7680";
      },
      "");
}

/// Trials by name, and motions where there are bodies.
std::vector<Shot> checked_shots(const Life& life, FilmKind kind, const FilmOptions& options) {
  if (life.end == 0 && kind == FilmKind::development) {
    throw InputError("--kind: development: expected life or motion for a body");
  }
  if (life.end == 0 && !options.trial.empty()) {
    throw InputError("--trial: expected a run or a genome, not a body");
  }
  std::vector<Shot> shots = shots_of(life, kind, options.trial);
  if (!shots.empty()) return shots;
  std::vector<std::string> names;
  for (const Motion& motion : life.motions) names.push_back(motion.name);
  if (life.end > 0) {
    throw InputError(
        fmt::format("--trial: {}: expected {}", options.trial, fmt::join(names, " or ")));
  }
  throw InputError(fmt::format("{}: cannot move: {}", life.heading,
                               core::name(life.motions.front().outcome.status)));
}

/// Speed and length of a cut, seconds, such that the longest of all lasts as long as was asked for.
std::pair<double, double> pace_of(const std::vector<std::vector<Shot>>& films,
                                  const FilmOptions& options) {
  if (options.seconds <= 0) return {options.speed, 1.0};
  const double cut = std::min(1.0, options.seconds / 20);
  double speed = 0;
  for (const std::vector<Shot>& shots : films) {
    const double left = std::max(options.seconds - cut * cuts_of(shots), options.seconds / 20);
    speed = std::max(speed, length_of(shots) / left);
  }
  return {speed > 0 ? speed : options.speed, cut};
}

LifeOptions life_options_of(const FilmOptions& options) {
  LifeOptions life;
  // Finer than the film, or its frames would show moments that are not evenly spread.
  constexpr double parts = 6;
  life.interval = options.seconds > 0
                      ? core::paper_step
                      : std::max(core::paper_step, options.speed / options.fps / parts);
  life.copies = options.copies;
  life.reference = options.reference;
  return life;
}

FrameArtist artist_of(const FilmOptions& options, const FilmFormat& format) {
  const FilmKind kind = value_of(kinds, !options.kind.empty()   ? options.kind
                                        : options.trial.empty() ? "life"
                                                                : "motion");
  if (kind == FilmKind::development && !options.trial.empty()) {
    throw InputError("--trial: not together with --kind development");
  }
  std::vector<Life> lives;
  std::vector<std::vector<Shot>> films;
  each_life(options.sources, life_options_of(options), [&](Life life) {
    films.push_back(checked_shots(life, kind, options));
    lives.push_back(std::move(life));
    if (lives.size() > most_lives) {
      throw InputError(
          fmt::format("SOURCE: more than {} animats: expected fewer in one film", most_lives));
    }
  });
  const auto [speed, cut] = pace_of(films, options);
  std::vector<Actor> actors;
  for (std::size_t i = 0; i < lives.size(); ++i) {
    set_seconds(films[i], speed, cut);
    actors.push_back(
        actor_of(std::move(lives[i]), std::move(films[i]), value_of(cameras, options.camera)));
  }
  FrameStyle style;
  style.width = format.width;
  style.height = format.height;
  style.colour = value_of(colour_kinds, options.colour);
  style.speed = speed;
  return FrameArtist(std::move(actors), style);
}

void film(const FilmOptions& options) {
  FilmFormat format;
  read_size(options.size, format.width, format.height);
  format.fps = options.fps;
  const Overwrite overwrite = options.overwrite ? Overwrite::yes : Overwrite::no;
  check_film(options.out, format, overwrite);
  const FrameArtist artist = artist_of(options, format);
  const double wanted = std::round(artist.seconds() * format.fps);
  if (wanted > most_frames) {
    throw InputError(
        fmt::format("--speed, --fps: {:.0f} frames: expected {} at most", wanted, most_frames));
  }
  const int frames = std::max(1, static_cast<int>(wanted));
  const auto sink = open_film(options.out, format, overwrite);
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  for (int f = 0; f < frames; ++f) {
    if (terminal && f % format.fps == 0) tell("\rframe {} of {}", f, frames);
    sink->add(artist.draw(static_cast<double>(f) / format.fps, sink->form()));
  }
  if (terminal) tell("\r\x1b[K");
  sink->finish();
  fmt::print("{}: {} frames, {:.1f} s\n", printable(options.out), frames,
             static_cast<double>(frames) / format.fps);
}

}  // namespace

void add_film_command(CLI::App& app) {
  const auto options = std::make_shared<FilmOptions>();
  CLI::App* command = app.add_subcommand(
      "film", "Films lives of runs' champions, genomes or bodies: MP4, WebM, GIF or PNG frames");
  add_life_sources(*command, options->sources);
  command
      ->add_option(
          "--out", options->out,
          "The film; .mp4, .webm and .gif are made by the program ffmpeg, a name that ends "
          "in / is a new folder of PNG frames, 00001.png and so on")
      ->required()
      ->option_text("FILE.mp4|.webm|.gif|FOLDER/");
  command
      ->add_option("--kind", options->kind,
                   "life: development, in which each stage is cut out and moves; development; "
                   "motion: of all trials")
      ->check(one_of(names_of(kinds)))
      ->option_text("KIND [life]");
  command
      ->add_option("--trial", options->trial,
                   "The only trial whose motion is shown; without --kind: nothing else is")
      ->option_text("NAME [all]");
  command->add_option("--size", options->size, "Pixels; even numbers but for GIF and PNG")
      ->check(is_size())
      ->option_text("WxH [1280x720]");
  command->add_option("--fps", options->fps, "Frames per second")
      ->check(integer_from(1, 120))
      ->option_text("N [30]");
  CLI::Option* speed =
      command->add_option("--speed", options->speed, "Time units per second of the film")
          ->check(number_from(0.01, 1e6))
          ->option_text("X [40]");
  command->add_option("--seconds", options->seconds, "How long the film is, instead of a speed")
      ->check(number_from(0.1, 36000))
      ->option_text("X")
      ->excludes(speed);
  command
      ->add_option(
          "--colour,--color", options->colour,
          "Of bodies: area (expanded red, contracted blue), phase, period, speed, birth "
          "(stage of life) or contact with the ground; embryos show phase, period or birth")
      ->check(one_of(names_of(colour_kinds)))
      ->option_text("KIND [area]");
  command
      ->add_option("--camera", options->camera,
                   "follow: goes with the body; stay: stands where it starts; path: shows all of "
                   "its path")
      ->check(one_of(names_of(cameras)))
      ->option_text("KIND [follow]");
  command
      ->add_option("--copies", options->copies,
                   "Starts nearby, as grey outlines: those of the trial, or displaced by 1e-3 d")
      ->check(integer_from(0, 16))
      ->option_text("N [0]");
  command->add_flag("--reference", options->reference,
                    "The double-precision reference at a quarter of the step, as a green outline "
                    "(slow)");
  command->add_flag("--overwrite", options->overwrite, "Replace a file that exists");
  command->callback([options] { film(*options); });
}

}  // namespace metamorph::evolve
