#pragma once

#include <string>
#include <vector>

#include "metamorph/searches.h"

namespace metamorph::evolve {

/// One contradiction for every name that is no descriptor of the problem.
std::vector<Contradiction> unknown_descriptors(const std::string& key,
                                               const std::vector<std::string>& names,
                                               const SearchSetup& setup);

}  // namespace metamorph::evolve
