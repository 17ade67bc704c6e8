#pragma once

#include <string>
#include <utility>
#include <vector>

#include "metamorph/outcome.h"

namespace metamorph::evolve {

/// One outcome as a JSON object on one line: first `labels` (key and string), then those
/// of core::outcome_fields that apply, by their names. A number that is not finite becomes null.
std::string outcome_json(const std::vector<std::pair<std::string, std::string>>& labels,
                         const core::Outcome& outcome);

}  // namespace metamorph::evolve
