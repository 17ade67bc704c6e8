#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/body/area.h"
#include "metamorph/body.h"

namespace metamorph::core {

/// The nodes around the outside of a body, counter-clockwise from its lowest leftmost one; those of
/// a pinch as often as the outside comes by, without those of holes. `outline` as outline_of()
/// gives it.
std::vector<Index> around_outside(const Body& body, std::span<const std::array<Index, 2>> outline);

/// Protrusions of the outside: maxima of the distance from the centroid on the way around, of a
/// prominence of at least 0.4 times the radius of a disc of the same area (a square's corners have
/// 0.37, an equilateral triangle's 0.78). The prominence of a maximum is its rise above the highest
/// pass to a farther one; of the farthest, above the nearest point.
int count_limbs(const Body& body, const Area& area, std::span<const std::array<Index, 2>> outline);

}  // namespace metamorph::core
