#include "evolve/film/colouring.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "evolve/life/contacts.h"

namespace metamorph::evolve {
namespace {

constexpr double shown_share = 0.99;  ///< of speeds: few are far above all others

Colour period_colour(double period, const Scales& scales) {
  const double range = scales.longest_period - scales.shortest_period;
  return sequential_colour(range > 0 ? (period - scales.shortest_period) / range : 0.5);
}

void include_periods(const std::vector<double>& periods, Scales& scales) {
  for (const double period : periods) {
    scales.shortest_period = std::min(scales.shortest_period, period);
    scales.longest_period = std::max(scales.longest_period, period);
  }
}

}  // namespace

Scales scales_of(std::span<const Life* const> lives) {
  Scales scales;
  scales.shortest_period = std::numeric_limits<double>::infinity();
  std::vector<double> speeds;
  for (const Life* life : lives) {
    scales.stages = std::max(scales.stages, static_cast<int>(life->starts.size()) + 1);
    for (const core::Embryo& embryo : life->embryos) include_periods(embryo.period, scales);
    for (const Motion& motion : life->motions) {
      include_periods(motion.body.period, scales);
      const int every = std::max(1, motion.track.frame_count() / 200);
      for (int f = every; f < motion.track.frame_count(); f += every) {
        const std::vector<double> now = speeds_at(motion.track, f);
        speeds.insert(speeds.end(), now.begin(), now.end());
      }
    }
  }
  if (!speeds.empty()) {
    const auto last =
        static_cast<std::ptrdiff_t>(shown_share * static_cast<double>(speeds.size() - 1));
    std::nth_element(speeds.begin(), speeds.begin() + last, speeds.end());
    scales.highest_speed = speeds[static_cast<std::size_t>(last)];
  }
  return scales;
}

std::vector<Colour> node_colours(const Motion& motion, int frame, ColourKind kind,
                                 const Scales& scales) {
  const core::Body& body = motion.body;
  std::vector<Colour> colours(body.x.size());
  const std::vector<double> speeds =
      kind == ColourKind::speed ? speeds_at(motion.track, frame) : std::vector<double>();
  const std::vector<Contact> contacts =
      kind == ColourKind::contact ? contacts_of(motion, frame) : std::vector<Contact>();
  for (std::size_t i = 0; i < colours.size(); ++i) {
    switch (kind) {
      case ColourKind::area:
        break;
      case ColourKind::phase:
        colours[i] = phase_colour(body.phase[i]);
        break;
      case ColourKind::period:
        colours[i] = period_colour(body.period[i], scales);
        break;
      case ColourKind::speed:
        colours[i] =
            sequential_colour(scales.highest_speed > 0 ? speeds[i] / scales.highest_speed : 0);
        break;
      case ColourKind::birth:
        colours[i] = pale(birth_colour(motion.born.empty() ? 0 : motion.born[i]));
        break;
      case ColourKind::contact:
        colours[i] = contact_colour(contacts[i]);
        break;
    }
  }
  return colours;
}

std::vector<Colour> cell_colours(const core::Embryo& embryo, std::span<const int> starts,
                                 ColourKind kind, const Scales& scales) {
  std::vector<Colour> colours;
  colours.reserve(embryo.id.size());
  for (std::size_t i = 0; i < embryo.id.size(); ++i) {
    if (kind == ColourKind::phase) {
      colours.push_back(phase_colour(embryo.phase[i]));
    } else if (kind == ColourKind::period) {
      colours.push_back(period_colour(embryo.period[i], scales));
    } else {
      colours.push_back(pale(birth_colour(birth_stage(embryo.birth_step[i], starts))));
    }
  }
  return colours;
}

ColourKind of_embryos(ColourKind kind) {
  return kind == ColourKind::phase || kind == ColourKind::period ? kind : ColourKind::birth;
}

}  // namespace metamorph::evolve
