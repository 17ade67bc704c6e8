#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/locomotion/solid_pairs.h"
#include "core/reference/system.h"
#include "kernels/reference/actuation.h"
#include "kernels/reference/drag.h"
#include "kernels/reference/pressure.h"
#include "kernels/reference/spring.h"

namespace metamorph::core {

namespace ref = kernels::reference;

ReferenceSystem::ReferenceSystem(const Body& body, const Scene& scene)
    : x(body.x),
      y(body.y),
      vx(body.x.size()),
      vy(body.x.size()),
      ax(body.x.size()),
      ay(body.x.size()),
      body_(body),
      scene_(scene),
      outline_(outline_of(body.triangles)),
      length_(body.rest_length),
      scratch_(10, std::vector<double>(body.x.size())) {
  if (scene.ground) {
    const double slope = scene.slope_degrees * std::numbers::pi / 180;
    gravity_ = {-scene.gravity * std::sin(slope), -scene.gravity * std::cos(slope)};
  }
  if (starts_on_ground(scene)) {
    const double lowest = *std::min_element(y.begin(), y.end());
    for (double& height : y) height -= lowest;
  }
  if (scene.self_collision) {
    for (const SolidPair& pair : solid_pairs(body, scene)) {
      pairs_.push_back({pair.node, pair.edge, pair.threshold});
    }
  }
}

ref::PressureCells ReferenceSystem::pressure_cells() const {
  return {body_.triangles, body_.rest_area, scene_.min_pressure_area};
}

void ReferenceSystem::set_spring_lengths(double t) {
  const double amplitude =
      settling_ ? 0 : scene_.amplitude * ref::ramp(t, scene_.ramp_steps * paper_step);
  if (amplitude == 0)
    length_ = body_.rest_length;
  else
    ref::actuate(body_.springs, body_.rest_length, {body_.period, body_.phase}, amplitude, t,
                 length_);
}

void ReferenceSystem::forces(const ref::Nodes& nodes, double t, const ref::Forces& sums) {
  std::fill(sums.x.begin(), sums.x.end(), 0.0);
  std::fill(sums.y.begin(), sums.y.end(), 0.0);
  set_spring_lengths(t);
  ref::add_spring_forces(body_.springs, length_, scene_.stiffness,
                         settling_ ? scene_.settle_damping : scene_.damping, nodes, sums);
  if (scene_.pressure != 0)
    ref::add_pressure_forces(pressure_cells(), scene_.pressure, nodes, sums);
  if (scene_.drag)
    ref::add_drag_forces(outline_, scene_.drag_normal, scene_.drag_tangential, nodes, sums);
  if (scene_.ground) ref::add_weight(gravity_, mass, sums);
  ref::add_collision_forces(pairs_, scene_.collision_stiffness, nodes, sums);
  if (settling_) ref::add_node_drag(scene_.settle_drag, nodes, sums);
}

void ReferenceSystem::meet_ground(double h) {
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (scene_.ground) ref::meet_ground(y[i], h, 0, vx[i], vy[i]);
  }
}

void ReferenceSystem::step(ReferenceMethod method, double t, double h) {
  const ref::Workspace work{scratch_[0], scratch_[1], scratch_[2], scratch_[3], scratch_[4],
                            scratch_[5], scratch_[6], scratch_[7], scratch_[8], scratch_[9]};
  const ref::Step step{t, h, mass};
  const auto force = [this](const ref::Nodes& nodes, double time, const ref::Forces& sums) {
    forces(nodes, time, sums);
  };
  const auto keep = [this](double drift, std::span<const double> from_x,
                           std::span<const double> from_y, std::span<double> along_x,
                           std::span<double> along_y, std::span<double> since_vy) {
    ref::keep_apart(solid(), drift, from_x, from_y, along_x, along_y, since_vy);
  };
  switch (method) {
    case ReferenceMethod::symplectic_euler:
      return ref::symplectic_euler(state(), work, step, force, keep);
    case ReferenceMethod::drift_kick_drift:
      return ref::drift_kick_drift(state(), work, step, force, keep);
    case ReferenceMethod::velocity_verlet:
      return ref::velocity_verlet(state(), work, step, force, keep);
    case ReferenceMethod::midpoint:
      return ref::midpoint(state(), work, step, force, keep);
    case ReferenceMethod::runge_kutta_4:
      return ref::runge_kutta_4(state(), work, step, force, keep);
  }
}

ref::Solid ReferenceSystem::solid() const {
  return {pairs_, scene_.collision_least_gap, scene_.ground, scene_.friction};
}

double ReferenceSystem::potential_energy(double t) {
  set_spring_lengths(t);
  double energy = ref::spring_energy(body_.springs, length_, scene_.stiffness, nodes());
  if (scene_.pressure != 0)
    energy += ref::pressure_energy(pressure_cells(), scene_.pressure, nodes());
  if (scene_.ground) energy += ref::weight_energy(gravity_, mass, nodes());
  return energy + ref::collision_energy(pairs_, scene_.collision_stiffness, nodes());
}

double ReferenceSystem::kinetic_energy() const {
  double energy = 0;
  for (std::size_t i = 0; i < vx.size(); ++i) energy += mass * (vx[i] * vx[i] + vy[i] * vy[i]) / 2;
  return energy;
}

ref::Health ReferenceSystem::examine(double h) const {
  return ref::examine(pressure_cells(), nodes(), h, {});
}

std::optional<ReferenceSystem::TurnedTriangle> ReferenceSystem::turned_without_pressure() const {
  for (std::size_t t = 0; t < body_.triangles.size(); ++t) {
    if (body_.rest_area[t] >= scene_.min_pressure_area) continue;
    const double area = ref::signed_area(body_.triangles[t], x, y);
    if (area <= 0) return TurnedTriangle{static_cast<Index>(t), area / body_.rest_area[t]};
  }
  return std::nullopt;
}

std::array<double, 2> ReferenceSystem::mean_position() const {
  std::array<double, 2> mean{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean[0] += x[i];
    mean[1] += y[i];
  }
  for (double& coordinate : mean) coordinate /= static_cast<double>(x.size());
  return mean;
}

double ReferenceSystem::max_speed() const {
  double squared = 0;
  for (std::size_t i = 0; i < vx.size(); ++i)
    squared = std::max(squared, vx[i] * vx[i] + vy[i] * vy[i]);
  return std::sqrt(squared);
}

}  // namespace metamorph::core
