#pragma once

#include <string>
#include <utility>
#include <vector>

#include "metamorph/outcome.h"

namespace metamorph::evolve {

/// One outcome as a JSON object on one line: first `labels` (key and string), then the fields of
/// core::Outcome by their names; of a failure also `failed_step`, `failed_index`, `failed_value`.
/// A number that is not finite becomes null.
std::string outcome_json(const std::vector<std::pair<std::string, std::string>>& labels,
                         const core::Outcome& outcome);

}  // namespace metamorph::evolve
