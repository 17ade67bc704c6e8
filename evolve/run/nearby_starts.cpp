#include "evolve/run/nearby_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "evolve/evaluation/displaced.h"
#include "evolve/run/median.h"
#include "metamorph/automatic_step.h"
#include "metamorph/random.h"

namespace metamorph::evolve {
namespace {

constexpr double noticeable = 0.01;  // of the distance

/// The course of one replay, a frame per paper step.
struct Course {
  core::Outcome outcome;
  std::vector<double> time;
  std::vector<std::array<double, 2>> mean;  ///< [frames] mean displacement since actuation began, d
  std::vector<double> x, y;                 ///< [nodes] at the last frame, d
};

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Course run_course(const core::Body& body, const core::Scene& scene, core::Method method) {
  Course course;
  std::array<double, 2> start{};
  const int paper_step = std::max(1, static_cast<int>(std::lround(core::paper_step / scene.step)));
  course.outcome = core::simulate_observed(
      {&body, &scene}, {core::Precision::float64, method, 1}, paper_step,
      [&](const core::Frame& frame) {
        const std::array<double, 2> now = {mean_of(frame.x), mean_of(frame.y)};
        if (frame.step == 0) start = now;
        course.time.push_back(frame.time);
        course.mean.push_back({now[0] - start[0], now[1] - start[1]});
        course.x.assign(frame.x.begin(), frame.x.end());
        course.y.assign(frame.y.begin(), frame.y.end());
      });
  return course;
}

double separation(const Course& a, const Course& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    const double dx = a.x[i] - b.x[i], dy = a.y[i] - b.y[i];
    sum += dx * dx + dy * dy;
  }
  return std::sqrt(sum / static_cast<double>(a.x.size()));
}

/// When the two first differ noticeably, if they do.
std::optional<double> parting(const Course& a, const Course& b) {
  const double tolerance = noticeable * a.outcome.distance;
  for (std::size_t f = 0; f < a.time.size(); ++f) {
    if (std::hypot(a.mean[f][0] - b.mean[f][0], a.mean[f][1] - b.mean[f][1]) > tolerance) {
      return a.time[f];
    }
  }
  return std::nullopt;
}

}  // namespace

NearbyStarts run_nearby_starts(const core::Body& body, const core::Scene& scene,
                               core::Method method, int starts, double displacement) {
  NearbyStarts result;
  // All take the same steps, or the difference would be one of steps as well.
  const core::Scene own = core::with_chosen_steps(body, scene, method);
  const Course unchanged = run_course(body, own, method);
  if (core::is_failure(unchanged.outcome.status)) return result;
  result.predictable_for = unchanged.time.back();
  std::vector<double> distances;
  for (int s = 0; s < starts; ++s) {
    const RandomStream random(Purpose::nearby_start, 1, static_cast<std::uint32_t>(s), 0);
    const Course changed = run_course(displaced(body, displacement, random), own, method);
    ++result.starts;
    if (core::is_failure(changed.outcome.status)) {
      ++result.failed;
      continue;
    }
    distances.push_back(changed.outcome.distance);
    result.spread =
        std::max(result.spread, std::abs(changed.outcome.distance - unchanged.outcome.distance));
    result.growth = std::max(result.growth, separation(unchanged, changed) / displacement);
    if (const std::optional<double> time = parting(unchanged, changed)) {
      result.parted = true;
      result.predictable_for = std::min(result.predictable_for, *time);
    }
  }
  if (!distances.empty()) result.mean = mean_of(distances);
  result.median = median(std::move(distances));
  return result;
}

}  // namespace metamorph::evolve
