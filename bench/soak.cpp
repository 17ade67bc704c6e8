// A long run: does it take more memory, time or room with every generation? What bench/SOAK.md
// says.
//
//   soak DIRECTORY GENERATIONS >soak.csv
//
// Fails if memory grows by more than the novelty archive and the genomes account for.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "evolve/experiment/experiment_file.h"
#include "evolve/run/run.h"

namespace metamorph::evolve {
namespace {

constexpr int settled = 200;  ///< generations, after which caches are full

/// Forty individuals that take a moment, and an archive that takes up many of them.
Experiment cheap_experiment(int generations) {
  Experiment e = parse_experiment(
      "name = \"soak\"\n"
      "[neat]\npopulation = 40\n"
      "[search]\nkind = \"novelty\"\narchive_threshold = 0.05\narchive_floor = 0.01\n"
      "archive_idle = 5\n"
      "[development]\nsteps = 300\nmax_cells = 40\n"
      "[[trials]]\nname = \"larva\"\nstage = 180\nscene = \"water\"\n"
      "[[trials]]\nname = \"adult\"\nstage = 300\nscene = \"water\"\n"
      "[scenes.water]\nrun_steps = 60\nramp_steps = 20\n",
      "soak");
  e.generations = generations;
  return e;
}

/// A line "NAME:  NUMBER kB" of what the kernel tells of this process, in KiB.
long memory(std::string_view name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(name)) return std::strtol(line.c_str() + name.size() + 1, nullptr, 10);
  }
  return 0;
}

struct Sample {
  double seconds = 0;
  long resident = 0;          ///< KiB
  std::int64_t entries = 0;   ///< of the archive
  std::size_t links = 0;      ///< of all genomes
  std::uintmax_t record = 0;  ///< bytes, log included
};

class Samples : public Reporter {
 public:
  explicit Samples(std::filesystem::path directory) : directory_(std::move(directory)) {}

  void generation_done(const GenerationReport& report) override {
    Sample sample;
    sample.seconds = report.seconds;
    sample.resident = memory("VmRSS:");
    // Of the tables of a novelty search, that of the sizes of its archive.
    sample.entries = std::get<std::int64_t>(report.result.search_rows.at(6).at(0).at(2));
    for (const Genome& genome : report.result.asked.genomes) sample.links += genome.links.size();
    for (const auto& entry : std::filesystem::directory_iterator(directory_)) {
      sample.record += entry.file_size();
    }
    all.push_back(sample);
  }

  std::vector<Sample> all;

 private:
  std::filesystem::path directory_;
};

double median_seconds(std::vector<Sample> samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end(),
                   [](const Sample& a, const Sample& b) { return a.seconds < b.seconds; });
  return middle->seconds;
}

/// What a block of so many bytes takes of the heap (glibc).
constexpr double block(double bytes) { return bytes + 8 <= 32 ? 32 : 16 * (int(bytes + 23) / 16); }

/// KiB that an entry of the archive may take.
double of_entry(int descriptors) {
  const double behaviour = block(8.0 * descriptors);
  // Its place in the list, which doubles and leaves the old one behind; its behaviour there, and in
  // the set of all, whose nodes have four words beside it; the coordinates that distances are taken
  // from, once as they are and once sorted.
  return (3 * 48 + 2 * behaviour + block(32 + 24) + 2 * 8.0 * descriptors) / 1024;
}

/// KiB that a link of a genome may take: as it is evaluated, bred, compiled, and known from the
/// generation before; four values of a checkpoint, once as JSON and once as bytes.
constexpr double of_link = (4 * 32 + 4 * (16 + 9)) / 1024.0;
constexpr double page_cache = 2000;  ///< KiB that SQLite keeps of a file at most

int soak(const std::filesystem::path& directory, int generations) {
  Samples samples(directory);
  {
    Record record(directory, cheap_experiment(generations), 1);
    run(record, {1, {}, {&samples}});
    record.close();
  }
  const std::vector<Sample>& all = samples.all;
  fmt::print("generation,seconds,resident_kib,archive,links,record_bytes\n");
  for (std::size_t g = 0; g < all.size(); ++g) {
    if ((g + 1) % 20 != 0) continue;
    fmt::print("{},{:.6f},{},{},{},{}\n", g + 1, all[g].seconds, all[g].resident, all[g].entries,
               all[g].links, all[g].record);
  }
  const Sample &early = all[settled - 1], &late = all.back();
  const double grown = static_cast<double>(late.resident - early.resident);
  const double explained =
      static_cast<double>(late.entries - early.entries) * of_entry(4) +
      (static_cast<double>(late.links) - static_cast<double>(early.links)) * of_link + page_cache;
  fmt::print(stderr,
             "resident: {} KiB at generation {}, {} at the end, {} at most; grown by {:.0f}, of "
             "which the archive of {} entries, genomes and page cache explain {:.0f}\n",
             early.resident, settled, late.resident, memory("VmHWM:"), grown, late.entries,
             explained);
  fmt::print(stderr, "seconds per generation, median: {:.4f} of the first {}, {:.4f} of the last\n",
             median_seconds({all.begin(), all.begin() + settled}), settled,
             median_seconds({all.end() - settled, all.end()}));
  fmt::print(
      stderr, "record: {:.0f} bytes per generation\n",
      static_cast<double>(late.record - early.record) / static_cast<double>(all.size() - settled));
  return grown <= explained ? 0 : 1;
}

}  // namespace
}  // namespace metamorph::evolve

int main(int argc, char** argv) {
  const int generations = argc == 3 ? std::atoi(argv[2]) : 0;
  if (generations < 2 * metamorph::evolve::settled) {
    std::fputs("usage: soak DIRECTORY GENERATIONS >FILE.csv\n  at least 400 generations\n", stderr);
    return 2;
  }
  try {
    return metamorph::evolve::soak(argv[1], generations);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
