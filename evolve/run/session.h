#pragma once

#include <string>
#include <utility>
#include <vector>

namespace metamorph::evolve {

/// Where and with what a run is computed: version, compiler, flags, libraries, machine, threads,
/// start (UTC). Nothing here decides a result.
std::vector<std::pair<std::string, std::string>> session_facts(int threads);

}  // namespace metamorph::evolve
