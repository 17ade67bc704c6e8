#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "metamorph/network.h"

namespace metamorph::evolve::testing {

/// Factor on the sum of every node: with it tanh(x/2) is as steep as the sigmoid
/// 1 / (1 + exp(-4.9 x)) of Stanley and Miikkulainen (2002).
inline constexpr double stanley_slope = 4.9;

/// A network that answers questions, in double precision. Its last input is the bias.
class Controller {
 public:
  Controller(core::Network network, double slope) : network_(std::move(network)) {
    for (const float weight : network_.weight)
      weights_.push_back(slope * static_cast<double>(weight));
    values_.resize(static_cast<std::size_t>(network_.inputs + network_.node_count()));
    values_[static_cast<std::size_t>(network_.inputs) - 1] = 1;
    answers_.resize(network_.output.size());
  }

  /// [outputs] from -1 to 1 for [inputs but the bias]. Valid until it is asked again.
  std::span<const double> operator()(std::span<const double> question) {
    for (std::size_t i = 0; i < question.size(); ++i) values_[i] = question[i];
    const std::size_t inputs = static_cast<std::size_t>(network_.inputs);
    for (std::size_t n = 0; n + 1 < network_.first_link.size(); ++n) {
      double sum = 0;
      const std::size_t end = static_cast<std::size_t>(network_.first_link[n + 1]);
      for (std::size_t l = static_cast<std::size_t>(network_.first_link[n]); l < end; ++l)
        sum += weights_[l] * values_[static_cast<std::size_t>(network_.source[l])];
      values_[inputs + n] = 1 - 2 / (1 + std::exp(sum));  // tanh(sum / 2)
    }
    for (std::size_t o = 0; o < answers_.size(); ++o)
      answers_[o] = values_[static_cast<std::size_t>(network_.output[o])];
    return answers_;
  }

 private:
  core::Network network_;
  std::vector<double> weights_;  ///< [links] with the slope
  std::vector<double> values_;   ///< [slots]
  std::vector<double> answers_;  ///< [outputs]
};

}  // namespace metamorph::evolve::testing
