#include "evolve/replay/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/life/contacts.h"
#include "evolve/replay/base64.h"
#include "evolve/replay/development_code.h"
#include "evolve/replay/page_parts.h"
#include "evolve/replay/track_code.h"
#include "evolve/view/colour.h"

namespace metamorph::evolve {
namespace {

using Json = nlohmann::ordered_json;

constexpr double way_interval = 10 * core::paper_step;  ///< time units between points of a way
constexpr double way_step = 0.01;                       ///< d

/// Data as a script element may hold them: nothing in them can end it.
std::string script_text(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// `text` with every `mark` replaced.
std::string replaced(std::string_view text, std::string_view mark, const std::string& by) {
  std::string result(text);
  for (std::size_t at = 0; (at = result.find(mark, at)) != std::string::npos; at += by.size()) {
    result.replace(at, mark.size(), by);
  }
  return result;
}

double rounded(double value, double step) { return std::round(value / step) * step; }

Json chunks_json(const std::vector<std::string>& chunks) {
  Json list = Json::array();
  for (const std::string& chunk : chunks) list.push_back(base64(chunk));
  return list;
}

Json track_json(const Track& track) {
  const PackedTrack packed = pack(track);
  return {{"interval", packed.interval},
          {"frames", packed.frames},
          {"every", packed.every},
          {"chunks", chunks_json(packed.chunks)}};
}

/// The way of the middle of moving points and how far they reach from it, for cameras.
struct Way {
  int every;                           ///< frames between two points
  std::vector<double> x, y;            ///< d
  std::vector<double> half_x, half_y;  ///< d, half the size; grows only

  /// The middle stays where it was when there are no points.
  void add(int frame, std::span<const double> px, std::span<const double> py) {
    double mx = x.empty() ? 0 : x.back(), my = y.empty() ? 0 : y.back();
    if (!px.empty()) {
      mx = my = 0;
      for (std::size_t i = 0; i < px.size(); ++i) {
        mx += px[i] / static_cast<double>(px.size());
        my += py[i] / static_cast<double>(px.size());
      }
    }
    for (std::size_t i = 0; i < px.size(); ++i) {
      reach_x = std::max(reach_x, std::abs(px[i] - mx));
      reach_y = std::max(reach_y, std::abs(py[i] - my));
    }
    if (frame % every != 0) return;
    x.push_back(mx);
    y.push_back(my);
    half_x.push_back(reach_x);
    half_y.push_back(reach_y);
  }

  double reach_x = 0, reach_y = 0;
};

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(std::llround(value / way_step));
  return list;
}

Json way_json(const Way& way) {
  return {{"every", way.every}, {"x", numbers(way.x)}, {"y", numbers(way.y)}};
}

Way way_of(const Track& track) {
  Way way{
      std::max(1, static_cast<int>(std::lround(way_interval / track.interval))), {}, {}, {}, {}};
  for (int f = 0; f < track.frame_count(); ++f) {
    const auto at = static_cast<std::size_t>(f);
    way.add(f, track.x[at], track.y[at]);
  }
  return way;
}

/// The speed that one node in a hundred exceeds, d per time unit: the end of the scale of colours.
double fast_speed(const Track& track) {
  std::vector<double> speeds;
  for (int f = 1; f < track.frame_count(); ++f) {
    const std::vector<double> now = speeds_at(track, f);
    speeds.insert(speeds.end(), now.begin(), now.end());
  }
  if (speeds.empty()) return 0;
  const auto place = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() * 99 / 100);
  std::nth_element(speeds.begin(), place, speeds.end());
  return *place;
}

Json development_json(const Life& life) {
  if (life.embryos.empty()) return nullptr;
  const PackedDevelopment packed = pack(life.embryos);
  Way way{static_cast<int>(std::lround(way_interval / core::paper_step)), {}, {}, {}, {}};
  for (const core::Embryo& embryo : life.embryos) way.add(embryo.step, embryo.x, embryo.y);
  Json way_of_cells = way_json(way);
  way_of_cells["half_x"] = numbers(way.half_x);
  way_of_cells["half_y"] = numbers(way.half_y);
  const core::Embryo& last = life.embryos.back();
  return {{"frames", packed.frames},
          {"status", core::name(last.status)},
          {"way", std::move(way_of_cells)},
          {"cells", base64(packed.cells)},
          {"links", base64(packed.links)},
          {"signals", base64(packed.signals)},
          {"chunks", chunks_json(packed.chunks)}};
}

Json motion_json(const Motion& motion) {
  Json json = {{"name", motion.name},
               {"stage", motion.stage},
               {"status", core::name(motion.status)},
               {"scene", motion.scene.name},
               {"ground", core::shows_ground(motion.scene)},
               {"slope", motion.scene.ground ? motion.scene.slope_degrees : 0},
               {"gap", motion.scene.self_collision ? motion.scene.collision_gap : 0}};
  if (motion.status != core::Status::ok) return json;
  const Way way = way_of(motion.track);
  json["outcome"] = core::name(motion.outcome.status);
  json["distance"] = motion.outcome.distance;
  json["body"] = base64(deflated(body_text(motion.body)));
  json["born"] = motion.born;
  json["speed"] = rounded(fast_speed(motion.track), 1e-4);
  json["half"] = {rounded(way.reach_x, way_step), rounded(way.reach_y, way_step)};
  json["way"] = way_json(way);
  json["track"] = track_json(motion.track);
  json["copies"] = Json::array();
  for (const Track& copy : motion.copies) json["copies"].push_back(track_json(copy));
  json["reference"] = motion.reference ? track_json(*motion.reference) : Json(nullptr);
  return json;
}

Json run_json(const RunInPage& run) {
  Json fitness = Json::array(), ancestors = Json::array();
  for (const auto& [best, mean] : run.fitness) {
    fitness.push_back({rounded(best, 1e-3), rounded(mean, 1e-3)});
  }
  for (const auto& [id, ancestor] : run.ancestors) {
    ancestors.push_back(
        {id, ancestor.generation, rounded(ancestor.eq6, 1e-3), ancestor.parent, ancestor.other});
  }
  return {{"name", run.name}, {"fitness", fitness}, {"ancestors", ancestors}};
}

Json colour_json(const Colour& colour) {
  return {rounded(colour.red, 1e-3), rounded(colour.green, 1e-3), rounded(colour.blue, 1e-3)};
}

/// `count` + 1 colours from 0 to 1.
template <class ColourOf>
Json scale_json(int count, const ColourOf& colour) {
  Json scale = Json::array();
  for (int k = 0; k <= count; ++k) scale.push_back(colour_json(colour(k / double(count))));
  return scale;
}

/// The page draws with the colours of all other pictures.
Json colours_json() {
  constexpr double range = 0.4;  // strain_colour()
  constexpr int stages = 5;      // birth_colour() knows no more
  Json birth = Json::array();
  for (int stage = 0; stage < stages; ++stage) birth.push_back(colour_json(birth_colour(stage)));
  return {
      {"range", range},
      {"strain", scale_json(48, [](double t) { return strain_colour(1 + range * (2 * t - 1)); })},
      {"phase", scale_json(64, [](double t) { return phase_colour(2 * std::numbers::pi * t); })},
      {"scale", scale_json(48, sequential_colour)},
      {"birth", std::move(birth)},
      {"ground", colour_json(contact_colour(Contact::ground))},
      {"itself", colour_json(contact_colour(Contact::itself))},
      {"free", colour_json(contact_colour(Contact::none))}};
}

std::string element(const std::string& id, const Json& json) {
  return fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id,
                     script_text(json));
}

}  // namespace

PageWriter::PageWriter(const std::filesystem::path& file, Overwrite overwrite,
                       const std::string& title, const std::string& command)
    : output_(file, overwrite), command_(command) {
  write(replaced(replaced(page_html, "@css@", std::string(page_css)), "@title@", html_text(title)));
}

void PageWriter::write(std::string_view text) {
  output_.write(text);
  bytes_ += text.size();
}

void PageWriter::add(const Life& life, const PlaceInRun& place) {
  Json motions = Json::array();
  for (const Motion& motion : life.motions) motions.push_back(motion_json(motion));
  write(element(
      fmt::format("life-{}", lives_++),
      {{"heading", life.heading},
       {"genome", life.genome ? Json(base64(deflated(genome_text(*life.genome)))) : Json(nullptr)},
       {"run", place.run},
       {"generation", life.generation},
       {"individual", place.individual},
       {"eq6", rounded(place.eq6, 1e-3)},
       {"starts", life.starts},
       {"development", development_json(life)},
       {"motions", std::move(motions)}}));
}

void PageWriter::finish(const std::vector<RunInPage>& runs) {
  Json list = Json::array();
  for (const RunInPage& run : runs) list.push_back(run_json(run));
  write(element("page", {{"format", "metamorph-replay/1"},
                         {"command", command_},
                         {"lives", lives_},
                         {"coordinate_step", coordinate_step},
                         {"chunk_frames", chunk_frames},
                         {"way_step", way_step},
                         {"period_step", period_step},
                         {"phase_step", phase_step},
                         {"paper_step", core::paper_step},
                         {"reach", ground_reach},
                         {"squeezed", squeezed},
                         {"colours", colours_json()},
                         {"runs", std::move(list)}}));
  write("<script type=\"module\">");
  write(page_js);
  write("</script>\n</body>\n</html>\n");
  output_.commit();
}

}  // namespace metamorph::evolve
