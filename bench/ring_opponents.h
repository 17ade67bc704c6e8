#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/body_batch_detail.h"
#include "kernels/body_step.h"

namespace metamorph::bench {

/// The library's water step with another way of fetching neighbours: lane = node and the arithmetic
/// of kernels::step_body, everything else a template parameter, so that what differs between the
/// opponents below is the fetch alone.
///
/// What a part of the arithmetic costs is seen by leaving it out, or by doing it for oscillators
/// of periods of their own (`parts`).
///
/// A Fetch gives packs of nodes, NodePack own(int place), before(int place), neighbour(int
/// slot_place), edge(int edge_place), and takes the new state, put(int place, NodePack).
enum class Parts { all, without_roots, own_periods };

template <class T, Parts parts, class Fetch>
inline void step_rings(const kernels::BodyView<T>& body, const kernels::StepCoefficients<T>& c,
                       kernels::Turn<T> n, kernels::StepExtremes<T>& seen, Fetch& fetch) {
  using kernels::fma;
  using Pack = kernels::Lanes<T>;
  constexpr int width = Pack::width;
  const Pack zero(T(0)), one(T(1)), tiny(T(1e-12));
  const Pack stiffness(c.stiffness), damping(c.damping), half_pressure_coefficient(c.pressure / 2);
  const Pack amplitude(c.amplitude), h(c.step), extrapolate(c.extrapolate);
  const Pack swing_sine(c.swing_sine), swing_cosine(c.swing_cosine);
  const kernels::DragCoefficients<T> drag{c.drag_normal, c.drag_tangential};

  kernels::StepExtremes<T> extremes = seen;
  for (int g = 0; g < body.groups; ++g) {
    const int place = g * width;
    const kernels::NodePack<T> self = fetch.own(place);
    Pack fx = zero, fy = zero;
    Pack own = one;
    if constexpr (parts == Parts::own_periods) {
      own = fma(amplitude, oscillation(body.node_oscillator, place, n), one);
    }
    Pack before_dx = zero, before_dy = zero;
    if (body.ring_closed[g] != 0) {
      const kernels::NodePack<T> before = fetch.before(place);
      before_dx = before.x - self.x;
      before_dy = before.y - self.y;
    }
    for (int k = 0; k < body.ring_size[g]; ++k) {
      const int slot = (body.ring_begin[g] + k) * width;
      const kernels::NodePack<T> other = fetch.neighbour(slot);
      const Pack dx = other.x - self.x, dy = other.y - self.y;
      Pack length = max(fma(dx, dx, dy * dy), tiny);
      if constexpr (parts != Parts::without_roots) length = sqrt(length);
      const Pack rest_area2 = Pack::load(body.rest_area2 + slot);
      const auto has_triangle = rest_area2 > zero;
      const Pack area2 = select(has_triangle, fma(before_dx, dy, -(before_dy * dx)), one);
      Pack inverse = length * area2;
      if constexpr (parts != Parts::without_roots) inverse = one / inverse;
      const Pack inverse_length = inverse * area2, ratio = rest_area2 * (inverse * length);
      const Pack push =
          select(has_triangle, kernels::half_pressure(ratio, half_pressure_coefficient), zero);
      extremes.largest_ratio = max(ratio, extremes.largest_ratio);
      extremes.smallest_ratio = min(ratio, extremes.smallest_ratio);
      Pack rest_length = Pack::load(body.rest_length + slot);
      if constexpr (parts == Parts::own_periods) {
        rest_length *= fma(amplitude, oscillation(body.ring_oscillator, slot, n), own);
      } else {
        rest_length = fma(swing_sine, Pack::load(body.swing_sine + slot), rest_length);
        rest_length = fma(swing_cosine, Pack::load(body.swing_cosine + slot), rest_length);
      }
      const Pack tension = kernels::spring_tension<T>(
          dx, dy, other.vx - self.vx, other.vy - self.vy, length, inverse_length, rest_length,
          stiffness, damping, Pack::load(body.spring + slot));
      fx = fma(tension, dx, fma(push, before_dy - dy, fx));
      fy = fma(tension, dy, fma(push, dx - before_dx, fy));
      before_dx = dx;
      before_dy = dy;
    }
    if (g < body.outline_groups) {
      for (int e = 0; e < body.edge_size[g]; ++e) {
        const int edge = (body.edge_begin[g] + e) * width;
        const kernels::NodePack<T> other = fetch.edge(edge);
        const Pack half(T(0.5));
        kernels::add_edge_drag<T>(other.x - self.x, other.y - self.y, half * (self.vx + other.vx),
                                  half * (self.vy + other.vy), drag,
                                  Pack::load(body.edge_present + edge), fx, fy);
      }
    }
    const Pack inverse_mass = Pack::load(body.inverse_mass + place);
    const Pack ax = fx * inverse_mass, ay = fy * inverse_mass;
    const Pack vx = fma(h, ax, Pack::load(body.vx + place));
    const Pack vy = fma(h, ay, Pack::load(body.vy + place));
    vx.store(body.vx + place);
    vy.store(body.vy + place);
    fetch.put(place, {fma(h, vx, self.x), fma(h, vy, self.y), fma(extrapolate, ax, vx),
                      fma(extrapolate, ay, vy)});
    const Pack speed2 = fma(vx, vx, vy * vy);
    extremes.largest_speed2 = max(speed2, extremes.largest_speed2);
    extremes.not_finite = fma(speed2, zero, extremes.not_finite);
  }
  seen = extremes;
}

/// State as four arrays instead of records, now and next.
template <class T>
struct StateArrays {
  core::Aligned<T> x, y, vx, vy;

  explicit StateArrays(const kernels::BodyView<T>& body, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      x.push_back(body.now[i].x);
      y.push_back(body.now[i].y);
      vx.push_back(body.now[i].vx);
      vy.push_back(body.now[i].vy);
    }
  }
  kernels::NodePack<T> load(int place) const {
    using Pack = kernels::Lanes<T>;
    return {Pack::load(x.data() + place), Pack::load(y.data() + place),
            Pack::load(vx.data() + place), Pack::load(vy.data() + place)};
  }
  void store(int place, const kernels::NodePack<T>& pack) {
    pack.x.store(x.data() + place);
    pack.y.store(y.data() + place);
    pack.vx.store(vx.data() + place);
    pack.vy.store(vy.data() + place);
  }
};

/// Entries of a batch of one body, in lanes.
template <class T>
struct Extent {
  std::size_t nodes, slots, edges;
  explicit Extent(const kernels::BodyView<T>& body) : nodes(), slots(), edges() {
    constexpr std::size_t width = kernels::Lanes<T>::width;
    nodes = static_cast<std::size_t>(body.groups) * width;
    for (int g = 0; g < body.groups; ++g) slots += static_cast<std::size_t>(body.ring_size[g]);
    for (int g = 0; g < body.outline_groups; ++g)
      edges += static_cast<std::size_t>(body.edge_size[g]);
    slots *= width;
    edges *= width;
  }
};

/// One hardware gather per quantity.
template <class T>
class HardwareGather {
 public:
  explicit HardwareGather(const kernels::BodyView<T>& body)
      : now_(body, Extent<T>(body).nodes), next_(now_) {
    const Extent<T> extent(body);
    const auto places = [](const std::uint32_t* offsets, std::size_t count) {
      core::Aligned<int> list;
      for (std::size_t i = 0; i < count; ++i) {
        list.push_back(static_cast<int>(offsets[i] / sizeof(kernels::NodeRecord<T>)));
      }
      return list;
    };
    before_ = places(body.before, extent.nodes);
    neighbour_ = places(body.neighbour, extent.slots);
    edge_other_ = places(body.edge_other, extent.edges);
  }

  kernels::NodePack<T> own(int place) const { return now_.load(place); }
  kernels::NodePack<T> before(int place) const { return at(before_.data() + place); }
  kernels::NodePack<T> neighbour(int slot) const { return at(neighbour_.data() + slot); }
  kernels::NodePack<T> edge(int edge) const { return at(edge_other_.data() + edge); }
  void put(int place, const kernels::NodePack<T>& pack) { next_.store(place, pack); }
  void end_step() { std::swap(now_, next_); }

  double x(int lane) const { return static_cast<double>(now_.x[static_cast<std::size_t>(lane)]); }

 private:
  kernels::NodePack<T> at(const int* place) const {
    return {gather(now_.x.data(), place), gather(now_.y.data(), place),
            gather(now_.vx.data(), place), gather(now_.vy.data(), place)};
  }
  static kernels::Lanes<T> gather(const T* values, const int* place) {
    using Pack = kernels::Lanes<T>;
#if defined(__AVX512F__)
    // Masked with all lanes on: GCC 12 warns of its own unmasked gathers.
    if constexpr (sizeof(T) == 4) {
      return Pack(_mm512_mask_i32gather_ps(_mm512_setzero_ps(), __mmask16(-1),
                                           _mm512_load_si512(place), values, 4));
    } else {
      const __m256i index = _mm256_load_si256(reinterpret_cast<const __m256i*>(place));
      return Pack(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), __mmask8(-1), index, values, 8));
    }
#elif defined(__AVX2__)
    if constexpr (sizeof(T) == 4) {
      const __m256i index = _mm256_load_si256(reinterpret_cast<const __m256i*>(place));
      return Pack(_mm256_i32gather_ps(values, index, 4));
    } else {
      const __m128i index = _mm_load_si128(reinterpret_cast<const __m128i*>(place));
      return Pack(_mm256_i32gather_pd(values, index, 8));
    }
#else
    Pack pack;
    for (int l = 0; l < Pack::width; ++l) pack.v[l] = values[place[l]];
    return pack;
#endif
  }

  StateArrays<T> now_, next_;
  core::Aligned<int> before_, neighbour_, edge_other_;
};

/// No gather at all: every slot has its neighbour's state, as it was at the start, at its own
/// place. The floor of the ring formulation; what it computes is each node pulled by fixed
/// neighbours.
template <class T>
class Contiguous {
 public:
  explicit Contiguous(const kernels::BodyView<T>& body)
      : state_(body, Extent<T>(body).nodes),
        before_(body, 0),
        neighbour_(body, 0),
        edge_other_(body, 0) {
    const Extent<T> extent(body);
    before_ = copies(body, body.before, extent.nodes);
    neighbour_ = copies(body, body.neighbour, extent.slots);
    edge_other_ = copies(body, body.edge_other, extent.edges);
  }

  kernels::NodePack<T> own(int place) const { return state_.load(place); }
  kernels::NodePack<T> before(int place) const { return before_.load(place); }
  kernels::NodePack<T> neighbour(int slot) const { return neighbour_.load(slot); }
  kernels::NodePack<T> edge(int edge) const { return edge_other_.load(edge); }
  void put(int place, const kernels::NodePack<T>& pack) { state_.store(place, pack); }
  void end_step() {}

  double x(int lane) const { return static_cast<double>(state_.x[static_cast<std::size_t>(lane)]); }

 private:
  static StateArrays<T> copies(const kernels::BodyView<T>& body, const std::uint32_t* offsets,
                               std::size_t count) {
    StateArrays<T> copy(body, 0);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& node = body.now[offsets[i] / sizeof(kernels::NodeRecord<T>)];
      copy.x.push_back(node.x);
      copy.y.push_back(node.y);
      copy.vx.push_back(node.vx);
      copy.vy.push_back(node.vy);
    }
    return copy;
  }

  StateArrays<T> state_, before_, neighbour_, edge_other_;
};

/// The library's own fetch, in this file's copy of the step: must take the library's time.
template <class T>
class Records {
 public:
  explicit Records(const kernels::BodyView<T>& body) : body_(body) {}

  kernels::NodePack<T> own(int place) const { return kernels::load(body_.now + place); }
  kernels::NodePack<T> before(int place) const {
    return kernels::gather(body_.now, body_.before + place);
  }
  kernels::NodePack<T> neighbour(int slot) const {
    return kernels::gather(body_.now, body_.neighbour + slot);
  }
  kernels::NodePack<T> edge(int edge) const {
    return kernels::gather(body_.now, body_.edge_other + edge);
  }
  void put(int place, const kernels::NodePack<T>& pack) { store(pack, body_.next + place); }
  void end_step() { std::swap(body_.now, body_.next); }

  double x(int lane) const { return static_cast<double>(body_.now[lane].x); }

 private:
  kernels::BodyView<T> body_;
};

/// One animat stepped by step_rings() with the given fetch.
template <class T, template <class> class Fetch, Parts parts = Parts::all>
class RingOpponent {
 public:
  RingOpponent(const core::Body& body, const core::Scene& scene)
      : task_{&body, &scene}, batch_({&task_, 1}, true, 1), view_(batch_.view(0)), fetch_(view_) {
    coefficients_.step = static_cast<T>(scene.step);
    coefficients_.extrapolate = static_cast<T>(scene.step / 2);
    coefficients_.stiffness = static_cast<T>(scene.stiffness);
    coefficients_.damping = static_cast<T>(scene.damping);
    coefficients_.pressure = static_cast<T>(scene.pressure);
    coefficients_.drag_normal = static_cast<T>(scene.drag_normal);
    coefficients_.drag_tangential = static_cast<T>(scene.drag_tangential);
  }

  void step(double /*time*/, double amplitude) {
    const kernels::Phasor swing = kernels::phasor(view_.period_advance * count_);
    coefficients_.amplitude = static_cast<T>(amplitude);
    coefficients_.swing_sine = static_cast<T>(amplitude * swing.sine);
    coefficients_.swing_cosine = static_cast<T>(amplitude * swing.cosine);
    step_rings<T, parts>(view_, coefficients_, count_++, seen_, fetch_);
    fetch_.end_step();
  }
  double mean_x() const {
    double sum = 0;
    for (int l = 0; l < view_.nodes; ++l) {
      sum += fetch_.x(l) - static_cast<double>(coefficients_.step / 2 * view_.vx[l]);
    }
    return sum / view_.nodes;
  }
  int animats() const { return 1; }

 private:
  core::LocomotionTask task_;
  core::BodyBatch<T> batch_;
  kernels::BodyView<T> view_;
  Fetch<T> fetch_;
  kernels::StepCoefficients<T> coefficients_{};
  kernels::StepExtremes<T> seen_{};
  kernels::Turn<T> count_ = 0;
};

}  // namespace metamorph::bench
