#pragma once

#include <filesystem>
#include <limits>

namespace metamorph::evolve {

/// The most bytes that a process may have by its own limits; infinite: no limit.
struct ProcessLimits {
  double address_space = std::numeric_limits<double>::infinity();  ///< RLIMIT_AS (ulimit -v)
  double data = std::numeric_limits<double>::infinity();           ///< RLIMIT_DATA (ulimit -d)
};
ProcessLimits process_limits();

/// The bytes that this process may still take, by the tightest of: what the system has available
/// (MemAvailable), the control groups of the process and those around them (versions 1 and 2; what
/// only caches files does not count as taken), and its own limits. Infinite if the system tells
/// nothing. `root`: where /proc and /sys are found.
double free_memory(const std::filesystem::path& root, const ProcessLimits& limits);

}  // namespace metamorph::evolve
