#include "core/collision_list_detail.h"

#include <algorithm>
#include <cmath>

namespace metamorph::core {

namespace {
/// Width of the skin, d. A wider one is renewed less often and holds more pairs; results do not
/// depend on it.
constexpr double skin = 1.0;
}  // namespace

template <class T>
void CollisionList<T>::reset(const Body& body, const Scene& scene,
                             std::span<const OutlineNode> nodes,
                             std::span<const std::array<std::uint32_t, 2>> edges) {
  body_ = &body;
  gap_ = static_cast<T>(scene.collision_gap);
  skin_ = static_cast<T>(skin);
  valid_ = false;
  nodes_ = nodes;
  reference_.resize(nodes.size());
  pairs_.clear();
  pairs_.reserve(nodes.size() * edges.size());

  std::vector<Index> node_of(nodes.size());
  for (const OutlineNode& node : nodes) node_of[node.lane] = node.node;  // outline lanes come first
  edges_.clear();
  for (const auto& edge : edges)
    edges_.push_back({edge[0], edge[1], node_of[edge[0]], node_of[edge[1]]});

  // An outline node's edges, and theirs: two hops.
  std::vector<std::vector<std::size_t>> incident(nodes.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    incident[edges[e][0]].push_back(e);
    incident[edges[e][1]].push_back(e);
  }
  near_begin_.assign(1, 0);
  near_edge_.clear();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    for (std::size_t e : incident[n]) {
      near_edge_.push_back(e);
      const std::size_t other = edges[e][0] == n ? edges[e][1] : edges[e][0];
      near_edge_.insert(near_edge_.end(), incident[other].begin(), incident[other].end());
    }
    near_begin_.push_back(static_cast<int>(near_edge_.size()));
  }
}

template <class T>
bool CollisionList<T>::excluded(std::size_t node, std::size_t edge) const {
  const auto begin = near_edge_.begin() + near_begin_[node];
  const auto end = near_edge_.begin() + near_begin_[node + 1];
  return std::find(begin, end, edge) != end;
}

template <class T>
bool CollisionList<T>::stale(const kernels::NodeRecord<T>* records) const {
  if (!valid_) return true;
  if (nodes_.empty()) return false;
  // Motion that all nodes share brings none closer: take the first node's as the common part.
  const T shift_x = records[nodes_[0].lane].x - reference_[0][0];
  const T shift_y = records[nodes_[0].lane].y - reference_[0][1];
  T farthest2 = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const T dx = records[n].x - reference_[n][0] - shift_x;
    const T dy = records[n].y - reference_[n][1] - shift_y;
    farthest2 = std::max(farthest2, std::fma(dx, dx, dy * dy));
  }
  return !(farthest2 < skin_ * skin_ / 4);
}

template <class T>
void CollisionList<T>::renew(const kernels::NodeRecord<T>* records) {
  pairs_.clear();
  for (std::size_t n = 0; n < nodes_.size(); ++n) reference_[n] = {records[n].x, records[n].y};
  const T reach = gap_ + skin_ * T(1.001);  // room for rounding
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const kernels::NodeRecord<T>& p = records[n];
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const Edge& edge = edges_[e];
      const kernels::NodeRecord<T>&a = records[edge.first], &b = records[edge.second];
      const auto near = kernels::nearest_on_segment(p.x, p.y, a.x, a.y, b.x, b.y);
      if (!(near.distance2 < reach * reach) || excluded(n, e)) continue;
      const auto i = static_cast<std::size_t>(nodes_[n].node);
      const auto j = static_cast<std::size_t>(edge.a), k = static_cast<std::size_t>(edge.b);
      const double rest =
          std::sqrt(kernels::nearest_on_segment(body_->x[i], body_->y[i], body_->x[j], body_->y[j],
                                                body_->x[k], body_->y[k])
                        .distance2);
      pairs_.push_back({static_cast<std::uint32_t>(n), edge.first, edge.second,
                        std::min(gap_, static_cast<T>(rest))});
    }
  }
  valid_ = true;
}

template <class T>
std::span<const kernels::CollisionPair<T>> CollisionList<T>::pairs(
    const kernels::NodeRecord<T>* records) {
  if (stale(records)) renew(records);
  return pairs_;
}

template class CollisionList<float>;
template class CollisionList<double>;

}  // namespace metamorph::core
