#pragma once

// Helpers for tests of runs and their records.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "evolve/experiment/experiment_file.h"
#include "evolve/run/integrity.h"
#include "evolve/run/run.h"
#include "evolve/run/sqlite.h"

namespace metamorph::tests {

/// A water-to-land experiment that takes a moment: 12 individuals, short runs.
inline evolve::Experiment tiny_experiment(const std::string& kind, int generations,
                                          std::uint64_t seed = 3) {
  evolve::Experiment e = evolve::parse_experiment(
      "name = \"tiny\"\n"
      "[neat]\npopulation = 12\n"
      "[search]\nneighbours = 3\narchive_threshold = 0.2\n"
      "[development]\nsteps = 300\nmax_cells = 40\n"
      "[[trials]]\nname = \"larva\"\nstage = 180\nscene = \"water\"\n"
      "[[trials]]\nname = \"adult\"\nstage = 300\nscene = \"land\"\n",
      "tiny",
      {{"test", "scenes.*.run_steps", "60"},
       {"test", "scenes.*.ramp_steps", "20"},
       {"test", "scenes.land.settle_quiet_steps", "20"},
       {"test", "scenes.land.settle_max_steps", "60"}});
  e.search.kind = kind;
  e.generations = generations;
  e.seed = seed;
  return e;
}

/// The same with a third stage, back in the water: a newt.
inline evolve::Experiment tiny_newt(const std::string& kind, int generations) {
  evolve::Experiment e = tiny_experiment(kind, generations);
  e.trials[0].stage = 120;
  e.trials[1].stage = 210;
  e.trials.push_back(e.trials[0]);
  e.trials[2].name = "newt";
  e.trials[2].stage = 300;
  return e;
}

inline std::vector<core::Network> networks_of(std::span<const evolve::Genome> genomes) {
  std::vector<core::Network> networks;
  for (const evolve::Genome& genome : genomes) networks.push_back(compile(genome));
  return networks;
}

/// Every table that belongs to "the same bits", as text: numbers to the last digit, blobs in hex.
/// Left out: what depends on wall-clock, machine and interruptions.
inline std::map<std::string, std::vector<std::string>> contents(
    const std::filesystem::path& directory) {
  evolve::Database database(directory / "run.db", evolve::Database::Mode::read);
  evolve::Statement tables(database, "SELECT name FROM sqlite_master WHERE type = 'table'");
  std::map<std::string, std::vector<std::string>> result;
  while (tables.step()) {
    const std::string table = tables.text(0);
    if (evolve::ledger_of(table) == evolve::Ledger::session) continue;
    if (table == "session_digests") continue;
    std::vector<std::string>& rows = result[table];
    evolve::Statement select(database, "SELECT * FROM " + table);
    while (select.step()) {
      std::string row;
      for (int c = 0; c < select.columns(); ++c) {
        if (table == "checkpoint" && select.name(c) == "state") {
          for (const std::uint8_t byte : select.blob(c)) row += fmt::format("{:02x}", byte);
        } else if (select.is_real(c)) {
          row += fmt::format("{:a}|", select.real(c));
        } else {
          row += select.is_null(c) ? "null|" : select.text(c) + "|";
        }
      }
      rows.push_back(std::move(row));
    }
  }
  return result;
}

/// Changes a record by SQL and makes it whole again, as no damage does: what it says is false, but
/// it is what was written.
inline void falsify(const std::filesystem::path& directory, const std::string& sql) {
  using namespace evolve;
  Database database(directory / "run.db", Database::Mode::write);
  database.run(sql);
  std::map<std::int64_t, Digests> digests;
  int generations = 0;
  {
    Statement select(database, "SELECT max(number) + 1 FROM digests");
    if (select.step()) generations = static_cast<int>(select.integer(0));
  }
  for (const std::string& table : counted_tables(database)) {
    const auto found = digests_of(database, table).of;
    for (int g = 0; g < generations; ++g) {
      const auto of_generation = found.find(g);
      digests[g][table] = of_generation == found.end() ? TableDigest() : of_generation->second;
    }
  }
  digests[before_generations] = frame_digests(database);
  for (const auto& [number, of] : digests) write_digests(database, Ledger::chained, number, of);
  Statement select(database, "SELECT state FROM checkpoint");
  if (!select.step()) return;
  Checkpoint checkpoint = decode(select.blob(0), directory.string());
  checkpoint.chain = chain_of(database);
  select.step();
  Statement update(database, "UPDATE checkpoint SET state = ?");
  update.bind_blob(encode(checkpoint)).run();
}

/// Runs an experiment from its start to its end in a new directory.
inline evolve::RunSummary run_whole(const std::filesystem::path& directory,
                                    const evolve::Experiment& experiment, int threads = 1) {
  evolve::Record record(directory, experiment, threads);
  return evolve::run(record, {threads, {}, {}});
}

/// Runs `experiment`, stopping after every generation in `stops` and resuming.
inline void run_in_pieces(const std::filesystem::path& directory,
                          const evolve::Experiment& experiment, std::vector<int> stops) {
  stops.push_back(experiment.generations);
  int done = 0;
  for (const int stop : stops) {
    const std::unique_ptr<evolve::Record> record =
        std::filesystem::exists(directory)
            ? evolve::Record::resume(directory, 1)
            : std::make_unique<evolve::Record>(directory, experiment, 1);
    int left = stop - done;
    const evolve::RunSummary summary = evolve::run(*record, {1, [&] { return left-- == 0; }, {}});
    EXPECT_EQ(summary.generations_done, stop);
    EXPECT_EQ(summary.interrupted, stop < experiment.generations);
    done = stop;
  }
}

}  // namespace metamorph::tests
