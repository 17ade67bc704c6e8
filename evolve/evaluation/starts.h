#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "metamorph/body.h"
#include "metamorph/evaluator.h"
#include "metamorph/outcome.h"

namespace metamorph::evolve {

/// True if the trial runs the body in this start from other places than it has. Start 0 is the body
/// as it is, unless every generation is to have starts of its own.
constexpr bool is_displaced(const Trial& trial, int start) {
  return start > 0 || trial.starts_renew;
}

/// The body of a start of the trial: displaced by numbers that depend on the seed, the start, the
/// index of the node and, where starts are renewed, the generation. All bodies of a generation are
/// displaced alike, so equal bodies stay equal.
core::Body start_of(const core::Body& body, const Trial& trial, int start, std::uint64_t seed,
                    int generation);

/// Which of a trial's starts tells what they amount to. They are ranked, failures first, then by
/// distance, of equals the earlier first: with `least` it is the first, else the middle one, of two
/// middle ones the lower. Precondition: there is a start.
std::size_t telling_start(std::span<const core::Outcome> outcomes, StartsCombine rule);

/// What the outcomes of a trial's starts, in their order, amount to; of one start its outcome, to
/// the bit. Ranked as above it is
///   least   the outcome of the first;
///   median  that of the middle one;
///   mean    that of the median, but with the mean distance of all starts, where a failed one
///           counts 0, and the means of mean_position, height, stance and gait_frequency over those
///           that did not fail; if the median failed, its outcome as it is.
/// So a body fails where its median (or with `least` any) start fails, and has then distance 0.
/// Precondition: there is a start.
core::Outcome combine_starts(std::span<const core::Outcome> outcomes, StartsCombine rule);

}  // namespace metamorph::evolve
