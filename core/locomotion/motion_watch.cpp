#include "core/locomotion/motion_watch.h"

#include <cmath>
#include <limits>

namespace metamorph::core {

template <class T>
void MotionWatch<T>::reset(int groups) {
  const auto size = static_cast<std::size_t>(groups * kernels::Lanes<T>::width);
  groups_ = groups;
  marked_ = false;
  x_.resize(size);
  y_.resize(size);
  slack_ = 0;
}

template <class T>
void MotionWatch<T>::mark(const kernels::NodeRecord<T>* records, T limit) {
  constexpr int width = kernels::Lanes<T>::width;
  for (int base = 0; base < groups_ * width; base += width) {
    const kernels::NodePack<T> node = kernels::load(records + base);
    node.x.store(x_.data() + base);
    node.y.store(y_.data() + base);
  }
  limit_ = limit;
  marked_ = true;
  farthest_out_ = kernels::farthest_out(x_.data(), y_.data(), groups_);
  start_anew(limit_);
}

template <class T>
bool MotionWatch<T>::look(const kernels::NodeRecord<T>* records, const T* weight, T ahead) {
  if (!marked_) return false;
  const kernels::RigidMotion<T> motion =
      kernels::fit_rigid_motion(records, x_.data(), y_.data(), weight, groups_);
  const T farthest =
      std::sqrt(kernels::farthest_move2(records, x_.data(), y_.data(), weight, groups_, motion));
  // Nodes that are no number do not show in the farthest, but in the fit.
  if (!(farthest < limit_ - ahead) || !std::isfinite(motion.to_x + motion.to_y)) return false;
  farthest_out_ += largest(travelled_);
  start_anew(limit_ - farthest);
  return true;
}

template <class T>
void MotionWatch<T>::start_anew(T slack) {
  slack_ = slack;
  travelled_ = kernels::Lanes<T>(T(0));
  rounding_ = std::numeric_limits<T>::epsilon() * (farthest_out_ + slack);
}

template class MotionWatch<float>;
template class MotionWatch<double>;

}  // namespace metamorph::core
