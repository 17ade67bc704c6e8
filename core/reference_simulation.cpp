#include "core/reference_simulation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/reference_system_detail.h"

namespace metamorph::core {

namespace {

namespace ref = kernels::reference;

constexpr std::int64_t check_interval = 8;  // steps

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

/// The steps of one evaluation: counts them, looks at the state, and remembers a failure.
class Evaluation {
 public:
  Evaluation(const Body& body, const Scene& scene, const ReferenceOptions& options)
      : system_(body, scene),
        scene_(scene),
        options_(options),
        h_(options.step > 0 ? options.step : scene.step),
        outcome_(describe(body)) {}

  Outcome run() {
    if (scene_.ground && !settle()) return outcome_;
    const std::array<double, 2> start = system_.mean_position();
    observe(0);
    const std::int64_t steps = steps_in(scene_.run_steps);
    for (std::int64_t n = 0; n < steps; ++n) {
      system_.step(options_.method, static_cast<double>(n) * h_, h_);
      if (!count()) return outcome_;
      if ((n + 1) % options_.observe_every == 0) observe(n + 1);
    }
    if (!look()) return outcome_;
    const std::array<double, 2> end = system_.mean_position();
    const double dx = end[0] - start[0];
    const double dy = end[1] - start[1];
    outcome_.distance = travelled(scene_.distance, dx, dy);
    outcome_.mean_position = {dx, scene_.ground ? end[1] : dy};
    return outcome_;
  }

 private:
  std::int64_t steps_in(int paper_steps) const {
    return std::llround(paper_steps * paper_step / h_);
  }

  bool settle() {
    const std::int64_t wanted = steps_in(scene_.settle_quiet_steps);
    const std::int64_t limit = steps_in(scene_.settle_max_steps);
    system_.set_settling(true);
    std::int64_t quiet = 0;
    while (quiet < wanted && outcome_.steps < limit) {
      system_.step(options_.method, 0, h_);
      if (!count()) return false;
      quiet = system_.max_speed() < scene_.settle_speed ? quiet + 1 : 0;
    }
    if (quiet < wanted) outcome_.status = Status::not_settled;
    outcome_.settle_time = static_cast<double>(outcome_.steps) * h_;
    system_.set_settling(false);
    return true;
  }

  bool count() {
    ++outcome_.steps;
    return outcome_.steps % check_interval != 0 || look();
  }

  bool look() {
    const ref::Health health = system_.examine(h_);
    outcome_.min_area_ratio = std::min(outcome_.min_area_ratio, health.min_area_ratio);
    outcome_.max_speed = std::max(outcome_.max_speed, health.max_speed);
    if (health.fault == ref::Fault::none) return true;
    outcome_.status = status_of(health.fault);
    outcome_.failed_step = outcome_.steps;
    outcome_.failed_index = health.index;
    outcome_.failed_value = health.value;
    return false;
  }

  void observe(std::int64_t step) {
    if (!options_.observe) return;
    options_.observe(
        {step, static_cast<double>(step) * h_, system_.x, system_.y, system_.vx, system_.vy});
  }

  ReferenceSystem system_;
  const Scene& scene_;
  const ReferenceOptions& options_;
  double h_;
  Outcome outcome_;
};

}  // namespace

Outcome simulate_reference(const Body& body, const Scene& scene, const ReferenceOptions& options) {
  const std::vector<BodyFault> faults = check(body);  // finds an empty body too
  if (!faults.empty()) {
    Outcome outcome = describe(body);
    outcome.status = faults.front().status;
    return outcome;
  }
  return Evaluation(body, scene, options).run();
}

}  // namespace metamorph::core
