#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/locomotion/body_batch.h"
#include "core/locomotion/scene_terms.h"
#include "kernels/body_step.h"

// The library's own step with other ways of fetching neighbours: lane = node and the same
// arithmetic, so that what differs between these opponents is the fetch alone.

namespace metamorph::bench {

/// The library's records, one hardware gather per quantity.
template <class T>
class HardwareGather {
 public:
  HardwareGather(const kernels::BodyShape<T>& shape, kernels::BodyState<T>& state)
      : shape_(shape), state_(state) {}

  kernels::NodePack<T> own(int lane) const { return kernels::load(state_.now + lane); }
  kernels::NodePack<T> neighbour(int slot) const { return at(shape_.neighbour + slot); }
  kernels::NodePack<T> edge_end(int slot) const { return at(shape_.edge_other + slot); }
  void put(int lane, const kernels::NodePack<T>& pack) { store(pack, state_.next + lane); }
  void end_step() { std::swap(state_.now, state_.next); }
  double x(int lane) const { return static_cast<double>(state_.now[lane].x); }

 private:
  kernels::NodePack<T> at(const std::uint32_t* offset) const {
    const T* first = &state_.now->x;
    return {gather(first, offset), gather(first + 1, offset), gather(first + 2, offset),
            gather(first + 3, offset)};
  }
  static kernels::Lanes<T> gather(const T* from, const std::uint32_t* offset) {
    using Pack = kernels::Lanes<T>;
    // Masked with all lanes on: GCC 12 warns of its own unmasked gathers.
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 4) {
      return Pack(_mm512_mask_i32gather_ps(_mm512_setzero_ps(), __mmask16(-1),
                                           _mm512_load_si512(offset), from, 1));
    } else {
      const __m256i index = _mm256_load_si256(reinterpret_cast<const __m256i*>(offset));
      return Pack(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), __mmask8(-1), index, from, 1));
    }
#elif defined(__AVX2__)
    if constexpr (sizeof(T) == 4) {
      const __m256i index = _mm256_load_si256(reinterpret_cast<const __m256i*>(offset));
      const __m256 all = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
      return Pack(_mm256_mask_i32gather_ps(_mm256_setzero_ps(), from, index, all, 1));
    } else {
      const __m128i index = _mm_load_si128(reinterpret_cast<const __m128i*>(offset));
      const __m256d all = _mm256_castsi256_pd(_mm256_set1_epi32(-1));
      return Pack(_mm256_mask_i32gather_pd(_mm256_setzero_pd(), from, index, all, 1));
    }
#else
    Pack pack;
    for (int l = 0; l < Pack::width; ++l) pack.v[l] = from[offset[l] / sizeof(T)];
    return pack;
#endif
  }

  const kernels::BodyShape<T>& shape_;
  kernels::BodyState<T>& state_;
};

/// State as four arrays instead of records.
template <class T>
struct StateArrays {
  core::Aligned<T> x, y, vx, vy;

  void push(const kernels::NodeRecord<T>& node) {
    x.push_back(node.x);
    y.push_back(node.y);
    vx.push_back(node.vx);
    vy.push_back(node.vy);
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

/// No gather at all: every slot has its neighbour's state, as it was at the start, at its own
/// place. The floor of the ring formulation; what it computes is each node pulled by fixed
/// neighbours.
template <class T>
class Contiguous {
 public:
  Contiguous(const kernels::BodyShape<T>& body, kernels::BodyState<T>& state) {
    constexpr int width = kernels::Lanes<T>::width;
    int slots = 0, edges = 0;
    for (int g = 0; g < body.groups; ++g) slots += body.ring_size[g] * width;
    for (int g = 0; g < body.outline_groups; ++g) edges += body.edge_size[g] * width;
    for (int l = 0; l < body.groups * width; ++l) nodes_.push(state.now[l]);
    const auto copy = [&](const std::uint32_t* offsets, int count, StateArrays<T>& to) {
      for (int i = 0; i < count; ++i) to.push(state.now[offsets[i] / kernels::record_offset<T>(1)]);
    };
    copy(body.neighbour, slots, neighbour_);
    copy(body.edge_other, edges, edge_end_);
  }

  kernels::NodePack<T> own(int lane) const { return nodes_.load(lane); }
  kernels::NodePack<T> neighbour(int slot) const { return neighbour_.load(slot); }
  kernels::NodePack<T> edge_end(int slot) const { return edge_end_.load(slot); }
  void put(int lane, const kernels::NodePack<T>& pack) { nodes_.store(lane, pack); }
  void end_step() {}
  double x(int lane) const { return static_cast<double>(nodes_.x[static_cast<std::size_t>(lane)]); }

 private:
  StateArrays<T> nodes_, neighbour_, edge_end_;
};

/// The library's own way, driven as the others are.
template <class T>
class TransposedRecords {
 public:
  TransposedRecords(const kernels::BodyShape<T>& shape, kernels::BodyState<T>& state)
      : shape_(shape), state_(state) {}

  kernels::NodePack<T> own(int lane) const { return records().own(lane); }
  kernels::NodePack<T> neighbour(int slot) const { return records().neighbour(slot); }
  kernels::NodePack<T> edge_end(int slot) const { return records().edge_end(slot); }
  void put(int lane, const kernels::NodePack<T>& pack) const { records().put(lane, pack); }
  void end_step() { std::swap(state_.now, state_.next); }
  double x(int lane) const { return static_cast<double>(state_.now[lane].x); }

 private:
  kernels::Records<T> records() const { return {shape_, state_}; }
  const kernels::BodyShape<T>& shape_;
  kernels::BodyState<T>& state_;
};

/// One animat in water, stepped with the given state.
template <class T, template <class> class Nodes>
class RingOpponent {
 public:
  RingOpponent(const core::Body& body, const core::Scene& scene)
      : task_{&body, &scene},
        batch_({&task_, 1}, true, 1),
        shape_(batch_.shape(0)),
        state_(batch_.start(0, buffers_)),
        nodes_(shape_, state_),
        coefficients_(core::coefficients_of<T>(scene, core::Method::drift_kick_drift)) {}

  void step(double /*time*/, double amplitude) {
    const kernels::Phasor swing = kernels::phasor(shape_.advance * count_);
    coefficients_.amplitude = static_cast<T>(amplitude);
    coefficients_.swing_sine = static_cast<T>(amplitude * swing.sine);
    coefficients_.swing_cosine = static_cast<T>(amplitude * swing.cosine);
    kernels::step_body<T, terms>(shape_, state_, coefficients_, count_++, seen_, nodes_);
    nodes_.end_step();
  }
  double mean_x() const {
    double sum = 0;
    for (int l = 0; l < shape_.nodes; ++l) {
      sum += nodes_.x(l) - static_cast<double>(coefficients_.step / 2 * state_.vx[l]);
    }
    return sum / shape_.nodes;
  }
  int animats() const { return 1; }

 private:
  static constexpr kernels::Terms terms{.drag = true};

  core::LocomotionTask task_;
  core::BodyBatch<T> batch_;
  core::StateBuffers<T> buffers_;
  kernels::BodyShape<T> shape_;
  kernels::BodyState<T> state_;
  Nodes<T> nodes_;
  kernels::StepCoefficients<T> coefficients_;
  kernels::StepExtremes<T> seen_{};
  kernels::Turn<T> count_ = 0;
};

}  // namespace metamorph::bench
