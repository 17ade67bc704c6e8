#pragma once

#include <array>
#include <string>
#include <vector>

#include "metamorph/status.h"

namespace metamorph::core {

using Index = int;

/// A soft body at rest (MODEL section 3): a triangular mesh with springs on its edges and an
/// oscillator in every node. Units: cell diameter d, spring constant k, cell mass m all 1.
/// This is the exchange form; BodyBatch packs many of them for the fast kernels.
struct Body {
  std::vector<double> x, y;                     ///< [nodes] position at rest, d
  std::vector<double> period;                   ///< [nodes] oscillation period T, time units
  std::vector<double> phase;                    ///< [nodes] phase shift phi, radians
  std::vector<std::array<Index, 3>> triangles;  ///< counter-clockwise node triples
  std::vector<std::array<Index, 2>> springs;    ///< edges of the triangles, i < j, ascending
  std::vector<double> rest_length;              ///< [springs] L0, d
  std::vector<double> rest_area;                ///< [triangles] S0, d^2
  std::vector<Index> cell;  ///< [nodes] position in the embryo's cell list; may be empty

  Index node_count() const { return static_cast<Index>(x.size()); }
};

/// The distinct edges (i < j, ascending) of a set of triangles.
std::vector<std::array<Index, 2>> edges_of(const std::vector<std::array<Index, 3>>& triangles);

/// Edges with exactly one triangle, directed so that the body lies on their left; ascending by
/// (first, second). Every outline node has as many outgoing as incoming edges (a pinch has two).
std::vector<std::array<Index, 2>> outline_of(const std::vector<std::array<Index, 3>>& triangles);

/// Area of a triangle of the body from its nodes, d^2; positive if counter-clockwise.
double signed_area(const Body& body, const std::array<Index, 3>& triangle);

/// Distance of a spring's nodes, d.
double length(const Body& body, const std::array<Index, 2>& spring);

/// Sets springs, rest_length and rest_area from nodes and triangles.
void set_rest_from_nodes(Body& body);

/// What is wrong with a body, as found by check().
struct BodyFault {
  Status status = Status::ok;  ///< ok, or bad_input, bad_geometry, bad_topology
  std::string what;            ///< one line: field, index, value, what was expected
};

/// Shortest period of an oscillator, time units.
inline constexpr double smallest_period = 1e-3;

/// All faults of a body: sizes, finite values, nodes within 1e6 d of the origin in x and y, periods
/// below smallest_period, indices, coincident nodes (closer than 1e-3 d), orientation (every
/// triangle counter-clockwise, with an area), rest lengths and rest areas below 1e-3 where they are
/// not those of the nodes, isolated nodes, edges with overlapping or more than two triangles,
/// triangles around a node beside a closed fan, more than one edge-connected component, springs
/// other than the edges of the triangles, an outline that crosses or touches itself, parts that
/// overlap. Empty if the body is sound. Where sizes or indices are wrong, what depends on them is
/// not looked at, nor overlap where a triangle or an edge is faulty. A pinch (a node that alone
/// holds two parts of one component together) and a hole are no faults.
std::vector<BodyFault> check(const Body& body);

/// The status that a list of faults amounts to: the most basic of them, ok if there is none.
Status status_of(const std::vector<BodyFault>& faults);

}  // namespace metamorph::core
