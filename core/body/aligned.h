#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace metamorph::core {

/// Storage aligned to a register, as the kernels' loads and stores demand.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t{64}));
  }
  void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t{64}); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};
template <class T>
using Aligned = std::vector<T, AlignedAllocator<T>>;

}  // namespace metamorph::core
