#include "evolve/search/niches.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/body/parallel_for.h"
#include "metamorph/random.h"

namespace metamorph::evolve {
namespace {

constexpr int samples_per_centre = 20, rounds = 20;

/// Into the cube; what is no number stands at its low end.
double clamped(double x) { return x > 0 ? std::min(x, 1.0) : 0.0; }

std::size_t nearest(const std::vector<double>& centres, const double* position, std::size_t axes) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < centres.size() / axes; ++c) {
    double square = 0;
    for (std::size_t a = 0; a < axes; ++a) {
      const double difference = position[a] - centres[c * axes + a];
      square += difference * difference;
    }
    if (square < least) {
      least = square;
      best = c;
    }
  }
  return best;
}

}  // namespace

Niches Niches::grid(std::vector<int> bins) {
  Niches niches;
  for (const int n : bins) niches.count_ *= n;
  niches.axes_ = static_cast<int>(bins.size());
  niches.bins_ = std::move(bins);
  return niches;
}

Niches Niches::centroidal(int count, int axes, int threads) {
  Niches niches;
  niches.axes_ = axes;
  niches.count_ = count;
  const auto dimensions = static_cast<std::size_t>(axes), of = static_cast<std::size_t>(count);
  const std::size_t samples = of * samples_per_centre;
  std::vector<double> points(samples * dimensions);
  // Not of the run's seed: maps of all runs are to have the same niches.
  RandomStream stream(Purpose::niche_centre, 0, 0, static_cast<std::uint32_t>(axes));
  for (double& x : points) x = stream.uniform();

  std::vector<double>& centres = niches.centres_;
  centres.assign(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(of * dimensions));
  std::vector<std::size_t> owner(samples);
  for (int round = 0; round < rounds; ++round) {
    core::parallel_for<core::Schedule::equal>(samples, threads, [&](std::size_t sample) {
      owner[sample] = nearest(centres, points.data() + sample * dimensions, dimensions);
    });
    std::vector<double> sums(centres.size(), 0.0);
    std::vector<int> members(of, 0);
    for (std::size_t s = 0; s < samples; ++s) {
      ++members[owner[s]];
      for (std::size_t a = 0; a < dimensions; ++a) {
        sums[owner[s] * dimensions + a] += points[s * dimensions + a];
      }
    }
    for (std::size_t c = 0; c < of; ++c) {
      if (members[c] == 0) continue;  // it stays where it is
      for (std::size_t a = 0; a < dimensions; ++a) {
        centres[c * dimensions + a] = sums[c * dimensions + a] / members[c];
      }
    }
  }
  return niches;
}

int Niches::niche_of(std::span<const double> position) const {
  if (!bins_.empty()) {
    int niche = 0;
    for (std::size_t a = 0; a < bins_.size(); ++a) {
      const int bin = static_cast<int>(clamped(position[a]) * bins_[a]);
      niche = niche * bins_[a] + std::min(bin, bins_[a] - 1);
    }
    return niche;
  }
  std::vector<double> inside(position.begin(), position.end());
  for (double& x : inside) x = clamped(x);
  return static_cast<int>(nearest(centres_, inside.data(), static_cast<std::size_t>(axes_)));
}

}  // namespace metamorph::evolve
