#include <algorithm>
#include <array>

#include "core/locomotion/runner.h"

namespace metamorph::core {

/// Extent of the nodes in y, d.
template <class T>
double Runner<T>::height() const {
  double least = position_y(0), most = least;
  for (int l = 1; l < shape_.nodes; ++l) {
    least = std::min(least, position_y(l));
    most = std::max(most, position_y(l));
  }
  return most - least;
}

/// Between two steps: looks where the body is and what of it touches the ground.
template <class T>
void Runner<T>::look_at_gait() {
  // The mean of what the records hold: half a step on, which no frequency minds. Four sums, so that
  // additions need not wait for each other.
  constexpr int sums = 4;
  std::array<double, sums> x{}, y{};
  int l = 0;
  for (; l + sums <= shape_.nodes; l += sums) {
    for (int k = 0; k < sums; ++k) {
      x[static_cast<std::size_t>(k)] += static_cast<double>(state_.now[l + k].x);
      y[static_cast<std::size_t>(k)] += static_cast<double>(state_.now[l + k].y);
    }
  }
  for (; l < shape_.nodes; ++l) {
    x[0] += static_cast<double>(state_.now[l].x);
    y[0] += static_cast<double>(state_.now[l].y);
  }
  gait_.add(((x[0] + x[1]) + (x[2] + x[3])) / shape_.nodes,
            ((y[0] + y[1]) + (y[2] + y[3])) / shape_.nodes);
  if (!scene_->ground) return;
  // Nodes of the outline stand in the first lanes.
  const std::span<std::int32_t> touches = gait_.touches();
  for (std::size_t node = 0; node < touches.size(); ++node) {
    touches[node] += position_y(static_cast<int>(node)) <= GaitWatch::touching;
  }
}

template double Runner<float>::height() const;
template void Runner<float>::look_at_gait();
template double Runner<double>::height() const;
template void Runner<double>::look_at_gait();

}  // namespace metamorph::core
