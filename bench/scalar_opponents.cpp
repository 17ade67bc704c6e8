#include "bench/scalar_opponents.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "kernels/elementary.h"
#include "metamorph/random.h"

namespace metamorph::bench {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// sin of a number of turns, by the library's polynomial: it vectorises.
template <class T>
inline T sine_of_turns(T turns) {
  T sine, cosine;
  kernels::sin_cos_pi(T(2) * (turns - std::nearbyint(turns)), sine, cosine);
  return sine;
}

}  // namespace

template <class T>
TidyLoop<T>::TidyLoop(const core::Body& body, const core::Scene& scene)
    : step_(static_cast<T>(scene.step)),
      stiffness_(static_cast<T>(scene.stiffness)),
      damping_(static_cast<T>(scene.damping)),
      pressure_(static_cast<T>(scene.pressure)),
      drag_normal_(static_cast<T>(scene.drag_normal)),
      drag_tangential_(static_cast<T>(scene.drag_tangential)) {
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    Node node{};
    node.x = static_cast<T>(body.x[i]);
    node.y = static_cast<T>(body.y[i]);
    node.frequency = static_cast<T>(1 / body.period[i]);
    node.phase = static_cast<T>(body.phase[i] / (2 * std::numbers::pi));
    nodes_.push_back(node);
  }
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    springs_.push_back(
        {body.springs[s][0], body.springs[s][1], static_cast<T>(body.rest_length[s])});
  }
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    if (body.rest_area[t] < scene.min_pressure_area) continue;
    const auto& [a, b, c] = body.triangles[t];
    triangles_.push_back({a, b, c, static_cast<T>(body.rest_area[t])});
  }
  for (const auto& [a, b] : core::outline_of(body.triangles)) edges_.push_back({a, b});
}

template <class T>
void TidyLoop<T>::step(double time, double amplitude) {
  const T swing = static_cast<T>(amplitude), now = static_cast<T>(time);
  for (Node& node : nodes_) {
    node.fx = node.fy = 0;
    node.oscillation = std::sin(T(2 * std::numbers::pi) * (node.frequency * now + node.phase));
  }
  for (const Spring& spring : springs_) {
    Node &a = nodes_[at(spring.a)], &b = nodes_[at(spring.b)];
    const T dx = b.x - a.x, dy = b.y - a.y;
    const T length = std::sqrt(dx * dx + dy * dy), inverse = 1 / length;
    const T rest = spring.rest_length * (1 + swing * (a.oscillation + b.oscillation));
    const T rate = ((b.vx - a.vx) * dx + (b.vy - a.vy) * dy) * inverse;
    const T tension = (stiffness_ * (length - rest) + damping_ * rate) * inverse;
    a.fx += tension * dx;
    a.fy += tension * dy;
    b.fx -= tension * dx;
    b.fy -= tension * dy;
  }
  for (const Triangle& triangle : triangles_) {
    Node &a = nodes_[at(triangle.a)], &b = nodes_[at(triangle.b)], &c = nodes_[at(triangle.c)];
    const T bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const T area = (bx * cy - by * cx) / 2;
    const T push = pressure_ * (triangle.rest_area / area - 1) / 2;
    a.fx += push * (by - cy);
    a.fy += push * (cx - bx);
    b.fx += push * cy;
    b.fy -= push * cx;
    c.fx -= push * by;
    c.fy += push * bx;
  }
  for (const Edge& edge : edges_) {
    Node &a = nodes_[at(edge.a)], &b = nodes_[at(edge.b)];
    const T dx = b.x - a.x, dy = b.y - a.y;
    const T vx = (a.vx + b.vx) / 2, vy = (a.vy + b.vy) / 2;
    const T half = T(-0.5) / (dx * dx + dy * dy);
    const T t = vx * dx + vy * dy, n = vy * dx - vx * dy;
    const T along = drag_tangential_ * half * std::fabs(t) * t;
    const T across = drag_normal_ * half * std::fabs(n) * n;
    const T fx = along * dx - across * dy, fy = along * dy + across * dx;
    a.fx += fx;
    a.fy += fy;
    b.fx += fx;
    b.fy += fy;
  }
  for (Node& node : nodes_) {
    node.kick_x += step_ * node.fx;
    node.kick_y += step_ * node.fy;
    node.x += step_ * node.kick_x;
    node.y += step_ * node.kick_y;
    node.vx = node.kick_x + step_ / 2 * node.fx;
    node.vy = node.kick_y + step_ / 2 * node.fy;
  }
}

template <class T>
double TidyLoop<T>::mean_x() const {
  double sum = 0;
  for (const Node& node : nodes_) sum += static_cast<double>(node.x - step_ / 2 * node.kick_x);
  return sum / static_cast<double>(nodes_.size());
}

template <class T, int lanes>
Interleaved<T, lanes>::Interleaved(const core::Body& body, const core::Scene& scene)
    : node_count_(body.x.size()),
      step_(static_cast<T>(scene.step)),
      stiffness_(static_cast<T>(scene.stiffness)),
      damping_(static_cast<T>(scene.damping)),
      pressure_(static_cast<T>(scene.pressure)),
      drag_normal_(static_cast<T>(scene.drag_normal)),
      drag_tangential_(static_cast<T>(scene.drag_tangential)) {
  const std::size_t size = node_count_ * lanes;
  for (auto* values : {&x_, &y_, &vx_, &vy_, &kick_x_, &kick_y_, &fx_, &fy_, &frequency_, &phase_,
                       &oscillation_}) {
    values->assign(size, T(0));
  }
  const auto edges = core::outline_of(body.triangles);
  const auto size_lists = [](std::size_t count, auto... lists) {
    (lists->resize(count * lanes), ...);
  };
  size_lists(body.springs.size(), &spring_a_, &spring_b_, &rest_length_);
  size_lists(body.triangles.size(), &triangle_a_, &triangle_b_, &triangle_c_, &rest_area_);
  size_lists(edges.size(), &edge_a_, &edge_b_);
  for (int l = 0; l < lanes; ++l) {
    // Nodes in another order in every lane; the first keeps the body's own.
    std::vector<int> place(node_count_);
    std::iota(place.begin(), place.end(), 0);
    evolve::RandomStream random(evolve::Purpose::test, 1, 0, static_cast<std::uint32_t>(l));
    for (std::size_t i = node_count_; l > 0 && i > 1; --i) {
      std::swap(place[i - 1], place[random.below(static_cast<std::uint32_t>(i))]);
    }
    const auto here = [&](core::Index node) { return place[at(node)] * lanes + l; };
    const auto entry = [&](std::size_t i) { return i * lanes + at(l); };
    for (core::Index i = 0; i < body.node_count(); ++i) {
      x_[at(here(i))] = static_cast<T>(body.x[at(i)]);
      y_[at(here(i))] = static_cast<T>(body.y[at(i)]);
      frequency_[at(here(i))] = static_cast<T>(1 / body.period[at(i)]);
      phase_[at(here(i))] = static_cast<T>(body.phase[at(i)] / (2 * std::numbers::pi));
    }
    for (std::size_t s = 0; s < body.springs.size(); ++s) {
      spring_a_[entry(s)] = here(body.springs[s][0]);
      spring_b_[entry(s)] = here(body.springs[s][1]);
      rest_length_[entry(s)] = static_cast<T>(body.rest_length[s]);
    }
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
      triangle_a_[entry(t)] = here(body.triangles[t][0]);
      triangle_b_[entry(t)] = here(body.triangles[t][1]);
      triangle_c_[entry(t)] = here(body.triangles[t][2]);
      rest_area_[entry(t)] = static_cast<T>(body.rest_area[t]);
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
      edge_a_[entry(e)] = here(edges[e][0]);
      edge_b_[entry(e)] = here(edges[e][1]);
    }
  }
}

template <class T, int lanes>
void Interleaved<T, lanes>::step(double time, double amplitude) {
  const T swing = static_cast<T>(amplitude), now = static_cast<T>(time), h = step_;
  T* __restrict const x = x_.data();
  T* __restrict const y = y_.data();
  T* __restrict const vx = vx_.data();
  T* __restrict const vy = vy_.data();
  T* __restrict const kick_x = kick_x_.data();
  T* __restrict const kick_y = kick_y_.data();
  T* __restrict const fx = fx_.data();
  T* __restrict const fy = fy_.data();
  T* __restrict const oscillation = oscillation_.data();
  const T *const frequency = frequency_.data(), *const phase = phase_.data();

  const std::size_t size = x_.size();
#pragma omp simd
  for (std::size_t i = 0; i < size; ++i) {
    fx[i] = fy[i] = T(0);
    oscillation[i] = sine_of_turns(frequency[i] * now + phase[i]);
  }
  for (std::size_t first = 0; first < spring_a_.size(); first += lanes) {
#pragma omp simd
    for (int l = 0; l < lanes; ++l) {
      const int a = spring_a_[first + at(l)], b = spring_b_[first + at(l)];
      const T dx = x[b] - x[a], dy = y[b] - y[a];
      const T length = std::sqrt(dx * dx + dy * dy), inverse = 1 / length;
      const T rest = rest_length_[first + at(l)] * (1 + swing * (oscillation[a] + oscillation[b]));
      const T rate = ((vx[b] - vx[a]) * dx + (vy[b] - vy[a]) * dy) * inverse;
      const T tension = (stiffness_ * (length - rest) + damping_ * rate) * inverse;
      fx[a] += tension * dx;
      fy[a] += tension * dy;
      fx[b] -= tension * dx;
      fy[b] -= tension * dy;
    }
  }
  for (std::size_t first = 0; first < triangle_a_.size(); first += lanes) {
#pragma omp simd
    for (int l = 0; l < lanes; ++l) {
      const int a = triangle_a_[first + at(l)], b = triangle_b_[first + at(l)],
                c = triangle_c_[first + at(l)];
      const T bx = x[b] - x[a], by = y[b] - y[a], cx = x[c] - x[a], cy = y[c] - y[a];
      const T area = (bx * cy - by * cx) / 2;
      const T push = pressure_ * (rest_area_[first + at(l)] / area - 1) / 2;
      fx[a] += push * (by - cy);
      fy[a] += push * (cx - bx);
      fx[b] += push * cy;
      fy[b] -= push * cx;
      fx[c] -= push * by;
      fy[c] += push * bx;
    }
  }
  for (std::size_t first = 0; first < edge_a_.size(); first += lanes) {
#pragma omp simd
    for (int l = 0; l < lanes; ++l) {
      const int a = edge_a_[first + at(l)], b = edge_b_[first + at(l)];
      const T dx = x[b] - x[a], dy = y[b] - y[a];
      const T ux = (vx[a] + vx[b]) / 2, uy = (vy[a] + vy[b]) / 2;
      const T half = T(-0.5) / (dx * dx + dy * dy);
      const T t = ux * dx + uy * dy, n = uy * dx - ux * dy;
      const T along = drag_tangential_ * half * std::fabs(t) * t;
      const T across = drag_normal_ * half * std::fabs(n) * n;
      const T edge_fx = along * dx - across * dy, edge_fy = along * dy + across * dx;
      fx[a] += edge_fx;
      fy[a] += edge_fy;
      fx[b] += edge_fx;
      fy[b] += edge_fy;
    }
  }
#pragma omp simd
  for (std::size_t i = 0; i < size; ++i) {
    kick_x[i] += h * fx[i];
    kick_y[i] += h * fy[i];
    x[i] += h * kick_x[i];
    y[i] += h * kick_y[i];
    vx[i] = kick_x[i] + h / 2 * fx[i];
    vy[i] = kick_y[i] + h / 2 * fy[i];
  }
}

template <class T, int lanes>
double Interleaved<T, lanes>::mean_x() const {
  double sum = 0;
  for (std::size_t i = 0; i < x_.size(); i += lanes) {
    sum += static_cast<double>(x_[i] - step_ / 2 * kick_x_[i]);
  }
  return sum / static_cast<double>(node_count_);
}

template class TidyLoop<float>;
template class TidyLoop<double>;
template class Interleaved<float, 1>;
template class Interleaved<double, 1>;
template class Interleaved<float, animat_lanes<float>>;
template class Interleaved<double, animat_lanes<double>>;

}  // namespace metamorph::bench
