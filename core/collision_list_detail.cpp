#include "core/collision_list_detail.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace metamorph::core {

namespace {
/// Width of the skin, d. A wider one is renewed less often and holds more pairs; results do not
/// depend on it.
constexpr double skin = 1.0;
}  // namespace

template <class T>
void CollisionList<T>::reset(const Body& body, const Scene& scene, std::span<const Index> nodes,
                             std::span<const std::array<std::uint32_t, 2>> edges) {
  constexpr auto width = static_cast<std::size_t>(kernels::Lanes<T>::width);
  body_ = &body;
  gap_ = static_cast<T>(scene.collision_gap);
  skin_ = static_cast<T>(skin);
  valid_ = false;
  nodes_ = nodes;
  groups_ = static_cast<int>((nodes.size() + width - 1) / width);
  const auto groups = static_cast<std::size_t>(groups_);
  x_.resize(groups * width);
  y_.resize(groups * width);
  count_ = 0;
  // No more pairs than these can come up, so that nothing is allocated while it runs.
  const std::size_t most = nodes.size() * edges.size() + width;
  if (pair_node_.size() < most) {
    pair_node_.resize(most);
    pair_first_.resize(most);
    pair_second_.resize(most);
    pair_threshold_.resize(most);
  }

  // Outline nodes fill the first lanes, in order.
  edges_.clear();
  for (const auto& [first, second] : edges) {
    edges_.push_back({first, second, nodes[first], nodes[second]});
  }

  std::vector<std::vector<std::size_t>> incident(nodes.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    incident[edges[e][0]].push_back(e);
    incident[edges[e][1]].push_back(e);
  }
  allowed_.assign(edges.size() * groups, 0);
  const auto bit = [&](std::size_t edge,
                       std::size_t node) -> std::pair<std::uint32_t&, std::uint32_t> {
    return {allowed_[edge * groups + node / width], 1u << (node % width)};
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto [word, lane] = bit(e, n);
      word |= lane;
    }
  }
  const auto forbid = [&](std::size_t edge, std::size_t node) {
    const auto [word, lane] = bit(edge, node);
    word &= ~lane;
  };
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    for (const std::size_t first : incident[n]) {
      forbid(first, n);
      const std::size_t other = edges[first][0] == n ? edges[first][1] : edges[first][0];
      for (const std::size_t second : incident[other]) forbid(second, n);
    }
  }
  find_close_at_rest();
}

template <class T>
void CollisionList<T>::find_close_at_rest() {
  constexpr auto width = static_cast<std::size_t>(kernels::Lanes<T>::width);
  const auto groups = static_cast<std::size_t>(groups_);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    x_[n] = static_cast<T>(body_->x[static_cast<std::size_t>(nodes_[n])]);
    y_[n] = static_cast<T>(body_->y[static_cast<std::size_t>(nodes_[n])]);
  }
  close_at_rest_.assign(edges_.size() * groups, 0);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto a = edges_[e].first, b = edges_[e].second;
    for (std::size_t g = 0; g < groups; ++g) {
      close_at_rest_[e * groups + g] =
          kernels::near_segment(x_.data() + g * width, y_.data() + g * width, x_[a], y_[a], x_[b],
                                y_[b], gap_ * T(1.001)) &
          allowed_[e * groups + g];
    }
  }
}

template <class T>
bool CollisionList<T>::stale(const kernels::NodeRecord<T>* records, const T* weight) {
  if (!valid_) return true;
  if (nodes_.empty()) return false;
  // A rigid motion brings no two points closer: only what is left of the motion without it counts,
  // so that a body may swim and roll as far as it likes. Any rigid motion will do; it is fitted
  // anew when the last one no longer does.
  const auto too_far = [&] {
    const T moved2 =
        kernels::farthest_move2(records, x_.data(), y_.data(), weight, groups_, motion_);
    return !(moved2 < skin_ * skin_ / 4);
  };
  if (!too_far()) return false;
  motion_ = kernels::fit_rigid_motion(records, x_.data(), y_.data(), weight, groups_);
  return too_far();
}

template <class T>
void CollisionList<T>::renew(const kernels::NodeRecord<T>* records) {
  constexpr auto width = static_cast<std::size_t>(kernels::Lanes<T>::width);
  const auto groups = static_cast<std::size_t>(groups_);
  count_ = 0;
  for (std::size_t n = 0; n < groups * width; ++n) {
    x_[n] = records[n].x;
    y_[n] = records[n].y;
  }
  const T reach = gap_ + skin_ * T(1.001);  // room for rounding
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Edge& edge = edges_[e];
    const auto a = edge.first, b = edge.second;
    for (std::size_t g = 0; g < groups; ++g) {
      std::uint32_t near = kernels::near_segment(x_.data() + g * width, y_.data() + g * width,
                                                 x_[a], y_[a], x_[b], y_[b], reach) &
                           allowed_[e * groups + g];
      for (; near != 0; near &= near - 1) {
        const int lane = std::countr_zero(near);
        const std::size_t node = g * width + static_cast<std::size_t>(lane);
        const bool close = (close_at_rest_[e * groups + g] >> lane & 1u) != 0;
        add(static_cast<std::uint32_t>(node), a, b, close ? distance_at_rest(node, edge) : gap_);
      }
    }
  }
  while (count_ % width != 0) add(0, 0, 0, T(0));
  valid_ = true;
  motion_ = {T(0), T(0), T(0), T(0), T(1), T(0)};
}

template <class T>
T CollisionList<T>::distance_at_rest(std::size_t node, const Edge& edge) const {
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  const std::size_t i = at(nodes_[node]), j = at(edge.a), k = at(edge.b);
  using Pack = kernels::Lanes<double>;
  const auto rest =
      kernels::nearest_on_segment<double>(Pack(body_->x[i]), Pack(body_->y[i]), Pack(body_->x[j]),
                                          Pack(body_->y[j]), Pack(body_->x[k]), Pack(body_->y[k]));
  return std::min(gap_, static_cast<T>(std::sqrt(rest.distance2[0])));
}

template <class T>
void CollisionList<T>::add(std::uint32_t node, std::uint32_t first, std::uint32_t second,
                           T threshold) {
  pair_node_[count_] = kernels::record_offset<T>(node);
  pair_first_[count_] = kernels::record_offset<T>(first);
  pair_second_[count_] = kernels::record_offset<T>(second);
  pair_threshold_[count_] = threshold;
  ++count_;
}

template <class T>
kernels::CollisionPairs<T> CollisionList<T>::pairs(const kernels::NodeRecord<T>* records,
                                                   const T* weight) {
  if (stale(records, weight)) renew(records);
  return {static_cast<int>(count_), pair_node_.data(), pair_first_.data(), pair_second_.data(),
          pair_threshold_.data()};
}

template class CollisionList<float>;
template class CollisionList<double>;

}  // namespace metamorph::core
