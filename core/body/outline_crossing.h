#pragma once

#include <array>
#include <optional>
#include <span>

#include "metamorph/body.h"

namespace metamorph::core {

// Whether a body lies in the plane without overlap, as its outline tells. Positions x, y by node,
// at rest or of a frame, all finite; outline edges as outline_of() gives them, the body on their
// left. Decided exactly, by the predicates of core/body/predicates.h.
//
// The triangles that cover a point are counted by the winding number of the outline around it, as
// long as all of them are counter-clockwise. An outline that neither crosses nor touches itself and
// has winding number 0 on the right of all its edges therefore bounds a body that covers no point
// twice, whatever its triangles do inside.

/// How two outline edges meet that should not.
enum class Meeting {
  crossing,  ///< each passes through the other
  touching,  ///< a node of one lies on the other, or they run along each other
  pinch,     ///< at a node of both, of two parts that hang together there one lies in the other
};

/// Two outline edges that meet.
struct OutlineCrossing {
  std::array<Index, 2> edges{};  ///< positions in the list of edges, ascending
  Meeting meeting = Meeting::crossing;
  Index node = -1;  ///< the node that lies on both edges; -1 if they cross between their nodes
};

/// The lowest pair of edges (by the first, then the second) that have more in common than a node of
/// both; where there is none, two edges that follow one another around a pinch and both begin or
/// both end there. Nothing if the outline neither crosses nor touches itself.
std::optional<OutlineCrossing> first_crossing(std::span<const double> x, std::span<const double> y,
                                              std::span<const std::array<Index, 2>> outline);

/// The position of an outline edge on whose right lies another part of the body, or on whose left
/// lie several. Precondition: every edge has a length, and first_crossing() finds nothing.
std::optional<Index> first_overlap(std::span<const double> x, std::span<const double> y,
                                   std::span<const std::array<Index, 2>> outline);

}  // namespace metamorph::core
