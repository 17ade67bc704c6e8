#pragma once

// A record that was damaged: what each way of reading it makes of it.

#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "evolve/files/genome_file.h"
#include "evolve/run/audit.h"
#include "evolve/run/run_reader.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::tests {

/// What a way of reading says: of a whole record the truth, of a damaged one the same or "refused".
/// Whatever else is thrown gets out, and fails the test.
template <class Read>
std::string said(Read read) {
  try {
    return read();
  } catch (const evolve::InputError& error) {
    // One line, and short: what is damaged must not be shown.
    return error.lines().size() == 1 && error.lines()[0].size() < 500 ? "refused"
                                                                      : "refused at length";
  }
}

inline std::string champion_text(const evolve::Champion& champion) {
  std::string text = fmt::format("{} {} {:a} {:a}", champion.generation, champion.individual,
                                 champion.eq6, champion.score);
  for (const double distance : champion.distances) text += fmt::format(" {:a}", distance);
  for (const std::string& status : champion.statuses) text += " " + status;
  return text + evolve::genome_text(champion.genome);
}

/// [way of reading] What info, export and audit say of the run in `directory`.
inline std::vector<std::string> readings_of(const std::filesystem::path& directory) {
  using namespace evolve;
  std::vector<std::string> all;
  const auto add = [&](auto read) {
    all.push_back(said([&] {
      const RunReader run(directory);
      return std::string(read(run));
    }));
  };
  add([](const RunReader& run) { return to_toml(run.experiment()); });
  add([](const RunReader& run) { return std::to_string(run.generations_done()); });
  add([](const RunReader& run) { return champion_text(run.best()); });
  add([](const RunReader& run) { return champion_text(run.champion(1)); });
  add([](const RunReader& run) { return fmt::format("{}", run.status_counts()); });
  add([](const RunReader& run) { return fmt::format("{}", run.phase_seconds()); });
  add([](const RunReader& run) { return fmt::format("{}", run.last_session()); });
  add([](const RunReader& run) {
    const EvaluationWork work = run.work();
    return fmt::format("{} {} {} {}", work.individuals, work.developed, work.bodies,
                       work.simulated);
  });
  add([](const RunReader& run) {
    const SearchHealth health = run.health();
    std::string text = fmt::format("{} {}", health.species.value_or(-1), health.founded);
    for (const auto& [why, count] : health.ended) text += fmt::format(" {} {}", why, count);
    for (const auto& [name, children, better, dead] : health.origins) {
      text += fmt::format(" {} {} {} {}", name, children, better, dead);
    }
    if (health.archive) {
      text += fmt::format(" {} {} {:a}", health.archive->size, health.archive->copies,
                          health.archive->threshold);
    }
    for (const auto& [trial, share] : health.behaviour)
      text += fmt::format(" {} {:a}", trial, share);
    return text;
  });
  std::vector<std::string> tables;
  all.push_back(said([&] {
    tables = RunReader(directory).tables();
    return fmt::format("{}", fmt::join(tables, " "));
  }));
  for (const char* table : {"run",
                            "sessions",
                            "trials",
                            "generations",
                            "generation_trials",
                            "status_counts",
                            "individuals",
                            "outcomes",
                            "descriptors",
                            "champions",
                            "timings",
                            "work",
                            "archive",
                            "archive_sizes",
                            "members",
                            "species",
                            "populations",
                            "origins",
                            "species_changes",
                            "behaviour_shares",
                            "champion_outcomes",
                            "metamorphosis"}) {
    add([&](const RunReader& run) {
      std::string text;
      run.write_csv(table, [&](std::string_view part) { text += part; });
      return text;
    });
  }
  add([](const RunReader& run) {
    run.verify();
    return "whole";
  });
  return all;
}

/// What `audit` says.
inline std::string audit_reading(const std::filesystem::path& directory) {
  return said([&] {
    evolve::AuditOptions options;
    options.champions = 1;
    options.nearby_starts = 0;
    const evolve::RunAudit audited = evolve::audit(evolve::RunReader(directory), options);
    return fmt::format("{} {} {:a}", audited.distinct, audited.other_bits,
                       audited.champions[0].reference_eq6);
  });
}

/// What becomes of a copy of the run that goes on for one more generation.
inline std::string resumed_reading(const std::filesystem::path& directory) {
  using namespace evolve;
  return said([&] {
    {
      const std::unique_ptr<Record> record = Record::resume(directory, 1);
      record->change_generations(record->generations_done() + 1);
      run(*record, {1, {}, {}});
      record->close();
    }
    std::string text;
    for (const auto& [table, rows] : contents(directory)) {
      text += fmt::format("{}: {}\n", table, fmt::join(rows, "\n"));
    }
    return text;
  });
}

}  // namespace metamorph::tests
