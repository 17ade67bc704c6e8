#include "core/locomotion/body_batch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/body/parallel_for.h"
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
  std::vector<std::uint8_t> off_period;  ///< [nodes] 1 if the oscillator has another period

  explicit Plan(const Body& body)
      : rings(make_rings(body)), main_period(most_frequent(body.period)) {
    order.resize(at(body.node_count()));
    std::iota(order.begin(), order.end(), 0);
    for (const double period : body.period) off_period.push_back(period != main_period);
    std::vector<std::uint8_t> off_ring = off_period;
    for (const auto& [a, b] : body.springs) {
      off_ring[at(a)] |= off_period[at(b)];
      off_ring[at(b)] |= off_period[at(a)];
    }
    // Outline nodes in front, then by ring size: lanes of a group have nearly equal work.
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const bool outer_a = rings.edges(a) > 0, outer_b = rings.edges(b) > 0;
      if (outer_a != outer_b) return outer_a;
      if (rings.size(a) != rings.size(b)) return rings.size(a) > rings.size(b);
      if (off_ring[at(a)] != off_ring[at(b)]) return off_ring[at(a)] < off_ring[at(b)];
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
  std::vector<Plan> plans;
  plans.reserve(tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) plans.emplace_back(Body{});
  parallel_for<Schedule::dynamic>(tasks.size(), threads, [&](std::size_t index) {
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
  });

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

  groups_.assign(total.groups);
  lanes_.assign(total.groups * width);
  slots_.assign(total.slots * width);
  edge_groups_.assign(total.edge_groups);
  edge_lanes_.assign(total.edge_groups * width);
  edge_slots_.assign(total.edge_slots * width);
  start_.assign(total.groups * width, {});
  node_of_lane_.assign(total.groups * width, -1);
  outline_edges_.resize(total.outline_edges);

  parallel_for<Schedule::dynamic>(tasks.size(), threads, [&](std::size_t index) {
    fill(index, tasks[index], plans[index], midpoint);
  });
}

/// The oscillators of a body's nodes.
template <class T>
struct BodyBatch<T>::Oscillators {
  std::vector<kernels::Turn<T>> start, per_step;
  std::vector<kernels::Phasor> phasor;  ///< at the start; 0, 0 with another than the main period

  Oscillators(const Body& body, const Plan& plan, double step, double first_time)
      : start(body.x.size()), per_step(body.x.size()), phasor(body.x.size(), {0, 0}) {
    for (std::size_t n = 0; n < start.size(); ++n) {
      const double turns = first_time / body.period[n] + body.phase[n] / (2 * std::numbers::pi);
      per_step[n] = fixed_turn<T>(step / body.period[n]);
      start[n] = fixed_turn<T>(turns);
      if (plan.off_period[n] == 0) phasor[n] = kernels::phasor(fixed_turn<double>(turns));
    }
  }
};

template <class T>
void BodyBatch<T>::fill(std::size_t i, const LocomotionTask& task, const Plan& plan,
                        bool midpoint) {
  const Body& body = *task.body;
  const Scene& scene = *task.scene;
  const auto [left, right] = std::minmax_element(body.x.begin(), body.x.end());
  const auto [low, high] = std::minmax_element(body.y.begin(), body.y.end());
  const double middle_x = (*left + *right) / 2;
  const double level = starts_on_ground(scene) ? *low : (*low + *high) / 2;
  origin_[i] = {middle_x, level};
  for (std::size_t lane = 0; lane < plan.order.size(); ++lane) {
    const std::size_t here = offset_[i].groups * width + lane, node = at(plan.order[lane]);
    node_of_lane_[here] = plan.order[lane];
    start_[here] = {static_cast<T>(body.x[node] - middle_x), static_cast<T>(body.y[node] - level),
                    T(0), T(0)};
  }

  advance_[i] = fixed_turn<double>(scene.step / plan.main_period);
  fill_rings(i, task, plan, {body, plan, scene.step, midpoint ? scene.step / 2 : 0});
  fill_edges(i, plan);
  const auto outline = outline_of(body.triangles);
  for (std::size_t e = 0; e < outline.size(); ++e) {
    outline_edges_[offset_[i].outline_edges + e] = {plan.lane[at(outline[e][0])],
                                                    plan.lane[at(outline[e][1])]};
  }
}

template <class T>
void BodyBatch<T>::fill_rings(std::size_t i, const LocomotionTask& task, const Plan& plan,
                              const Oscillators& oscillators) {
  const Body& body = *task.body;
  const auto pressed_area2 = [&](Index triangle) {
    const double area = triangle >= 0 ? body.rest_area[at(triangle)] : 0;
    return area < task.scene->min_pressure_area ? T(0) : static_cast<T>(2 * area);
  };
  const auto slot_of = [&](std::size_t node, const RingSlot& ring) {
    const std::size_t other = at(ring.neighbour);
    const double rest_length = body.rest_length[at(ring.spring)];
    const kernels::Phasor &own = oscillators.phasor[node], &others = oscillators.phasor[other];
    return ShapeSlot<T>{.neighbour = kernels::record_offset<T>(plan.lane[other]),
                        .rest_length = static_cast<T>(rest_length),
                        .spring = 1,
                        .rest_area2 = pressed_area2(ring.triangle),
                        .swing_sine = static_cast<T>(rest_length * (own.cosine + others.cosine)),
                        .swing_cosine = static_cast<T>(rest_length * (own.sine + others.sine)),
                        .off_period = T(plan.off_period[other]),
                        .start = oscillators.start[other],
                        .per_step = oscillators.per_step[other]};
  };

  int first_slot = 0;
  for (int g = 0; g < extent_[i].groups; ++g) {
    ShapeGroup<T> group{.ring_begin = first_slot, .ring_size = plan.group_max(g, &Rings::size)};
    for (int l = 0; l < width; ++l) {
      const auto lane = static_cast<std::uint32_t>(g * width + l);
      ShapeLane<T> own;
      ShapeSlot<T> beyond{.neighbour = kernels::record_offset<T>(lane)};
      int size = 0;
      const auto place = [&](int slot) {
        return (offset_[i].slots + at(first_slot + slot)) * width + at(l);
      };
      if (lane < plan.order.size()) {
        const std::size_t node = at(plan.order[lane]);
        const Index closing = plan.rings.closing[node];
        own = {.inverse_mass = 1,
               .closing_area2 = closing >= 0 ? pressed_area2(closing) : 0,
               .off_period = T(plan.off_period[node]),
               .start = oscillators.start[node],
               .per_step = oscillators.per_step[node]};
        if (closing >= 0) group.ring_closed = 1;
        size = plan.rings.size(plan.order[lane]);
        for (int k = 0; k < size; ++k) {
          const RingSlot& ring = plan.rings.slots[at(plan.rings.begin[node] + k)];
          const ShapeSlot<T> slot = slot_of(node, ring);
          slots_.put(place(k), slot);
          beyond.neighbour = slot.neighbour;
          if (plan.off_period[node] + plan.off_period[at(ring.neighbour)] > 0) group.off_period = 1;
        }
      }
      lanes_.put(offset_[i].groups * width + lane, own);
      // Beyond the ring its last neighbour again, without spring: the vector before stays.
      for (int k = size; k < group.ring_size; ++k) slots_.put(place(k), beyond);
    }
    groups_.put(offset_[i].groups + at(g), group);
    first_slot += group.ring_size;
  }
}

template <class T>
void BodyBatch<T>::fill_edges(std::size_t i, const Plan& plan) {
  const Rings& rings = plan.rings;
  int first_slot = 0;
  for (int g = 0; g < extent_[i].outline_groups; ++g) {
    const ShapeEdgeGroup<T> group{first_slot, plan.group_max(g, &Rings::inner_edges)};
    const std::size_t here = offset_[i].edge_groups + at(g);
    edge_groups_.put(here, group);
    for (int l = 0; l < width; ++l) {
      const auto lane = static_cast<std::uint32_t>(g * width + l);
      const Index node = lane < plan.order.size() ? plan.order[lane] : -1;
      if (node >= 0 && rings.edges(node) > 0) edge_lanes_.put(here * width + at(l), {1});
      const int size = node >= 0 ? rings.inner_edges(node) : 0;
      for (int e = 0; e < group.edge_size; ++e) {
        ShapeEdgeSlot<T> slot{kernels::record_offset<T>(lane), 0};
        if (e < size) {
          const Index other = rings.edge_other[at(rings.edge_begin[at(node)] + 1 + e)];
          slot = {kernels::record_offset<T>(plan.lane[at(other)]), 1};
        }
        edge_slots_.put((offset_[i].edge_slots + at(first_slot + e)) * width + at(l), slot);
      }
    }
    first_slot += group.edge_size;
  }
}

template <class T>
kernels::BodyShape<T> BodyBatch<T>::shape(std::size_t i) const {
  const Extent& extent = extent_[i];
  const Offset& offset = offset_[i];
  kernels::BodyShape<T> shape;
  shape.nodes = extent.nodes;
  shape.groups = extent.groups;
  shape.outline_groups = extent.outline_groups;
  groups_.show(offset.groups, shape);
  lanes_.show(offset.groups * width, shape);
  slots_.show(offset.slots * width, shape);
  edge_groups_.show(offset.edge_groups, shape);
  edge_lanes_.show(offset.edge_groups * width, shape);
  edge_slots_.show(offset.edge_slots * width, shape);
  shape.mixed_periods = std::any_of(shape.off_period, shape.off_period + extent.groups,
                                    [](int off_period) { return off_period != 0; });
  shape.advance = advance_[i];
  return shape;
}

template <class T>
kernels::BodyState<T> BodyBatch<T>::start(std::size_t i, StateBuffers<T>& buffers) const {
  const std::size_t lanes = at(extent_[i].groups) * width;
  const auto start = start_.begin() + static_cast<std::ptrdiff_t>(offset_[i].groups * width);
  buffers.now.assign(start, start + static_cast<std::ptrdiff_t>(lanes));
  buffers.next.assign(lanes, {});
  for (auto* values : {&buffers.vx, &buffers.vy, &buffers.extra_fx, &buffers.extra_fy}) {
    values->assign(lanes, T(0));
  }
  return {buffers.now.data(), buffers.next.data(),     buffers.vx.data(),
          buffers.vy.data(),  buffers.extra_fx.data(), buffers.extra_fy.data()};
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
