#pragma once

// A whole small run, of whose calls on its files each meets a fault in turn.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "evolve/experiment/experiment_file.h"
#include "evolve/run/run_reader.h"
#include "tests/evolve/disk_faults.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::tests {

/// Three generations of four, with pictures.
class DiskFaultSweep {
 public:
  DiskFaultSweep() {
    evolve::Experiment e = tiny_experiment("novelty", 3);
    e.neat.population = 4;
    e.neat.species_min = e.neat.species_max = 1;
    std::ofstream(experiment()) << to_toml(e);
    const DisturbedEnd end = begin({});
    is_supported_ = end.is_supported;
    if (!is_supported_) return;
    EXPECT_EQ(end.exit_code, 0) << end.output;
    expected_ = contents(out());
    files_ = files_of_run();
    EXPECT_THAT(names_of(files_),
                testing::ElementsAre("best.png", "best.svg", "run.db", "run.lock"));
  }

  bool is_supported() const { return is_supported_; }

  /// Lets the calls number 1, 1 + `stride`, ... of a run meet the fault, each in a run of its own;
  /// with `lasting`, all calls from that one on.
  void meet(DiskFault fault, bool lasting, long stride, long offset = 0) {
    fault.first = fault.last = DiskFault::never;
    const long calls = begin(fault).calls;
    ASSERT_GT(calls, 50);
    right_ = failed_ = resumed_ = 0;
    for (long n = 1 + offset; n <= calls; n += stride) {
      fault.first = n;
      fault.last = lasting ? DiskFault::never : n;
      meet_one(fault);
    }
    std::printf(
        "%ld of %ld calls met the fault: %d runs were right, %d said so or were killed; of "
        "these %d went on, %d had not begun\n",
        (calls - offset + stride - 1) / stride, calls, right_, failed_, resumed_,
        failed_ - resumed_);
  }

 private:
  using Files = std::map<std::string, std::size_t>;

  std::filesystem::path here() const { return std::filesystem::canonical(directory_.path()); }
  std::filesystem::path experiment() const { return here() / "experiment.toml"; }
  std::filesystem::path out() const { return here() / "run"; }

  DisturbedEnd begin(const DiskFault& fault) const {
    std::filesystem::remove_all(out());
    return run_disturbed(
        {"evolve", experiment().string(), "--out", out().string(), "--threads", "1"}, out(), fault);
  }
  DisturbedEnd resume() const {
    return run_disturbed({"evolve", "--resume", out().string(), "--threads", "1"}, out(), {});
  }

  /// [name] What tells its bytes apart; of the record, which has times in it, nothing.
  Files files_of_run() const {
    Files files;
    for (const auto& entry : std::filesystem::directory_iterator(out())) {
      const std::string name = entry.path().filename().string();
      files[name] = name == "run.db" ? 0 : std::hash<std::string>()(text_of(entry.path()));
    }
    return files;
  }
  static std::vector<std::string> names_of(const Files& files) {
    std::vector<std::string> names;
    for (const auto& [name, hash] : files) names.push_back(name);
    return names;
  }

  void meet_one(const DiskFault& fault) {
    const DisturbedEnd end = begin(fault);
    SCOPED_TRACE(fmt::format("call {}: {}\n{}", fault.first, end.disturbed, end.output));
    if (end.exit_code == 0) {
      ++right_;
      expect_right(end.output, end.disturbed.starts_with("unlink "));
      return;
    }
    ++failed_;
    if (fault.kind == DiskFault::Kind::kill) {
      EXPECT_EQ(end.exit_code, -1);
    } else {
      EXPECT_TRUE(end.exit_code == 1 || end.exit_code == 2) << "exit code " << end.exit_code;
      EXPECT_EQ(fault_lines(end.output), 1);
    }
    EXPECT_THAT(end.output, testing::Not(testing::HasSubstr("recorded in ")));
    go_on(generations_told(end.output));
  }

  /// The run that said that all is well. What cannot be deleted stays: an empty log, and its index.
  void expect_right(const std::string& output, bool keeps_log = false) const {
    evolve::RunReader(out()).verify();
    EXPECT_EQ(contents(out()), expected_);
    // Pictures may fail, but not in silence.
    if (output.find("no picture of the best: ") == std::string::npos) {
      Files files = files_of_run();
      if (keeps_log) {
        files.erase("run.db-shm");
        if (text_of(out() / "run.db-wal").empty()) files.erase("run.db-wal");
      }
      EXPECT_EQ(files, files_);
    }
  }

  void go_on(int told) {
    DisturbedEnd end = resume();
    if (end.exit_code == 2 && end.output.find(": holds no ") != std::string::npos) {
      EXPECT_EQ(told, 0) << "generations are lost";
      end = begin({});
    } else {
      ++resumed_;
    }
    EXPECT_EQ(end.exit_code, 0) << end.output;
    expect_right("");
  }

  /// Lines that tell a fault: all others begin with a word of their own.
  static int fault_lines(const std::string& output) {
    int count = 0;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
      count += line.starts_with("/") || line.starts_with("metamorph: ") ? 1 : 0;
    }
    return count;
  }
  static int generations_told(const std::string& output) {
    int count = 0;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
      count += line.starts_with("generation ") ? 1 : 0;
    }
    return count;
  }

  TemporaryDirectory directory_;
  bool is_supported_ = false;
  std::map<std::string, std::vector<std::string>> expected_;
  Files files_;
  int right_ = 0, failed_ = 0, resumed_ = 0;
};

}  // namespace metamorph::tests
