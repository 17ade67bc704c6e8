#pragma once

#include <array>
#include <cstddef>
#include <span>

/// The plain double-precision physics of one animat (MODEL section 4): the independent opponent of
/// the fast kernels. Every force is a loop over its own elements that adds to per-node sums.
/// Units: cell diameter d, cell mass m and spring constant k are 1 in the model; the functions hold
/// in any consistent system.
namespace metamorph::kernels::reference {

using Edge = std::array<int, 2>;
using Triangle = std::array<int, 3>;

/// Node numbers as places in arrays.
template <std::size_t n>
constexpr std::array<std::size_t, n> places(const std::array<int, n>& nodes) {
  std::array<std::size_t, n> result{};
  for (std::size_t i = 0; i < n; ++i) result[i] = static_cast<std::size_t>(nodes[i]);
  return result;
}

/// Where the nodes are and how fast they move; all [nodes].
struct Nodes {
  std::span<const double> x, y, vx, vy;
};

/// Sums of the forces on the nodes; both [nodes].
struct Forces {
  std::span<double> x, y;
};

}  // namespace metamorph::kernels::reference
