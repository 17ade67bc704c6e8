#include "metamorph/reference.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/locomotion/gait.h"
#include "core/reference/system.h"
#include "metamorph/automatic_step.h"
#include "metamorph/step_refusal.h"

namespace metamorph::core {

namespace {

namespace ref = kernels::reference;

constexpr std::int64_t check_interval = 8;     // steps
constexpr std::int64_t outline_interval = 96;  // steps

Status status_of(ref::Fault fault) {
  switch (fault) {
    case ref::Fault::none:
      return Status::ok;
    case ref::Fault::inverted:
      return Status::inverted;
    case ref::Fault::collapsed:
      return Status::collapsed;
    case ref::Fault::speed:
      return Status::speed;
    case ref::Fault::non_finite:
      return Status::non_finite;
  }
  return Status::non_finite;
}

/// Which of several faults is told: the gravest.
int severity(ref::Fault fault) {
  switch (fault) {
    case ref::Fault::none:
      return 0;
    case ref::Fault::speed:
      return 1;
    case ref::Fault::collapsed:
      return 2;
    case ref::Fault::inverted:
      return 3;
    case ref::Fault::non_finite:
      return 4;
  }
  return 4;
}

double step_of(const ReferenceOptions& options, const Scene& scene) {
  return options.step > 0 ? options.step : scene.step;
}

/// The steps of one evaluation: counts them, looks at the state, and remembers a failure.
class Evaluation {
 public:
  Evaluation(const Body& body, const Scene& scene, const ReferenceOptions& options)
      : system_(body, scene),
        scene_(scene),
        options_(options),
        h_(step_of(options, scene)),
        settle_h_(scene.settle_step * (h_ / scene.step)),
        outcome_(describe(body)) {
    for (const auto& edge : outline_of(body.triangles)) {  // ascending
      const auto node = static_cast<std::size_t>(edge[0]);
      if (outline_nodes_.empty() || outline_nodes_.back() != node) outline_nodes_.push_back(node);
    }
    outcome_.step = h_;
    if (settles(scene_)) outcome_.settle_step = settle_h_;
  }

  Outcome run() {
    if (settles(scene_) && !settle()) return outcome_;
    const std::array<double, 2> start = system_.mean_position();
    observe(0);
    const std::int64_t steps = steps_in(scene_.run_steps, h_);
    const auto [lowest, highest] = std::minmax_element(system_.y.begin(), system_.y.end());
    outcome_.height = *highest - *lowest;
    gait_.begin(scene_, h_, steps, outline_nodes_.size());
    for (std::int64_t n = 0; n < steps; ++n) {
      system_.step(options_.method, static_cast<double>(n) * h_, h_);
      if (!count(n + 1, h_) || (n + 1 == steps && !(sound() && solid()))) return outcome_;
      if (gait_.is_due(n + 1)) look_at_gait();
      if ((n + 1) % options_.observe_every == 0) observe(n + 1);
    }
    const std::array<double, 2> end = system_.mean_position();
    const double dx = end[0] - start[0];
    const double dy = end[1] - start[1];
    outcome_.distance = travelled(scene_.distance, dx, dy);
    outcome_.mean_position = {dx, measures_height(scene_) ? end[1] : dy};
    gait_.finish(outcome_);
    return outcome_;
  }

 private:
  static std::int64_t steps_in(int paper_steps, double h) {
    return std::llround(paper_steps * paper_step / h);
  }

  /// Symplectic Euler, whatever the method of the run: its limit under damping is the widest.
  bool settle() {
    const std::int64_t wanted = steps_in(scene_.settle_quiet_steps, settle_h_);
    const std::int64_t limit = steps_in(scene_.settle_max_steps, settle_h_);
    system_.set_settling(true);
    const double start = system_.mean_position()[0];
    bool off = false;  // and away: it will not rest
    std::int64_t quiet = 0;
    while (quiet < wanted && outcome_.steps < limit && !off) {
      system_.step(ReferenceMethod::symplectic_euler, 0, settle_h_);
      const bool sound = count(outcome_.steps + 1, settle_h_);
      outcome_.settle_time = static_cast<double>(outcome_.steps) * settle_h_;
      if (!sound) return false;
      quiet = system_.max_speed() < scene_.settle_speed ? quiet + 1 : 0;
      off = outcome_.steps % check_interval == 0 &&
            std::abs(system_.mean_position()[0] - start) > scene_.settle_range;
    }
    if (quiet < wanted) outcome_.status = Status::not_settled;
    system_.set_settling(false);
    if (options_.method == ReferenceMethod::drift_kick_drift) system_.meet_ground(h_ / 2);
    return true;
  }

  /// Counts a step, the n-th of settling or of the run, of size h, and looks at the state it led
  /// to. What was found is told every 8 steps: false if there was a fault among them.
  bool count(std::int64_t n, double h) {
    ++outcome_.steps;
    const ref::Health health = system_.examine(h);
    outcome_.min_area_ratio = std::min(outcome_.min_area_ratio, health.min_area_ratio);
    outcome_.max_speed = std::max(outcome_.max_speed, health.max_speed);
    if (severity(health.fault) >= severity(worst_.fault)) worst_ = health;
    return n % check_interval != 0 || (sound() && (n % outline_interval != 0 || solid()));
  }

  bool sound() {
    if (worst_.fault == ref::Fault::none) return true;
    outcome_.status = status_of(worst_.fault);
    outcome_.failed_step = outcome_.steps;
    outcome_.failed_index = worst_.index;
    outcome_.failed_value = worst_.value;
    return false;
  }

  /// Whether no triangle without pressure has turned over and the outline does not cross itself.
  bool solid() {
    if (const auto turned = system_.turned_without_pressure()) {
      outcome_.status = Status::inverted;
      outcome_.failed_index = turned->triangle;
      outcome_.failed_value = turned->area_ratio;
    } else if (const auto crossed = scene_.self_collision ? system_.crossed() : std::nullopt) {
      outcome_.status = Status::crossed;
      outcome_.failed_index = crossed->spring;
      outcome_.failed_value = crossed->node;
    } else {
      return true;
    }
    outcome_.failed_step = outcome_.steps;
    return false;
  }

  void look_at_gait() {
    const std::array<double, 2> mean = system_.mean_position();
    gait_.add(mean[0], mean[1]);
    if (!scene_.ground) return;
    for (std::size_t n = 0; n < outline_nodes_.size(); ++n) {
      gait_.touches()[n] += system_.y[outline_nodes_[n]] <= GaitWatch::touching;
    }
  }

  void observe(std::int64_t step) {
    if (!options_.observe) return;
    options_.observe(
        {step, static_cast<double>(step) * h_, system_.x, system_.y, system_.vx, system_.vy});
  }

  ReferenceSystem system_;
  const Scene& scene_;
  const ReferenceOptions& options_;
  double h_;         ///< of the run
  double settle_h_;  ///< of settling
  Outcome outcome_;
  ref::Health worst_;  // of the steps so far
  std::vector<std::size_t> outline_nodes_;
  GaitWatch gait_;
};

/// The method by whose limit steps are chosen.
Method fast_method(ReferenceMethod method) {
  return method == ReferenceMethod::symplectic_euler ? Method::symplectic_euler
                                                     : Method::drift_kick_drift;
}

}  // namespace

Outcome simulate_reference(const Body& body, const Scene& scene, const ReferenceOptions& options) {
  Outcome refused = describe(body);
  if (body.node_count() == 0) {
    refused.status = Status::empty;
    return refused;
  }
  if (const std::vector<BodyFault> faults = check(body); !faults.empty()) {
    refused.status = status_of(faults);
    return refused;
  }
  const Scene chosen = with_chosen_steps(body, scene, fast_method(options.method));
  Scene taken = chosen;
  taken.step = step_of(options, chosen);
  taken.settle_step = chosen.settle_step * (taken.step / chosen.step);
  if (const auto refusal = refused_step(body, taken)) {
    refused.status = refusal->status;
    refused.step = taken.step;
    if (settles(scene)) refused.settle_step = taken.settle_step;
    refused.failed_value = refusal->largest;
    refused.failed_index = refusal->node;
    refused.failed_step = 0;
    return refused;
  }
  return Evaluation(body, chosen, options).run();
}

}  // namespace metamorph::core
