#pragma once

#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "metamorph/scene.h"

namespace metamorph::core {

/// What a number of a scene may be, both ends included; of other fields nothing.
struct FieldRange {
  double low = 0, high = 0;
  static constexpr double no_limit = 1e9;  ///< upper end where there is no natural one
};

/// Powers of length and time in a field's unit. Mass is that of a node; a force per displacement is
/// thus 1/time^2.
struct FieldUnit {
  int length = 0, time = 0;
};

/// A field of a scene: a coefficient, a switch, a count of steps or a rule.
template <class Value>
struct SceneField {
  std::string_view name;  ///< of the member, and of the key that sets it in experiments
  Value Scene::* member;
  std::string_view meaning;
  FieldRange range;
  FieldUnit unit;

  /// Whether it is a step, which may be automatic_step instead of a number.
  constexpr bool is_step() const;

  constexpr SceneField(std::string_view of_name, Value Scene::* of_member, std::string_view means,
                       FieldRange within, FieldUnit in = {})
      : name(of_name), member(of_member), meaning(means), range(within), unit(in) {}
};

/// The one list of a scene's fields, in the order in which files show them. It makes the keys of
/// experiments; tests vary every coefficient in it: units rescaled, the fast simulator against the
/// reference, the limit of the step against the reference's spectrum.
inline constexpr std::tuple scene_fields = [] {
  constexpr double no_limit = FieldRange::no_limit;
  return std::tuple{
      SceneField{"stiffness", &Scene::stiffness, "k of eq 2", {0, 1e6}, {0, -2}},
      SceneField{"damping", &Scene::damping, "c of eq 2", {0, 1e6}, {0, -1}},
      SceneField{"pressure", &Scene::pressure, "c_p of eq 1; 0: none", {0, 1e6}, {0, -2}},
      SceneField{"amplitude", &Scene::amplitude, "A of eq 3", {0, 0.49}},
      SceneField{"min_pressure_area",
                 &Scene::min_pressure_area,
                 "smaller triangles have none, d^2",
                 {0, 1e6},
                 {2, 0}},
      SceneField{"drag", &Scene::drag, "water: eq 4 and 5", {}},
      SceneField{"drag_normal", &Scene::drag_normal, "d_N", {0, 1e6}, {-2, 0}},
      SceneField{"drag_tangential", &Scene::drag_tangential, "d_T", {0, 1e6}, {-2, 0}},
      SceneField{"ground", &Scene::ground, "land: gravity, contact and friction", {}},
      SceneField{"gravity", &Scene::gravity, "g", {0, 1e3}, {1, -2}},
      SceneField{"slope_degrees",
                 &Scene::slope_degrees,
                 "gravity is turned by it; +x is uphill",
                 {-89, 89}},
      SceneField{"friction", &Scene::friction, "mu", {0, 1e3}},
      SceneField{"self_collision", &Scene::self_collision, "the outline is solid", {}},
      SceneField{"collision_stiffness", &Scene::collision_stiffness, "k_s", {0, 1e6}, {0, -2}},
      SceneField{"collision_gap",
                 &Scene::collision_gap,
                 "it repels itself below this, d",
                 {0, 1e3},
                 {1, 0}},
      SceneField{"collision_least_gap",
                 &Scene::collision_least_gap,
                 "it comes no nearer, d",
                 {0, 1e3},
                 {1, 0}},
      SceneField{"step",
                 &Scene::step,
                 "time units per integrator step; auto: by body",
                 {1e-6, 10},
                 {0, 1}},
      SceneField{
          "run_steps", &Scene::run_steps, "actuation, ramp included, steps", {1, no_limit}, {0, 1}},
      SceneField{"ramp_steps",
                 &Scene::ramp_steps,
                 "steps over which actuation starts",
                 {0, no_limit},
                 {0, 1}},
      SceneField{"distance", &Scene::distance, "what counts as distance", {}},
      SceneField{"settle_step",
                 &Scene::settle_step,
                 "time units per step while settling",
                 {1e-6, 10},
                 {0, 1}},
      SceneField{"settle_damping", &Scene::settle_damping, "c while settling", {0, 1e6}, {0, -1}},
      SceneField{
          "settle_drag", &Scene::settle_drag, "drag per node while settling", {0, 1e6}, {0, -1}},
      SceneField{"settle_speed",
                 &Scene::settle_speed,
                 "quiet below this, d per time unit",
                 {0, 1e6},
                 {1, -1}},
      SceneField{"settle_quiet_steps",
                 &Scene::settle_quiet_steps,
                 "steps that must be quiet",
                 {0, no_limit},
                 {0, 1}},
      SceneField{
          "settle_max_steps", &Scene::settle_max_steps, "then start anyway", {0, no_limit}, {0, 1}},
      SceneField{"settle_range",
                 &Scene::settle_range,
                 "what goes farther starts anyway, d",
                 {0, no_limit},
                 {1, 0}}};
}();

template <class Value>
constexpr bool SceneField<Value>::is_step() const {
  if constexpr (std::is_same_v<Value, double>) {
    return member == &Scene::step || member == &Scene::settle_step;
  }
  return false;
}

/// Calls visit(field) for every field, in order.
template <class Visit>
constexpr void for_each_scene_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, scene_fields);
}

/// References to all members of a scene, the name first.
inline auto members_of(const Scene& scene) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa,
               ab] = scene;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa,
                  ab);
}

// What is new in Scene must be listed above: the binding names as many members as there are, and
// the list has as many, less the name, none twice.
static_assert(std::tuple_size_v<decltype(members_of(std::declval<const Scene&>()))> ==
              std::tuple_size_v<decltype(scene_fields)> + 1);
static_assert([] {
  bool distinct = true;
  for_each_scene_field([&](const auto& field) {
    int times = 0;
    for_each_scene_field([&](const auto& other) {
      if constexpr (std::is_same_v<decltype(field), decltype(other)>) {
        times += field.member == other.member;
      }
    });
    distinct &= times == 1;
  });
  return distinct;
}());

}  // namespace metamorph::core
