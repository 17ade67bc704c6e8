#include "core/locomotion/runner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/locomotion/scene_terms.h"

namespace metamorph::core {
namespace {

// Failures are absorbing: a check now and then misses nothing, it is only late by so many steps.
constexpr std::int64_t check_interval = 8;
// The outline is kept whole by what stops approaches; this looks whether it was.
constexpr std::int64_t outline_interval = 96;
constexpr std::uint64_t speed_interval = 8;
constexpr int most_rounds = 4;  ///< of stopping in a step: more would help only what is no number

std::int64_t steps_of(int paper_steps, double step) {
  return std::llround(paper_steps * paper_step / step);
}

/// Every composition of terms, made once; picked by its number.
template <class T>
using StepFunction = void (*)(const kernels::BodyShape<T>&, kernels::BodyState<T>&,
                              const kernels::StepCoefficients<T>&, kernels::Turn<T>,
                              kernels::StepExtremes<T>&);

template <class T, unsigned... numbers>
constexpr auto step_table(std::integer_sequence<unsigned, numbers...>) {
  return std::array<StepFunction<T>, sizeof...(numbers)>{
      &kernels::step_body<T, kernels::terms_from(numbers)>...};
}

template <class T>
StepFunction<T> step_function(const kernels::Terms& terms) {
  static constexpr auto table =
      step_table<T>(std::make_integer_sequence<unsigned, kernels::compositions>{});
  return table[kernels::number_of(terms)];
}

}  // namespace

template <class T>
void Runner<T>::run(std::size_t i, const LocomotionTask& task, Outcome& outcome, int every,
                    const std::function<void(const Frame&)>& observe) {
  body_ = task.body;
  scene_ = task.scene;
  index_ = i;
  shape_ = batch_.shape(i);
  state_ = batch_.start(i, buffers_);
  coefficients_ = coefficients_of<T>(*scene_, method_);
  step_ = scene_->step;
  extremes_ = {};
  fastest2_ = kernels::Lanes<T>(T(0));
  touched_ = false;
  prepare_looks();
  if (scene_->self_collision) {
    collisions_.reset(*body_, *scene_, batch_, i);
  }
  if (settles(*scene_) && !settle(outcome)) return;
  actuate(outcome, every, observe);
}

template <class T>
void Runner<T>::step(std::uint64_t n) {
  kernels::Terms terms = terms_of(*scene_, actuation_);
  if (scene_->self_collision) {
    auto &fx = buffers_.extra_fx, &fy = buffers_.extra_fy;
    if (touched_) {
      const auto lanes = static_cast<std::ptrdiff_t>(kernels::lane_index<T>(collisions_.groups()));
      std::fill(fx.begin(), fx.begin() + lanes, T(0));
      std::fill(fy.begin(), fy.begin() + lanes, T(0));
    }
    // Speeds change little in a few steps: hardly ever has to be looked again.
    if (n % speed_interval == 0) expect_speed(std::sqrt(largest(fastest2_)));
    list_pairs();
    const kernels::PairCounts found =
        meet(static_cast<T>(scene_->collision_stiffness), fx.data(), fy.data());
    near_ = found.near;
    touched_ = found.touching > 0;
    terms.extra = touched_;
  }
  const auto before = extremes_.largest_speed2;
  extremes_.largest_speed2 = kernels::Lanes<T>(T(0));
  step_function<T>(terms)(shape_, state_, coefficients_, static_cast<kernels::Turn<T>>(n),
                          extremes_);
  fastest2_ = extremes_.largest_speed2;
  if (scene_->self_collision) {
    if (stop()) fastest2_ = speeds2();
    collisions_.advance(fastest2_, coefficients_.step);
  }
  extremes_.largest_speed2 = kernels::max(fastest2_, before);
  std::swap(state_.now, state_.next);
}

/// Sets how near pairs must be to be looked at, for speeds up to somewhat more than this.
template <class T>
void Runner<T>::expect_speed(T speed) {
  expected_ = T(1.25) * speed + T(0.05);
  reach_ = 2 * coefficients_.step * expected_;
}

template <class T>
void Runner<T>::list_pairs() {
  pairs_ = collisions_.pairs(state_.now, shape_.inverse_mass, reach_);
}

/// Finds the pairs within `reach_`, and adds their penalty.
template <class T>
kernels::PairCounts Runner<T>::meet(T stiffness, T* fx, T* fy) {
  return kernels::meet_pairs(pairs_, state_.now, stiffness,
                             static_cast<T>(scene_->collision_least_gap), reach_, fx, fy,
                             collisions_.approaches());
}

/// Between kick and drift, which the step has done in one: stops what would come too near. Returns
/// whether there was anything.
template <class T>
bool Runner<T>::stop() {
  using Pack = kernels::Lanes<T>;
  const kernels::StopStep<T> stop_step{
      coefficients_.step, T(1) / coefficients_.step, coefficients_.extrapolate / coefficients_.step,
      terms_of(*scene_, actuation_).ground, coefficients_.friction};
  Pack speed2 = fastest2_;
  for (int round = 0; round < most_rounds; ++round) {
    // What was pushed may be faster than all before: then more may be near.
    if (!kernels::all(speed2 < Pack(expected_ * expected_))) {
      expect_speed(std::sqrt(largest(speed2)));
      list_pairs();
      near_ = meet(T(0), buffers_.extra_fx.data(), buffers_.extra_fy.data()).near;
    } else if (round > 0) {
      return true;
    }
    const kernels::Approach<T>* const begin = collisions_.approaches();
    const kernels::Stopped<T> stopped = kernels::stop_approaches(
        begin, begin + near_, stop_step, state_.now, state_.next, state_.vx, state_.vy);
    if (!stopped.any) return round > 0;
    speed2 = Pack(stopped.fastest2);
  }
  return true;
}

/// The largest squared speeds now, each lane for itself.
template <class T>
kernels::Lanes<T> Runner<T>::speeds2() const {
  using Pack = kernels::Lanes<T>;
  Pack largest2(T(0));
  for (int base = 0; base < shape_.groups * Pack::width; base += Pack::width) {
    const Pack vx = Pack::load(state_.vx + base), vy = Pack::load(state_.vy + base);
    largest2 = max(fma(vx, vx, vy * vy), largest2);
  }
  return largest2;
}

template <class T>
bool Runner<T>::settle(Outcome& outcome) {
  const Scene& scene = *scene_;
  begin_settling();
  const std::int64_t quiet_needed = steps_of(scene.settle_quiet_steps, step_);
  const std::int64_t most = steps_of(scene.settle_max_steps, step_);
  const kernels::Lanes<T> quiet2(static_cast<T>(scene.settle_speed * scene.settle_speed));
  const double start_x = mean_position().x;
  bool off = false;  // and away: it will not rest
  std::int64_t quiet = 0, n = 0;
  while (n < most && quiet < quiet_needed && !off) {
    step(static_cast<std::uint64_t>(n));
    quiet = all(fastest2_ < quiet2) ? quiet + 1 : 0;
    ++n;
    outcome.steps = n;
    outcome.settle_time = static_cast<double>(n) * step_;
    if (n % check_interval != 0) continue;
    if (!sound(outcome, n % outline_interval == 0)) return false;
    off = std::abs(mean_position().x - start_x) > scene.settle_range;
  }
  end_settling();
  if (quiet < quiet_needed) outcome.status = Status::not_settled;
  return true;
}

/// Settling is symplectic Euler: records hold (x_n, v_n), nothing is extrapolated.
template <class T>
void Runner<T>::begin_settling() {
  actuation_ = kernels::Actuation::none;
  step_ = scene_->settle_step;
  coefficients_.step = static_cast<T>(step_);
  coefficients_.extrapolate = T(0);
  coefficients_.damping = static_cast<T>(scene_->settle_damping);
  coefficients_.amplitude = T(0);
}

/// Back to the method of the run, whose records lie half a step ahead. No acceleration is taken
/// over: the body is at rest.
template <class T>
void Runner<T>::end_settling() {
  step_ = scene_->step;
  coefficients_ = coefficients_of<T>(*scene_, method_);
  for (int l = 0; l < shape_.nodes; ++l) {
    kernels::NodeRecord<T>& record = state_.now[l];
    if (terms_of(*scene_, actuation_).ground &&
        coefficients_.extrapolate > 0) {  // which holds in half a step as well
      const T least = -std::max(record.y, T(0)) / coefficients_.extrapolate;
      record.vy = state_.vy[l] = std::max(state_.vy[l], least);
    }
    record.x = std::fma(coefficients_.extrapolate, state_.vx[l], record.x);
    record.y = std::fma(coefficients_.extrapolate, state_.vy[l], record.y);
  }
  if (scene_->self_collision) collisions_.advance(fastest2_, coefficients_.extrapolate);
}

template <class T>
void Runner<T>::actuate(Outcome& outcome, int every,
                        const std::function<void(const Frame&)>& observe) {
  const Scene& scene = *scene_;
  actuation_ =
      shape_.mixed_periods ? kernels::Actuation::mixed_periods : kernels::Actuation::one_period;
  const Mean start = mean_position();
  const std::int64_t count = steps_of(scene.run_steps, scene.step);
  const double ramp = scene.ramp_steps * paper_step;
  const double offset = method_ == Method::drift_kick_drift ? 0.5 : 0;
  const std::int64_t settled = outcome.steps;
  outcome.height = height();
  gait_.begin(scene, scene.step, count, batch_.outline_nodes(index_).size());
  if (observe) show(observe, 0);
  for (std::int64_t n = 0; n < count; ++n) {
    const double t = (static_cast<double>(n) + offset) * scene.step;
    const double amplitude = scene.amplitude * (t < ramp ? t / ramp : 1.0);
    const auto count_from_start = static_cast<std::uint64_t>(n);
    const kernels::Phasor swing = kernels::phasor(shape_.advance * count_from_start);
    coefficients_.amplitude = static_cast<T>(amplitude);
    coefficients_.swing_sine = static_cast<T>(amplitude * swing.sine);
    coefficients_.swing_cosine = static_cast<T>(amplitude * swing.cosine);
    step(count_from_start);
    outcome.steps = settled + n + 1;
    const bool last = n + 1 == count;
    if (((n + 1) % check_interval == 0 || last) &&
        !sound(outcome, (n + 1) % outline_interval == 0 || last)) {
      return;
    }
    if (gait_.is_due(n + 1)) look_at_gait();
    if (observe && (n + 1) % every == 0) show(observe, n + 1);
  }
  const Mean end = mean_position();
  outcome.mean_position = {end.x - start.x, measures_height(scene) ? end.y : end.y - start.y};
  outcome.distance = travelled(scene.distance, end.x - start.x, end.y - start.y);
  gait_.finish(outcome);
}

// A record holds x_n + h/2 v_n with drift-kick-drift, x_n with symplectic Euler.
template <class T>
double Runner<T>::position_x(int lane) const {
  return static_cast<double>(state_.now[lane].x) -
         static_cast<double>(coefficients_.extrapolate) * static_cast<double>(state_.vx[lane]);
}

template <class T>
double Runner<T>::position_y(int lane) const {
  return static_cast<double>(state_.now[lane].y) -
         static_cast<double>(coefficients_.extrapolate) * static_cast<double>(state_.vy[lane]);
}

template <class T>
typename Runner<T>::Mean Runner<T>::mean_position() const {
  double x = 0, y = 0;
  for (int l = 0; l < shape_.nodes; ++l) {
    x += position_x(l);
    y += position_y(l);
  }
  return {x / shape_.nodes, y / shape_.nodes};
}

template <class T>
void Runner<T>::show(const std::function<void(const Frame&)>& observe, std::int64_t step_index) {
  const auto lanes = batch_.node_of_lane(index_);
  const std::array<double, 2> origin = batch_.origin(index_);
  for (auto& values : frame_) values.resize(static_cast<std::size_t>(shape_.nodes));
  for (int l = 0; l < shape_.nodes; ++l) {
    const auto node = static_cast<std::size_t>(lanes[static_cast<std::size_t>(l)]);
    frame_[0][node] = position_x(l) + origin[0];
    frame_[1][node] = position_y(l) + (starts_on_ground(*scene_) ? 0 : origin[1]);
    frame_[2][node] = static_cast<double>(state_.vx[l]);
    frame_[3][node] = static_cast<double>(state_.vy[l]);
  }
  observe({step_index, static_cast<double>(step_index) * scene_->step, frame_[0], frame_[1],
           frame_[2], frame_[3]});
}

template class Runner<float>;
template class Runner<double>;

}  // namespace metamorph::core
