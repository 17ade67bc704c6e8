#include "evolve/film/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace metamorph::evolve {
namespace {

constexpr double smooth_time = 30;    ///< time units that the camera's way is a mean of
constexpr double below_ground = 1.2;  ///< d of it that are shown
constexpr double stay_factor = 2;

Point centre_of(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.empty()) return {};
  const auto count = static_cast<double>(x.size());
  return {std::accumulate(x.begin(), x.end(), 0.0) / count,
          std::accumulate(y.begin(), y.end(), 0.0) / count};
}

/// Means over `half` points before and after, fewer at the ends but as many on both sides, so that
/// the first and the last stay where they are.
std::vector<Point> smoothed(const std::vector<Point>& points, int half) {
  std::vector<Point> sums(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sums[i + 1] = {sums[i].x + points[i].x, sums[i].y + points[i].y};
  }
  std::vector<Point> means(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t reach = std::min({static_cast<std::size_t>(half), i, points.size() - 1 - i});
    const auto count = static_cast<double>(2 * reach + 1);
    means[i] = {(sums[i + reach + 1].x - sums[i - reach].x) / count,
                (sums[i + reach + 1].y - sums[i - reach].y) / count};
  }
  return means;
}

void widen(View& view, Point target, Point seen) {
  view.half_width = std::max(view.half_width, std::abs(seen.x - target.x));
  view.half_height = std::max(view.half_height, std::abs(seen.y - target.y));
}

}  // namespace

View view_of(const Motion& motion, CameraKind camera) {
  View view;
  const Track& track = motion.track;
  const double angle = motion.scene.slope_degrees * std::numbers::pi / 180;
  view.sine = std::sin(angle);
  view.cosine = std::cos(angle);
  const bool ground = core::shows_ground(motion.scene);
  Box box;
  double top = 0;
  for (std::size_t f = 0; f < track.x.size(); ++f) {
    view.centres.push_back(centre_of(track.x[f], track.y[f]));
    for (std::size_t i = 0; i < track.x[f].size(); ++i) {
      const Point& centre = view.centres.back();
      view.reach =
          std::max(view.reach, std::hypot(track.x[f][i] - centre.x, track.y[f][i] - centre.y));
      top = std::max(top, track.y[f][i]);
      box.include(view.turned(track.x[f][i], track.y[f][i]));
      if (ground) box.include(view.turned(track.x[f][i], -below_ground));
    }
  }
  const int half =
      std::max(0, static_cast<int>(std::lround(smooth_time / 2 / std::max(track.interval, 1e-9))));
  for (const Point& centre : smoothed(view.centres, half)) {
    // The ground does not move up and down.
    view.targets.push_back(view.turned(centre.x, ground ? (top - below_ground) / 2 : centre.y));
  }
  if (camera == CameraKind::path && !box.empty) {
    const Point middle{(box.left + box.right) / 2, (box.bottom + box.top) / 2};
    std::fill(view.targets.begin(), view.targets.end(), middle);
  }
  for (std::size_t f = 0; f < track.x.size(); ++f) {
    for (std::size_t i = 0; i < track.x[f].size(); ++i) {
      widen(view, view.targets[f], view.turned(track.x[f][i], track.y[f][i]));
      if (ground) widen(view, view.targets[f], view.turned(track.x[f][i], -below_ground));
    }
  }
  if (camera == CameraKind::stay && !view.targets.empty()) {
    std::fill(view.targets.begin(), view.targets.end(), Point(view.targets.front()));
    view.half_width *= stay_factor;
    view.half_height *= stay_factor;
  }
  return view;
}

View view_of_development(const Life& life) {
  constexpr double cell_radius = 0.5;
  View view;
  for (const core::Embryo& embryo : life.embryos) {
    // Of an embryo without cells the place stays where it was.
    view.centres.push_back(embryo.x.empty() && !view.centres.empty()
                               ? Point(view.centres.back())
                               : centre_of(embryo.x, embryo.y));
  }
  view.targets = smoothed(view.centres, static_cast<int>(smooth_time / core::paper_step / 2));
  for (std::size_t s = 0; s < life.embryos.size(); ++s) {
    const core::Embryo& embryo = life.embryos[s];
    for (std::size_t i = 0; i < embryo.x.size(); ++i) {
      widen(view, view.targets[s], {embryo.x[i], embryo.y[i]});
    }
  }
  view.half_width += cell_radius;
  view.half_height += cell_radius;
  return view;
}

}  // namespace metamorph::evolve
