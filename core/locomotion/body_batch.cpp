#include "core/locomotion/body_batch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/locomotion/rings.h"

namespace metamorph::core {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// A number of turns in fixed point, modulo whole turns; exact in double, to 2^-33 turn in float.
template <class T>
kernels::Turn<T> fixed_turn(double turns) {
  const double fraction = turns - std::floor(turns);
  if constexpr (sizeof(T) == 4) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::ldexp(fraction, 32) + 0.5));
  } else {
    return static_cast<std::uint64_t>(std::ldexp(fraction, 64));
  }
}

/// The value that comes up most often, the least of them.
double most_frequent(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double found = 1;
  std::ptrdiff_t most = 0;
  for (auto run = values.begin(); run != values.end();) {
    const auto end = std::upper_bound(run, values.end(), *run);
    if (end - run > most) {
      most = end - run;
      found = *run;
    }
    run = end;
  }
  return found;
}

}  // namespace

/// How one body is laid out: found first for all bodies, so that the arrays can be sized once.
template <class T>
struct BodyBatch<T>::Plan {
  Rings rings;
  std::vector<Index> order;         ///< lane -> node
  std::vector<std::uint32_t> lane;  ///< node -> lane
  int outline_nodes = 0;
  double main_period;
  std::vector<std::uint8_t> odd;  ///< [nodes] 1 if the oscillator has another period

  explicit Plan(const Body& body)
      : rings(make_rings(body)), main_period(most_frequent(body.period)) {
    order.resize(at(body.node_count()));
    std::iota(order.begin(), order.end(), 0);
    for (const double period : body.period) odd.push_back(period != main_period);
    std::vector<std::uint8_t> odd_ring = odd;
    for (const auto& [a, b] : body.springs) {
      odd_ring[at(a)] |= odd[at(b)];
      odd_ring[at(b)] |= odd[at(a)];
    }
    // Outline nodes in front, then by ring size: lanes of a group have nearly equal work.
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const bool outer_a = rings.edges(a) > 0, outer_b = rings.edges(b) > 0;
      if (outer_a != outer_b) return outer_a;
      if (rings.size(a) != rings.size(b)) return rings.size(a) > rings.size(b);
      if (odd_ring[at(a)] != odd_ring[at(b)]) return odd_ring[at(a)] < odd_ring[at(b)];
      return a < b;
    });
    lane.resize(order.size());
    for (std::size_t l = 0; l < order.size(); ++l)
      lane[at(order[l])] = static_cast<std::uint32_t>(l);
    outline_nodes = static_cast<int>(
        std::count_if(order.begin(), order.end(), [&](Index n) { return rings.edges(n) > 0; }));
  }

  int group_max(int group, int (Rings::*size)(Index) const) const {
    int largest = 0;
    for (int l = group * width;
         l < std::min<int>((group + 1) * width, static_cast<int>(order.size())); ++l) {
      largest = std::max(largest, (rings.*size)(order[at(l)]));
    }
    return largest;
  }
};

template <class T>
BodyBatch<T>::BodyBatch(std::span<const LocomotionTask> tasks, bool midpoint, int threads)
    : extent_(tasks.size()),
      offset_(tasks.size() + 1),
      advance_(tasks.size()),
      origin_(tasks.size()) {
  const auto count = static_cast<std::int64_t>(tasks.size());
  std::vector<Plan> plans;
  plans.reserve(tasks.size());
  for (std::int64_t i = 0; i < count; ++i) plans.emplace_back(Body{});
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    Plan plan(*tasks[index].body);
    Extent extent{};
    extent.nodes = static_cast<int>(plan.order.size());
    extent.groups = (extent.nodes + width - 1) / width;
    extent.outline_groups = (plan.outline_nodes + width - 1) / width;
    extent.outline_nodes = plan.outline_nodes;
    extent.outline_edges = static_cast<int>(plan.rings.edge_other.size()) / 2;
    for (int g = 0; g < extent.groups; ++g) extent.slots += plan.group_max(g, &Rings::size);
    for (int g = 0; g < extent.outline_groups; ++g) {
      extent.edge_slots += plan.group_max(g, &Rings::inner_edges);
    }
    extent_[index] = extent;
    plans[index] = std::move(plan);
  }

  Offset total{};
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Extent& extent = extent_[i];
    offset_[i] = total;
    total.groups += at(extent.groups);
    total.slots += at(extent.slots);
    total.edge_groups += at(extent.outline_groups);
    total.edge_slots += at(extent.edge_slots);
    total.outline_edges += at(extent.outline_edges);
  }
  offset_.back() = total;

  const std::size_t lanes = total.groups * width, slots = total.slots * width;
  ring_begin_.resize(total.groups);
  ring_size_.resize(total.groups);
  ring_closed_.resize(total.groups);
  odd_.resize(total.groups);
  closing_area2_.assign(lanes, T(0));
  edge_begin_.resize(total.edge_groups);
  edge_size_.resize(total.edge_groups);
  neighbour_.resize(slots);
  rest_length_.assign(slots, T(1));
  spring_.assign(slots, T(0));
  rest_area2_.assign(slots, T(0));
  ring_start_.resize(slots);
  ring_per_step_.resize(slots);
  swing_sine_.assign(slots, T(0));
  swing_cosine_.assign(slots, T(0));
  ring_odd_.assign(slots, T(0));
  node_odd_.assign(lanes, T(0));
  on_outline_.assign(total.edge_groups * width, T(0));
  edge_other_.resize(total.edge_slots * width);
  edge_present_.assign(total.edge_slots * width, T(0));
  inverse_mass_.assign(lanes, T(0));
  node_start_.resize(lanes);
  node_per_step_.resize(lanes);
  start_.assign(lanes, {});
  node_of_lane_.assign(lanes, -1);
  outline_edges_.resize(total.outline_edges);

#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    fill(index, tasks[index], plans[index], midpoint);
  }
}

template <class T>
void BodyBatch<T>::fill(std::size_t i, const LocomotionTask& task, const Plan& plan,
                        bool midpoint) {
  const Body& body = *task.body;
  const Scene& scene = *task.scene;
  const Extent& extent = extent_[i];
  const Offset& offset = offset_[i];
  const auto nodes = static_cast<std::size_t>(extent.nodes);
  const auto [left, right] = std::minmax_element(body.x.begin(), body.x.end());
  const auto [low, high] = std::minmax_element(body.y.begin(), body.y.end());
  const double middle_x = (*left + *right) / 2;
  const double level = scene.ground ? *low : (*low + *high) / 2;
  origin_[i] = {middle_x, level};
  const double first_time = midpoint ? scene.step / 2 : 0;

  std::vector<kernels::Turn<T>> start(nodes), per_step(nodes);
  std::vector<kernels::Phasor> phasor(nodes, {0, 0});
  for (std::size_t n = 0; n < nodes; ++n) {
    const double turns = first_time / body.period[n] + body.phase[n] / (2 * std::numbers::pi);
    per_step[n] = fixed_turn<T>(scene.step / body.period[n]);
    start[n] = fixed_turn<T>(turns);
    if (plan.odd[n] == 0) phasor[n] = kernels::phasor(fixed_turn<double>(turns));
  }
  advance_[i] = fixed_turn<double>(scene.step / plan.main_period);

  const auto pressed_area2 = [&](Index triangle) {
    const double area = triangle >= 0 ? body.rest_area[at(triangle)] : 0;
    return area < scene.min_pressure_area ? T(0) : static_cast<T>(2 * area);
  };

  int slot = 0;
  for (int g = 0; g < extent.groups; ++g) {
    const std::size_t group = offset.groups + at(g);
    ring_begin_[group] = slot;
    ring_size_[group] = plan.group_max(g, &Rings::size);
    for (int l = 0; l < width; ++l) {
      const auto lane = static_cast<std::uint32_t>(g * width + l);
      const std::size_t here = (offset.groups * width) + lane;
      const bool real = lane < nodes;
      const auto node = real ? at(plan.order[lane]) : 0;
      if (real) {
        node_of_lane_[here] = plan.order[lane];
        inverse_mass_[here] = T(1);
        node_odd_[here] = T(plan.odd[node]);
        node_start_[here] = start[node];
        node_per_step_[here] = per_step[node];
        start_[here] = {static_cast<T>(body.x[node] - middle_x),
                        static_cast<T>(body.y[node] - level), T(0), T(0)};
      }
      const int size = real ? plan.rings.size(plan.order[lane]) : 0;
      if (real && plan.rings.closing[node] >= 0) {
        ring_closed_[group] = 1;
        closing_area2_[here] = pressed_area2(plan.rings.closing[node]);
      }
      for (int k = 0; k < ring_size_[group]; ++k) {
        const std::size_t place = (offset.slots + at(slot + k)) * width + at(l);
        if (k >= size) {
          // Beyond the ring its last neighbour again, without spring: the vector before stays.
          neighbour_[place] = k > 0 ? neighbour_[place - width] : kernels::record_offset<T>(lane);
          continue;
        }
        const RingSlot& ring = plan.rings.slots[at(plan.rings.begin[node] + k)];
        neighbour_[place] = kernels::record_offset<T>(plan.lane[at(ring.neighbour)]);
        ring_start_[place] = start[at(ring.neighbour)];
        ring_per_step_[place] = per_step[at(ring.neighbour)];
        const double rest_length = body.rest_length[at(ring.spring)];
        const kernels::Phasor &own = phasor[node], &other = phasor[at(ring.neighbour)];
        ring_odd_[place] = T(plan.odd[at(ring.neighbour)]);
        if (plan.odd[node] + plan.odd[at(ring.neighbour)] > 0) odd_[group] = 1;
        spring_[place] = T(1);
        rest_length_[place] = static_cast<T>(rest_length);
        swing_sine_[place] = static_cast<T>(rest_length * (own.cosine + other.cosine));
        swing_cosine_[place] = static_cast<T>(rest_length * (own.sine + other.sine));
        rest_area2_[place] = pressed_area2(ring.triangle);
      }
    }
    slot += ring_size_[group];
  }

  int edge_slot = 0;
  for (int g = 0; g < extent.outline_groups; ++g) {
    const std::size_t group = offset.edge_groups + at(g);
    edge_begin_[group] = edge_slot;
    edge_size_[group] = plan.group_max(g, &Rings::inner_edges);
    for (int l = 0; l < width; ++l) {
      const auto lane = static_cast<std::uint32_t>(g * width + l);
      const Index node = lane < nodes ? plan.order[lane] : -1;
      if (node >= 0 && plan.rings.edges(node) > 0) on_outline_[group * width + at(l)] = T(1);
      const int size = node >= 0 ? plan.rings.inner_edges(node) : 0;
      for (int e = 0; e < edge_size_[group]; ++e) {
        const std::size_t place = (offset.edge_slots + at(edge_slot + e)) * width + at(l);
        edge_other_[place] = kernels::record_offset<T>(lane);
        if (e < size) {
          edge_other_[place] = kernels::record_offset<T>(
              plan.lane[at(plan.rings.edge_other[at(plan.rings.edge_begin[at(node)] + 1 + e)])]);
          edge_present_[place] = T(1);
        }
      }
    }
    edge_slot += edge_size_[group];
  }

  const auto outline = outline_of(body.triangles);
  for (std::size_t e = 0; e < outline.size(); ++e) {
    outline_edges_[offset.outline_edges + e] = {plan.lane[at(outline[e][0])],
                                                plan.lane[at(outline[e][1])]};
  }
}

template <class T>
kernels::BodyView<T> BodyBatch<T>::view(std::size_t i, BodyState<T>& state) const {
  const Extent& extent = extent_[i];
  const Offset& offset = offset_[i];
  const std::size_t lanes = offset.groups * width, slots = offset.slots * width;
  kernels::BodyView<T> view;
  view.nodes = extent.nodes;
  view.groups = extent.groups;
  view.outline_groups = extent.outline_groups;
  view.odd = odd_.data() + offset.groups;
  view.ring_begin = ring_begin_.data() + offset.groups;
  view.ring_size = ring_size_.data() + offset.groups;
  view.ring_closed = ring_closed_.data() + offset.groups;
  view.closing_area2 = closing_area2_.data() + lanes;
  view.neighbour = neighbour_.data() + slots;
  view.rest_length = rest_length_.data() + slots;
  view.spring = spring_.data() + slots;
  view.rest_area2 = rest_area2_.data() + slots;
  view.ring_oscillator = {ring_start_.data() + slots, ring_per_step_.data() + slots};
  view.swing_sine = swing_sine_.data() + slots;
  view.swing_cosine = swing_cosine_.data() + slots;
  view.mixed_periods =
      std::any_of(view.odd, view.odd + extent.groups, [](int odd) { return odd != 0; });
  view.advance = advance_[i];
  view.ring_odd = ring_odd_.data() + slots;
  view.node_odd = node_odd_.data() + lanes;
  view.node_oscillator = {node_start_.data() + lanes, node_per_step_.data() + lanes};
  view.inverse_mass = inverse_mass_.data() + lanes;
  view.edge_begin = edge_begin_.data() + offset.edge_groups;
  view.edge_size = edge_size_.data() + offset.edge_groups;
  view.on_outline = on_outline_.data() + offset.edge_groups * width;
  view.edge_other = edge_other_.data() + offset.edge_slots * width;
  view.edge_present = edge_present_.data() + offset.edge_slots * width;
  const std::size_t own = at(extent.groups) * width;
  const auto start = start_.begin() + static_cast<std::ptrdiff_t>(lanes);
  state.now.assign(start, start + static_cast<std::ptrdiff_t>(own));
  state.next.assign(own, {});
  for (auto* values : {&state.vx, &state.vy, &state.extra_fx, &state.extra_fy}) {
    values->assign(own, T(0));
  }
  view.now = state.now.data();
  view.next = state.next.data();
  view.vx = state.vx.data();
  view.vy = state.vy.data();
  view.extra_fx = state.extra_fx.data();
  view.extra_fy = state.extra_fy.data();
  return view;
}

template <class T>
std::span<const Index> BodyBatch<T>::node_of_lane(std::size_t i) const {
  return {node_of_lane_.data() + offset_[i].groups * width, at(extent_[i].groups) * width};
}

template <class T>
std::span<const Index> BodyBatch<T>::outline_nodes(std::size_t i) const {
  return node_of_lane(i).first(at(extent_[i].outline_nodes));
}

template <class T>
std::span<const std::array<std::uint32_t, 2>> BodyBatch<T>::outline_edges(std::size_t i) const {
  return {outline_edges_.data() + offset_[i].outline_edges, at(extent_[i].outline_edges)};
}

template class BodyBatch<float>;
template class BodyBatch<double>;

}  // namespace metamorph::core
