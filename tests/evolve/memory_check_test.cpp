#include "evolve/run/memory_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <map>

#include "evolve/experiment/memory_estimate.h"
#include "evolve/run/free_memory.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::HasSubstr;
using tests::tiny_experiment;

constexpr double infinity = std::numeric_limits<double>::infinity();

using Files = std::map<std::string, std::string>;

/// What is free where /proc and /sys hold these files.
double free_of(const Files& files, const ProcessLimits& limits = {}) {
  const tests::TemporaryDirectory root;
  for (const auto& [name, text] : files) {
    const auto file = root.path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  return free_memory(root.path(), limits);
}

const std::string meminfo = "MemTotal:  2000 kB\nMemFree:  100 kB\nMemAvailable:   1000 kB\n";

TEST(FreeMemory, OfASystem) {
  EXPECT_EQ(free_of({{"proc/meminfo", meminfo}}), 1000 * 1024);
  EXPECT_EQ(free_of({}), infinity);
  EXPECT_EQ(free_of({{"proc/meminfo", "MemTotal: many\n"}}), infinity);
  EXPECT_EQ(free_of({{"proc/meminfo", "MemAvailable:\n"}}), infinity);
}

TEST(FreeMemory, OfGroupsOfVersion2) {
  Files files = {{"proc/meminfo", meminfo},
                 {"proc/self/cgroup", "0::/user/run\n"},
                 {"sys/fs/cgroup/user/run/memory.max", "max\n"},
                 {"sys/fs/cgroup/user/run/memory.current", "90000\n"}};
  EXPECT_EQ(free_of(files), 1000 * 1024);
  files["sys/fs/cgroup/user/run/memory.max"] = "500000\n";
  EXPECT_EQ(free_of(files), 410000);
  files["sys/fs/cgroup/user/run/memory.stat"] = "anon 5\ninactive_file 20000\nactive_file 10000\n";
  EXPECT_EQ(free_of(files), 440000);
  // The group around it is tighter.
  files["sys/fs/cgroup/user/memory.max"] = "300000\n";
  files["sys/fs/cgroup/user/memory.current"] = "100000\n";
  EXPECT_EQ(free_of(files), 200000);
  files["sys/fs/cgroup/user/memory.current"] = "310000\n";
  EXPECT_EQ(free_of(files), 0);
  // In a container the mount is the group.
  EXPECT_EQ(free_of({{"proc/self/cgroup", "0::/\n"},
                     {"sys/fs/cgroup/memory.max", "7000"},
                     {"sys/fs/cgroup/memory.current", "3000"}}),
            4000);
}

TEST(FreeMemory, OfGroupsOfVersion1) {
  const Files files = {
      {"proc/self/cgroup", "5:devices:/\n4:hugetlb,memory:/a/b\n0::/\n"},
      {"sys/fs/cgroup/memory/a/b/memory.limit_in_bytes", "5000\n"},
      {"sys/fs/cgroup/memory/a/b/memory.usage_in_bytes", "2000\n"},
      {"sys/fs/cgroup/memory/a/b/memory.stat", "cache 1\ntotal_inactive_file 500\n"}};
  EXPECT_EQ(free_of(files), 3500);
  Files other = files;
  other["proc/self/cgroup"] = "4:memory:/elsewhere\n";
  EXPECT_EQ(free_of(other), infinity);
  other["sys/fs/cgroup/memory/memory.limit_in_bytes"] = "1000";
  other["sys/fs/cgroup/memory/memory.usage_in_bytes"] = "900";
  EXPECT_EQ(free_of(other), 100);
}

TEST(FreeMemory, OfALimitedProcess) {
  const Files files = {{"proc/meminfo", meminfo}, {"proc/self/statm", "20 9 8 7 0 6 0\n"}};
  const double page = static_cast<double>(sysconf(_SC_PAGESIZE));
  EXPECT_EQ(free_of(files, {.address_space = 50 * page}), 30 * page);
  EXPECT_EQ(free_of(files, {.data = 50 * page}), 44 * page);
  EXPECT_EQ(free_of(files, {.address_space = 10 * page}), 0);
  EXPECT_EQ(free_of(files, {.address_space = 1e15}), 1000 * 1024);
}

TEST(MemoryEstimate, KnowsWhatCosts) {
  const auto of_one = [](const Experiment& e) {  // beyond those developed at once
    return (memory_estimate(e, 20000, 1) - memory_estimate(e, 10000, 1)) / 10000;
  };
  const Experiment plain = tiny_experiment("simple", 2);
  EXPECT_GT(of_one(plain), 1e4);
  EXPECT_LT(of_one(plain), 1e5);
  Experiment other = plain;
  other.search.kind = "nsga2";
  EXPECT_GT(of_one(other), 1.3 * of_one(plain));
  other = plain;
  other.neat.hidden_nodes *= 10;
  EXPECT_GT(of_one(other), 4 * of_one(plain));
  other = plain;
  other.trials[1].starts = 20;
  EXPECT_GT(of_one(other), of_one(plain) + 19 * sizeof(core::Outcome));
  other = plain;
  other.development.max_cells = 4000;
  EXPECT_EQ(of_one(other), of_one(plain));
  EXPECT_GT(memory_estimate(other, 4000, 1), 20 * memory_estimate(plain, 4000, 1));
  other.trials[1].starts_renew = true;
  EXPECT_GT(of_one(other), of_one(plain) + 2 * 4000 * 100.0);
  EXPECT_GT(memory_estimate(plain, 10, 64), memory_estimate(plain, 10, 1));
}

TEST(MemoryFault, NamesThePopulationThatFits) {
  Experiment e = tiny_experiment("simple", 2);
  for (const double free : {1e8, 1e9, 8e9}) {
    e.neat.population = 1000000;
    const std::string fault = memory_fault(e, 2, free);
    EXPECT_THAT(fault, HasSubstr("neat.population = 1000000: needs about "));
    const std::string expected = "expected at most ";
    ASSERT_THAT(fault, HasSubstr(expected));
    const int fits = std::stoi(fault.substr(fault.find(expected) + expected.size()));
    e.neat.population = fits;
    EXPECT_EQ(memory_fault(e, 2, free), "");
    e.neat.population = fits + 1;
    EXPECT_NE(memory_fault(e, 2, free), "");
  }
  EXPECT_THAT(memory_fault(e, 2, 1000), HasSubstr("GB are free: expected more memory"));
  EXPECT_EQ(memory_fault(e, 2, infinity), "");
}

}  // namespace
}  // namespace metamorph::evolve
