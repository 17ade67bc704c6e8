#include "evolve/run/session.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <thread>

#include "metamorph/threads.h"
namespace metamorph::evolve {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> session_facts(int threads) {
  utsname system{};
  uname(&system);
#ifdef __clang__
  const std::string compiler = "clang " __clang_version__;
#else
  const std::string compiler = "gcc " __VERSION__;
#endif
  return {{"version", METAMORPH_VERSION},
          {"compiler", compiler},
          {"flags", METAMORPH_FLAGS},
          {"sqlite", sqlite3_libversion()},
          {"processor", processor()},
          {"cores", std::to_string(std::thread::hardware_concurrency())},
          {"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)},
          {"threads", std::to_string(core::thread_count(threads))},
          {"started", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace metamorph::evolve
