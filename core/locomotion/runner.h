#pragma once

#include <functional>
#include <vector>

#include "core/locomotion/body_batch.h"
#include "core/locomotion/collision_list.h"
#include "core/locomotion/gait.h"
#include "metamorph/motion.h"
#include "metamorph/outcome.h"

namespace metamorph::core {

/// Takes one animat of a batch at a time through its whole evaluation: settle, actuate, measure.
/// One per thread; storage is kept from animat to animat, nothing is allocated inside a step.
template <class T>
class Runner {
 public:
  Runner(const BodyBatch<T>& batch, Method method) : batch_(batch), method_(method) {}

  /// Runs body `i` of the batch and fills `outcome`. `observe` (may be empty) is called at the
  /// start of actuation and after every `every` steps.
  void run(std::size_t i, const LocomotionTask& task, Outcome& outcome, int every,
           const std::function<void(const Frame&)>& observe);

 private:
  struct Mean {
    double x, y;
  };

  bool settle(Outcome& outcome);
  void actuate(Outcome& outcome, int every, const std::function<void(const Frame&)>& observe);
  void begin_settling();
  void end_settling();
  void step(std::uint64_t n);
  void expect_speed(T speed);
  void list_pairs();
  kernels::PairCounts meet(T stiffness, T* fx, T* fy);
  bool stop();
  kernels::Lanes<T> speeds2() const;
  bool sound(Outcome& outcome, bool look_at_outline);
  void prepare_looks();
  bool solid(Outcome& outcome);
  void find_crossing(Outcome& outcome);
  double area(std::size_t triangle) const;
  void locate_failure(Outcome& outcome) const;
  double height() const;
  void look_at_gait();
  double position_x(int lane) const;
  double position_y(int lane) const;
  Mean mean_position() const;
  void show(const std::function<void(const Frame&)>& observe, std::int64_t step_index);

  const BodyBatch<T>& batch_;
  Method method_;

  // The animat being run.
  const Body* body_ = nullptr;
  const Scene* scene_ = nullptr;
  std::size_t index_ = 0;
  kernels::BodyShape<T> shape_{};
  StateBuffers<T> buffers_;
  kernels::BodyState<T> state_{};  ///< in those
  kernels::StepCoefficients<T> coefficients_{};
  kernels::StepExtremes<T> extremes_{};
  kernels::Actuation actuation_ = kernels::Actuation::none;  ///< of the phase it is in
  double step_ = 0;                                          ///< time units, of the phase it is in
  bool touched_ = false;                                     ///< the extra forces hold something
  kernels::Lanes<T> fastest2_{T(0)};  ///< squared, of the last step, each lane for itself
  CollisionList<T> collisions_;
  kernels::CollisionPairs<T> pairs_{};         ///< of the step
  int near_ = 0;                               ///< pairs within reach_
  T reach_ = 0;                                ///< d, see kernels::meet_pairs
  T expected_ = 0;                             ///< the speed up to which that is enough
  std::vector<std::size_t> lane_of_;           ///< [nodes of the body]
  std::vector<std::size_t> without_pressure_;  ///< triangles
  Aligned<T> look_[6];                         ///< [outline edges], see kernels::EdgeLook
  GaitWatch gait_;
  std::vector<double> frame_[4];
};

extern template class Runner<float>;
extern template class Runner<double>;

}  // namespace metamorph::core
