#include "core/locomotion/gait.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/elementary.h"

namespace metamorph::core {
namespace {

constexpr double look_interval = 2;        ///< time units
constexpr std::size_t lowest_cycles = 4;   ///< in the series: slower is a turn, not a gait
constexpr std::size_t fewest_samples = 4;  ///< in a cycle
constexpr double slowest = 1e-4;           ///< d per time unit

double cosine_pi(double t) {
  double sine = 0, cosine = 0;
  kernels::sin_cos_pi(t, sine, cosine);
  return cosine;
}

/// The power of a series at frequencies of `first`, first + 1, ... cycles in it, by Goertzel's
/// recurrence, for all of them side by side: s_n = value + 2 cos(w) s_(n-1) - s_(n-2).
class Spectrum {
 public:
  Spectrum(std::size_t first, std::size_t count, std::size_t samples)
      : twice_cosine_(count), power_(count, 0) {
    for (std::size_t b = 0; b < count; ++b) {
      twice_cosine_[b] =
          2 * cosine_pi(2 * static_cast<double>(first + b) / static_cast<double>(samples));
    }
  }

  void add(const std::vector<double>& values) {
    const std::size_t count = power_.size();
    std::vector<double> last(count, 0), before(count, 0);
    for (const double value : values) {
      for (std::size_t b = 0; b < count; ++b) {
        before[b] = value + twice_cosine_[b] * last[b] - before[b];
      }
      std::swap(last, before);
    }
    for (std::size_t b = 0; b < count; ++b) {
      power_[b] +=
          last[b] * last[b] + before[b] * before[b] - twice_cosine_[b] * last[b] * before[b];
    }
  }

  const std::vector<double>& power() const { return power_; }

 private:
  std::vector<double> twice_cosine_, power_;
};

/// Steps of a series less their mean, under a Hann window, which keeps slow turns out of the
/// frequencies of a gait.
std::vector<double> windowed_steps(std::span<const double> series) {
  const std::size_t count = series.size() - 1;
  const double mean = (series.back() - series.front()) / static_cast<double>(count);
  std::vector<double> steps(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = (2 * static_cast<double>(i) + 1) / static_cast<double>(count) - 1;
    steps[i] = 0.5 * (1 + cosine_pi(turn)) * (series[i + 1] - series[i] - mean);
  }
  return steps;
}

}  // namespace

double dominant_frequency(std::span<const double> x, std::span<const double> y, double interval) {
  if (x.size() < lowest_cycles * fewest_samples + 1) return 0;
  const std::size_t count = x.size() - 1, highest = count / fewest_samples;
  Spectrum spectrum(lowest_cycles - 1, highest - lowest_cycles + 3, count);
  spectrum.add(windowed_steps(x));
  spectrum.add(windowed_steps(y));
  const std::vector<double>& power = spectrum.power();
  std::size_t best = 0;
  for (std::size_t b = 1; b + 1 < power.size(); ++b) {
    const bool is_maximum = power[b] >= power[b - 1] && power[b] > power[b + 1];
    if (is_maximum && (best == 0 || power[b] > power[best])) best = b;
  }
  // A swing of amplitude a has the power (a count / 4)^2 there.
  const double samples = static_cast<double>(count), size = std::sqrt(power[best]);
  if (best == 0 || !(4 * size >= slowest * interval * samples)) return 0;
  // Between two frequencies the window of a swing has sizes of a known ratio.
  const double left = std::sqrt(power[best - 1]), right = std::sqrt(power[best + 1]);
  const double side = std::max(left, right);
  const double shift = std::clamp((2 * side - size) / (side + size), 0.0, 0.5);
  const double cycles =
      static_cast<double>(best + lowest_cycles - 1) + (right >= left ? shift : -shift);
  return cycles / (samples * interval);
}

void GaitWatch::begin(const Scene& scene, double step, std::int64_t steps,
                      std::size_t outline_nodes) {
  stride_ = std::max<std::int64_t>(1, std::llround(look_interval / step));
  next_ = std::max<std::int64_t>(1, std::llround(scene.ramp_steps * paper_step / step));
  interval_ = static_cast<double>(stride_) * step;
  x_.clear();
  y_.clear();
  if (steps >= next_) {
    const auto looks = static_cast<std::size_t>((steps - next_) / stride_ + 1);
    x_.reserve(looks);
    y_.reserve(looks);
  }
  touches_.assign(outline_nodes, 0);
}

void GaitWatch::add(double mean_x, double mean_y) {
  x_.push_back(mean_x);
  y_.push_back(mean_y);
  next_ += stride_;
}

void GaitWatch::finish(Outcome& outcome) const {
  std::int64_t sum = 0, touching_nodes = 0;
  for (const std::int32_t looks : touches_) {
    sum += looks;
    touching_nodes += looks > 0;
  }
  outcome.stance = touching_nodes == 0
                       ? 0
                       : static_cast<double>(sum) / static_cast<double>(touching_nodes) /
                             static_cast<double>(x_.size());
  outcome.gait_frequency = dominant_frequency(x_, y_, interval_);
}

}  // namespace metamorph::core
