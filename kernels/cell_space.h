#pragma once

#include <cstdint>

#include "kernels/node_record.h"

namespace metamorph::kernels {

/// Whether the centre of any cell but `except` lies within `space` of a point. cell: [cells]
/// records and as many more as fill the last pack.
template <class T>
inline bool is_space_taken(const NodeRecord<T>* cell, int cells, T x, T y, T space, int except) {
  constexpr int width = Lanes<T>::width;
  const Lanes<T> px(x), py(y), limit(space * space);
  for (int first = 0; first < cells; first += width) {
    const NodePack<T> pack = load<T>(cell + first);
    const Lanes<T> dx = pack.x - px, dy = pack.y - py;
    std::uint32_t taken = ~bits(dx * dx + dy * dy > limit) & ((1u << width) - 1);
    if (except >= first && except < first + width) taken &= ~(1u << (except - first));
    if (cells - first < width) taken &= (1u << (cells - first)) - 1;
    if (taken != 0) return true;
  }
  return false;
}

}  // namespace metamorph::kernels
