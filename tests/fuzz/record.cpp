// The record of a run: whatever its bytes, all that RunReader gives is given or refused.

#include <fstream>

#include "evolve/run/record_schema.h"
#include "evolve/run/run_reader.h"
#include "evolve/study/figure.h"
#include "tests/evolve/files.h"
#include "tests/fuzz/contract.h"

using namespace metamorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tests::TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / evolve::record_file;
  for (const std::string& name : directory.names()) {  // what SQLite left of the last one
    std::filesystem::remove(directory.path() / name);
  }
  std::ofstream(file, std::ios::binary) << fuzz::text_of(data, size);

  const std::string source = file.string();
  std::unique_ptr<evolve::RunReader> run;
  if (!fuzz::is_taken(source, [&] { run = std::make_unique<evolve::RunReader>(file); })) return 0;
  const auto taken = [&](auto read) { return fuzz::is_taken(source, read); };
  taken([&] { run->verify(); });
  taken([&] { run->generations_done(); });
  taken([&] { run->champion(0); });
  taken([&] { run->status_counts(); });
  taken([&] { run->phase_seconds(); });
  taken([&] { run->last_session(); });
  taken([&] { run->work(); });
  taken([&] { run->health(); });

  evolve::Experiment experiment;
  evolve::Champion best;
  if (taken([&] { experiment = run->experiment(); }) && taken([&] { best = run->best(); })) {
    // `info` shows a trial's name beside its outcome.
    fuzz::require(best.statuses.size() == experiment.trials.size() &&
                      best.distances.size() == experiment.trials.size(),
                  "the best has an outcome of every trial");
  }
  std::vector<std::string> tables;
  taken([&] { tables = run->tables(); });
  for (const std::string& table : tables) {
    taken([&] { run->write_csv(table, [](std::string_view) {}); });
  }
  for (const evolve::PlotKind& kind : evolve::plot_kinds()) {
    taken([&] {
      const evolve::Study study = evolve::study_of({&file, 1}, kind, evolve::Centre::mean, {});
      const evolve::Chart chart = evolve::figure_of(study, kind, evolve::Centre::mean);
      fuzz::require(!evolve::csv_of(study).empty() && !evolve::draw_chart(chart, "a.svg").empty(),
                    "what is read is drawn");
    });
  }
  return 0;
}
