#include <algorithm>
#include <cmath>
#include <limits>

#include "core/locomotion/crossed_edge.h"
#include "core/locomotion/runner.h"
#include "kernels/edge_crossing.h"

namespace metamorph::core {
namespace {

constexpr double collapse_ratio = 0.05;  ///< S/S0 below which the step resolves nothing
constexpr double speed_limit = 4.0;      ///< sqrt(k/m) d: the pressure's barrier gives way above
constexpr double travel_limit = 0.8;     ///< d per step

}  // namespace

/// Prepares the looks at what no step sees: the outline, and triangles without pressure.
template <class T>
void Runner<T>::prepare_looks() {
  lane_of_.resize(body_->x.size());
  const auto lanes = batch_.node_of_lane(index_);
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    if (lanes[l] >= 0) lane_of_[static_cast<std::size_t>(lanes[l])] = l;
  }
  without_pressure_.clear();
  for (std::size_t t = 0; t < body_->triangles.size(); ++t) {
    if (body_->rest_area[t] < scene_->min_pressure_area) without_pressure_.push_back(t);
  }
  const auto edges = batch_.outline_edges(index_);
  const std::size_t filled =
      (edges.size() + BodyBatch<T>::width - 1) / BodyBatch<T>::width * BodyBatch<T>::width;
  for (auto& values : look_) values.assign(filled, T(0));
  for (std::size_t e = 0; e < edges.size(); ++e) {
    look_[0][e] = static_cast<T>(edges[e][0]);
    look_[1][e] = static_cast<T>(edges[e][1]);
  }
}

/// Looks at what the steps have seen, and if told so at the outline; fills the failure's fields and
/// returns false if it is one.
template <class T>
bool Runner<T>::sound(Outcome& outcome, bool look_at_outline) {
  const double speed = std::sqrt(static_cast<double>(largest(extremes_.largest_speed2)));
  const double largest_ratio = static_cast<double>(largest(extremes_.largest_ratio));
  const T smallest_ratio = -largest(-extremes_.smallest_ratio);
  outcome.max_speed = std::max(outcome.max_speed, speed);
  if (largest_ratio > 0)
    outcome.min_area_ratio = std::min(outcome.min_area_ratio, 1 / largest_ratio);

  if (!(sum(extremes_.not_finite) == T(0)) || !std::isfinite(speed)) {
    outcome.status = Status::non_finite;
  } else if (smallest_ratio < 0) {
    outcome.status = Status::inverted;
    outcome.min_area_ratio = std::min(outcome.min_area_ratio, 0.0);
  } else if (outcome.min_area_ratio < collapse_ratio) {
    outcome.status = Status::collapsed;
    outcome.failed_value = outcome.min_area_ratio;
  } else if (speed > speed_limit || speed * step_ > travel_limit) {
    outcome.status = Status::speed;
    outcome.failed_value = speed;
  } else {
    return !look_at_outline || solid(outcome);
  }
  outcome.failed_step = outcome.steps;
  outcome.distance = 0;
  locate_failure(outcome);
  return false;
}

/// Index and value of a failure in the state it was found in: the node that is not finite or
/// fastest, the triangle most squeezed or turned.
template <class T>
void Runner<T>::locate_failure(Outcome& outcome) const {
  const auto lanes = batch_.node_of_lane(index_);
  if (outcome.status == Status::inverted || outcome.status == Status::collapsed) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < body_->triangles.size(); ++t) {
      if (body_->rest_area[t] < scene_->min_pressure_area) continue;
      const double ratio = area(t) / body_->rest_area[t];
      if (ratio < smallest) {
        smallest = ratio;
        outcome.failed_index = static_cast<int>(t);
      }
    }
    if (outcome.status == Status::inverted) outcome.failed_value = smallest;
    return;
  }
  double fastest = -1;
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    if (lanes[l] < 0) continue;
    const double vx = static_cast<double>(state_.vx[l]), vy = static_cast<double>(state_.vy[l]);
    const double speed2 = vx * vx + vy * vy;
    if (!std::isfinite(speed2)) {
      outcome.failed_index = lanes[l];
      outcome.failed_value = speed2;
      return;
    }
    if (speed2 > fastest) {
      fastest = speed2;
      outcome.failed_index = lanes[l];
    }
  }
}

/// Signed area of a triangle where it is now, d^2.
template <class T>
double Runner<T>::area(std::size_t triangle) const {
  const auto& [a, b, c] = body_->triangles[triangle];
  const auto& p = state_.now[lane_of_[static_cast<std::size_t>(a)]];
  const auto& q = state_.now[lane_of_[static_cast<std::size_t>(b)]];
  const auto& r = state_.now[lane_of_[static_cast<std::size_t>(c)]];
  return 0.5 * (double(q.x - p.x) * double(r.y - p.y) - double(r.x - p.x) * double(q.y - p.y));
}

/// Whether the outline does not cross itself and no triangle without pressure has turned over; else
/// fills the failure's fields.
template <class T>
bool Runner<T>::solid(Outcome& outcome) {
  for (const std::size_t t : without_pressure_) {
    if (area(t) > 0) continue;
    outcome.status = Status::inverted;
    outcome.failed_index = static_cast<int>(t);
    outcome.failed_value = area(t) / body_->rest_area[t];
  }
  if (outcome.status != Status::inverted && scene_->self_collision) find_crossing(outcome);
  if (!is_failure(outcome.status)) return true;
  outcome.failed_step = outcome.steps;
  outcome.distance = 0;
  return false;
}

template <class T>
void Runner<T>::find_crossing(Outcome& outcome) {
  const auto edges = batch_.outline_edges(index_);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto &a = state_.now[edges[e][0]], &b = state_.now[edges[e][1]];
    look_[2][e] = a.x;
    look_[3][e] = a.y;
    look_[4][e] = b.x;
    look_[5][e] = b.y;
  }
  if (!kernels::any_may_cross<T>({static_cast<int>(edges.size()), look_[0].data(), look_[1].data(),
                                  look_[2].data(), look_[3].data(), look_[4].data(),
                                  look_[5].data()})) {
    return;
  }
  std::vector<double> x(body_->x.size()), y(body_->x.size());
  for (std::size_t n = 0; n < x.size(); ++n) {
    x[n] = static_cast<double>(state_.now[lane_of_[n]].x);
    y[n] = static_cast<double>(state_.now[lane_of_[n]].y);
  }
  const std::optional<CrossedEdge> crossed = crossed_edge(*body_, x, y);
  if (!crossed) return;
  outcome.status = Status::crossed;
  outcome.failed_index = crossed->spring;
  outcome.failed_value = crossed->node;
}

template void Runner<float>::prepare_looks();
template bool Runner<float>::sound(Outcome&, bool);
template bool Runner<float>::solid(Outcome&);
template void Runner<float>::find_crossing(Outcome&);
template void Runner<float>::locate_failure(Outcome&) const;
template double Runner<float>::area(std::size_t) const;
template void Runner<double>::prepare_looks();
template bool Runner<double>::sound(Outcome&, bool);
template bool Runner<double>::solid(Outcome&);
template void Runner<double>::find_crossing(Outcome&);
template void Runner<double>::locate_failure(Outcome&) const;
template double Runner<double>::area(std::size_t) const;

}  // namespace metamorph::core
