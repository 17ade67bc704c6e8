#include "core/locomotion/collision_list.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/locomotion/solid_pairs.h"

namespace metamorph::core {

namespace {
/// Widths of the skins, d: of the blocks and of the pairs. A wider one is renewed less often and
/// holds more; results do not depend on them. Chosen for the cycles that evolved bodies take.
constexpr double wide_skin = 3.0;
constexpr double narrow_skin = 0.5;
constexpr double room = 1.001;  ///< for rounding
}  // namespace

template <class T>
void CollisionList<T>::reset(const Body& body, const Scene& scene, const BodyBatch<T>& batch,
                             std::size_t i) {
  const auto edges = batch.outline_edges(i);
  gap_ = static_cast<T>(scene.collision_gap);
  spare_ = static_cast<T>(std::max(scene.collision_gap - scene.collision_least_gap, 0.0) / 2);
  nodes_ = batch.outline_nodes(i);
  edges_ = edges.size();
  const std::size_t outline_groups = (nodes_.size() + width - 1) / width;
  block_watch_.reset(static_cast<int>(outline_groups));
  pair_watch_.reset(static_cast<int>(outline_groups));
  line_up(edges);
  list_all_blocks(edges);
  find_close_at_rest(body, edges);
  find_lasting(body, scene, batch.node_of_lane(i));
  groups_ =
      static_cast<int>(lasting_.empty() ? outline_groups : batch.node_of_lane(i).size() / width);
  // No more pairs than these can come up, so that nothing is allocated while it runs.
  const std::size_t most = nodes_.size() * edges.size() + lasting_.size() + width;
  if (pair_node_.size() < most) {
    pair_node_.resize(most);
    pair_first_.resize(most);
    pair_second_.resize(most);
    pair_threshold_.resize(most);
    approaches_.resize(most);
  }
}

/// Puts the nodes in the order of walks along the outline.
template <class T>
void CollisionList<T>::line_up(std::span<const Edge> edges) {
  const std::size_t filled = (edges.size() + width - 1) / width * width;
  first_.assign(filled, 0);
  second_.assign(filled, 0);
  circles_.resize(filled);
  std::vector<std::vector<std::uint32_t>> leaving(nodes_.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    first_[e] = kernels::record_offset<T>(edges[e][0]);
    second_[e] = kernels::record_offset<T>(edges[e][1]);
    leaving[edges[e][0]].push_back(edges[e][1]);
  }

  node_.clear();
  std::vector<bool> seen(nodes_.size());
  place_.resize(nodes_.size());
  for (std::size_t start = 0; start < nodes_.size(); ++start) {
    std::size_t n = start;
    while (true) {
      if (!seen[n]) {
        seen[n] = true;
        place_[n] = node_.size();
        node_.push_back(kernels::record_offset<T>(static_cast<std::uint32_t>(n)));
      }
      if (leaving[n].empty()) break;
      const std::uint32_t next = leaving[n].back();
      leaving[n].pop_back();
      n = next;
    }
  }
  node_.resize((node_.size() + width - 1) / width * width, 0);
  x_.resize(node_.size());
  y_.resize(node_.size());
}

/// With the nodes that may collide with the edge.
template <class T>
void CollisionList<T>::list_all_blocks(std::span<const Edge> edges) {
  all_.clear();
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    for (std::uint32_t place = 0; place < node_.size(); place += width)
      all_.push_back({e, place, 0});
  }
  wide_.resize(all_.size() + 1);
  narrow_.resize(all_.size() + 1);

  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const std::size_t p : place_) block(e, p).lanes |= lane(p);
    for (const std::uint32_t end : edges[e]) block(e, place_[end]).lanes &= ~lane(place_[end]);
  }
}

template <class T>
void CollisionList<T>::find_close_at_rest(const Body& body, std::span<const Edge> edges) {
  using Pack = kernels::Lanes<double>;
  const auto x = [&](std::size_t n) { return body.x[static_cast<std::size_t>(nodes_[n])]; };
  const auto y = [&](std::size_t n) { return body.y[static_cast<std::size_t>(nodes_[n])]; };
  close_at_rest_.clear();
  for (std::size_t e = 0; e < edges_; ++e) {
    const auto [a, b] = edges[e];
    const double middle_x = (x(a) + x(b)) / 2, middle_y = (y(a) + y(b)) / 2;
    const double half = std::hypot(x(b) - x(a), y(b) - y(a)) / 2;
    const double radius = (static_cast<double>(gap_) + half) * room;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const double dx = x(n) - middle_x, dy = y(n) - middle_y;
      const std::size_t p = place_[n];
      const bool may_collide = (block(e, p).lanes & lane(p)) != 0;
      if (!may_collide || dx * dx + dy * dy > radius * radius) continue;
      const auto nearest = kernels::nearest_on_segment<double>(Pack(x(n)), Pack(y(n)), Pack(x(a)),
                                                               Pack(y(a)), Pack(x(b)), Pack(y(b)));
      const auto distance = static_cast<T>(std::sqrt(nearest.distance2[0]));
      if (distance < gap_) close_at_rest_.push_back({e, p, distance});
    }
  }
}

template <class T>
void CollisionList<T>::find_lasting(const Body& body, const Scene& scene,
                                    std::span<const Index> node_of_lane) {
  lasting_.clear();
  const auto offset = [&](Index node) {
    const auto lane = std::find(node_of_lane.begin(), node_of_lane.end(), node);
    return kernels::record_offset<T>(static_cast<std::uint32_t>(lane - node_of_lane.begin()));
  };
  for (const SolidPair& pair : corners_without_pressure(body, scene)) {
    lasting_.push_back({offset(pair.node), offset(pair.edge[0]), offset(pair.edge[1]),
                        static_cast<T>(pair.threshold)});
  }
}

template <class T>
T CollisionList<T>::threshold(std::size_t edge, std::size_t place) const {
  for (const CloseAtRest& pair : close_at_rest_) {
    if (pair.edge == edge && pair.place == place) return pair.threshold;
  }
  return gap_;
}

/// Nodes by place and circles of edges with `reach` around them.
template <class T>
void CollisionList<T>::measure(const kernels::NodeRecord<T>* records, T reach) {
  kernels::circle_edges(records, first_.data(), second_.data(),
                        static_cast<int>(first_.size() / width), reach, circles_.data());
  for (std::size_t p = 0; p < node_.size(); p += width) {
    const kernels::NodePack<T> node = kernels::gather(records, node_.data() + p);
    node.x.store(x_.data() + p);
    node.y.store(y_.data() + p);
  }
}

/// The blocks hold all pairs that a list made of them needs, one that holds until something has
/// moved by `limit` at least.
template <class T>
void CollisionList<T>::renew_blocks(const kernels::NodeRecord<T>* records, T limit) {
  const T half_skin = static_cast<T>((wide_skin - narrow_skin) / 2) + limit;
  block_watch_.mark(records, half_skin);
  measure(records, gap_ + 2 * half_skin * static_cast<T>(room));
  wide_end_ = kernels::copy_circled(all_.data(), all_.data() + all_.size(), circles_.data(),
                                    x_.data(), y_.data(), wide_.data());
}

/// So that the list holds until something has moved by `limit`.
template <class T>
void CollisionList<T>::renew_pairs(const kernels::NodeRecord<T>* records, T limit) {
  pair_watch_.mark(records, limit);
  const T reach = gap_ + 2 * limit * static_cast<T>(room);
  measure(records, reach);
  kernels::CollisionBlock* const begin = narrow_.data();
  kernels::CollisionBlock* end =
      kernels::copy_circled(wide_.data(), wide_end_, circles_.data(), x_.data(), y_.data(), begin);
  end = kernels::copy_near(begin, end, records, first_.data(), second_.data(), x_.data(), y_.data(),
                           reach, begin);
  count_ = 0;
  for (const kernels::CollisionBlock* found = begin; found != end; ++found) {
    for (std::uint32_t near = found->lanes; near != 0; near &= near - 1) {
      const std::size_t p = found->place + static_cast<std::size_t>(std::countr_zero(near));
      add(node_[p], first_[found->edge], second_[found->edge], threshold(found->edge, p));
    }
  }
  for (const LastingPair& pair : lasting_)
    append(pair.node, pair.first, pair.second, pair.threshold);
  while (count_ % width != 0) append(0, 0, 0, T(0));
}

template <class T>
void CollisionList<T>::append(std::uint32_t node, std::uint32_t first, std::uint32_t second,
                              T threshold) {
  pair_node_[count_] = node;
  pair_first_[count_] = first;
  pair_second_[count_] = second;
  pair_threshold_[count_] = threshold;
  ++count_;
}

/// Pairs of an edge stay sorted by node of the body.
template <class T>
void CollisionList<T>::add(std::uint32_t node, std::uint32_t first, std::uint32_t second,
                           T threshold) {
  const auto number = [&](std::uint32_t offset) {
    return nodes_[offset / kernels::record_offset<T>(1)];
  };
  append(node, first, second, threshold);
  for (std::size_t i = count_ - 1;
       i > 0 && pair_first_[i - 1] == first && pair_second_[i - 1] == second &&
       number(pair_node_[i - 1]) > number(node);
       --i) {
    std::swap(pair_node_[i - 1], pair_node_[i]);
    std::swap(pair_threshold_[i - 1], pair_threshold_[i]);
  }
}

template <class T>
kernels::CollisionPairs<T> CollisionList<T>::pairs(const kernels::NodeRecord<T>* records,
                                                   const T* weight, T reach) {
  // What each of a pair must be watched for beyond the gap.
  const T beyond = std::max(reach / 2 - spare_, T(0));
  if (!pair_watch_.holds(records, weight, beyond)) {
    const T limit = static_cast<T>(narrow_skin / 2) + beyond;
    if (!block_watch_.holds(records, weight, limit)) renew_blocks(records, limit);
    renew_pairs(records, limit);
  }
  return {static_cast<int>(count_), pair_node_.data(), pair_first_.data(), pair_second_.data(),
          pair_threshold_.data()};
}

template class CollisionList<float>;
template class CollisionList<double>;

}  // namespace metamorph::core
