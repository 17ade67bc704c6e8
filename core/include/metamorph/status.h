#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace metamorph::core {

/// How one evaluation of one animat ended. A failing animat is data: it has one of these codes, the
/// step, index and value that showed it (see Outcome), and distance 0; it disturbs nobody.
enum class Status : std::uint8_t {
  ok,
  not_settled,      ///< ran, but was still moving when settling timed out, or had gone too
                    ///< far by then; its distance counts
  empty,            ///< no cell alive at the stage end; normal, distance 0
  no_body,          ///< fewer than 8 nodes after extraction; normal, distance 0
  bad_input,        ///< a parameter is not finite or has the wrong sign
  bad_geometry,     ///< coincident nodes, or a triangle without area or turned the wrong way
  bad_topology,     ///< isolated node, or more than one edge-connected component
  bad_development,  ///< development became infinite or not a number: there is no body
  step_too_large,   ///< the step is beyond what the method, a period or the run's length allows
  inverted,         ///< a triangle turned inside out
  crossed,          ///< the outline crossed itself
  collapsed,        ///< a triangle was squeezed below what the step resolves
  speed,            ///< a node moved faster than the step resolves
  non_finite,       ///< a state became infinite or not a number
};

inline constexpr int status_count = 14;

/// All codes in order, to count or to list them.
inline constexpr std::array<Status, status_count> all_statuses = {
    Status::ok,           Status::not_settled,     Status::empty,
    Status::no_body,      Status::bad_input,       Status::bad_geometry,
    Status::bad_topology, Status::bad_development, Status::step_too_large,
    Status::inverted,     Status::crossed,         Status::collapsed,
    Status::speed,        Status::non_finite};

/// The code's name as written in records and JSON ("ok", "not_settled", ...).
std::string_view name(Status status);

/// True for codes that mean a numerical or input failure (bad_input and all after it).
constexpr bool is_failure(Status status) { return status >= Status::bad_input; }

}  // namespace metamorph::core
