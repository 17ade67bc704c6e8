#include "evolve/study/bootstrap.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <string>

#include "evolve/run/table_digest.h"
#include "metamorph/random.h"

namespace metamorph::evolve {

namespace {

/// The same of a sample whose order may be lost.
double centre_within(std::span<double> sample, Centre centre) {
  if (centre == Centre::mean) {
    return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
  }
  const auto middle = sample.begin() + std::ssize(sample) / 2;
  std::nth_element(sample.begin(), middle, sample.end());
  if (sample.size() % 2 == 1) return *middle;
  return 0.5 * (*std::max_element(sample.begin(), middle) + *middle);
}

}  // namespace

double centre_of(std::span<const double> sample, Centre centre) {
  std::vector<double> copy(sample.begin(), sample.end());
  return centre_within(copy, centre);
}

Bootstrap::Bootstrap(std::span<const std::uint64_t> seeds) : size_(seeds.size()) {
  std::string key;
  for (const std::uint64_t seed : seeds) append_bytes(key, seed);
  RandomStream stream(Purpose::bootstrap, hash_of(key), 0, 0);
  drawn_.resize(resamples * size_);
  for (std::uint32_t& position : drawn_) position = stream.below(static_cast<std::uint32_t>(size_));
}

Interval Bootstrap::interval(std::span<const double> sample, Centre centre) const {
  assert(sample.size() == size_);
  std::vector<double> centres, resample(size_);
  centres.reserve(resamples);
  for (auto drawn = drawn_.begin(); drawn != drawn_.end();) {
    for (double& value : resample) value = sample[*drawn++];
    centres.push_back(centre_within(resample, centre));
  }
  const auto low = centres.begin() + beyond, high = centres.end() - 1 - beyond;
  std::nth_element(centres.begin(), low, centres.end());
  std::nth_element(low + 1, high, centres.end());
  return {*low, *high};
}

}  // namespace metamorph::evolve
