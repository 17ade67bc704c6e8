#include "evolve/run/free_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace metamorph::evolve {
namespace {

namespace fs = std::filesystem;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The number behind a word that begins a line, as in "MemAvailable:  123 kB".
std::optional<double> number_after(const fs::path& file, std::string_view word) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string first;
    double number = 0;
    if (words >> first && first == word && words >> number) return number;
  }
  return {};
}

/// The number that a file begins with; none if there is no such file, or "max" in it.
std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  double number = 0;
  return stream >> number ? std::optional(number) : std::nullopt;
}

/// How a version of control groups tells of memory.
struct GroupFiles {
  const char *mount, *limit, *used, *inactive_cache, *active_cache;
};
constexpr GroupFiles version_1 = {"sys/fs/cgroup/memory", "memory.limit_in_bytes",
                                  "memory.usage_in_bytes", "total_inactive_file",
                                  "total_active_file"};
constexpr GroupFiles version_2 = {"sys/fs/cgroup", "memory.max", "memory.current", "inactive_file",
                                  "active_file"};

/// What is left to a group.
double left_to(const fs::path& group, const GroupFiles& files) {
  const std::optional<double> limit = number_in(group / files.limit);
  const std::optional<double> used = number_in(group / files.used);
  if (!limit || !used) return infinity;
  const fs::path statistics = group / "memory.stat";
  const double cache = number_after(statistics, files.inactive_cache).value_or(0) +
                       number_after(statistics, files.active_cache).value_or(0);
  return *limit - std::max(0.0, *used - cache);
}

/// What is left to a group and all around it. In a container the mount may show the group itself
/// and not where the system has it; what is not there is no limit.
double left_to_all(const fs::path& root, fs::path group, const GroupFiles& files) {
  double left = left_to(root / files.mount, files);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path()) {
    left = std::min(left, left_to(root / files.mount / group, files));
  }
  return left;
}

double left_to_groups(const fs::path& root) {
  double left = infinity;
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {  // number:controllers:path
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers =
        fmt::format(",{},", std::string_view(line).substr(first + 1, second - first - 1));
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,") {
      left = std::min(left, left_to_all(root, group, version_2));
    } else if (controllers.find(",memory,") != std::string::npos) {
      left = std::min(left, left_to_all(root, group, version_1));
    }
  }
  return left;
}

double left_to_process(const fs::path& root, const ProcessLimits& limits) {
  // In pages: all, resident, shared, text, library, data and stack.
  std::ifstream stream(root / "proc/self/statm");
  double all = 0, other = 0, data = 0;
  stream >> all >> other >> other >> other >> other >> data;
  const double page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::min(limits.address_space - page * all, limits.data - page * data);
}

}  // namespace

ProcessLimits process_limits() {
  const auto limit_of = [](auto resource) {
    rlimit limit{};
    const bool limited = getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return limited ? static_cast<double>(limit.rlim_cur) : infinity;
  };
  return {limit_of(RLIMIT_AS), limit_of(RLIMIT_DATA)};
}

double free_memory(const fs::path& root, const ProcessLimits& limits) {
  const std::optional<double> available = number_after(root / "proc/meminfo", "MemAvailable:");
  const double free = std::min({available ? *available * 1024 : infinity, left_to_groups(root),
                                left_to_process(root, limits)});
  return std::max(free, 0.0);
}

}  // namespace metamorph::evolve
