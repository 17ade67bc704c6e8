#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <functional>
#include <memory>

#include "evolve/app/commands.h"
#include "evolve/experiment/experiment_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/output_file.h"
#include "evolve/run/run_reader.h"

namespace metamorph::evolve {
namespace {

struct Arguments {
  std::string run, champion, table, out;
  bool configuration = false;
  bool list = false;
  bool overwrite = false;
};

Champion chosen_champion(const RunReader& run, const std::string& which) {
  if (which == "best") return run.best();
  int generation = 0;
  const auto [end, error] = std::from_chars(which.data(), which.data() + which.size(), generation);
  if (error != std::errc() || end != which.data() + which.size()) {
    throw InputError(
        fmt::format("--champion {}: expected best or the number of a generation", which));
  }
  return run.champion(generation);
}

void export_to(const RunReader& run, const Arguments& given,
               const std::function<void(std::string_view)>& write) {
  if (!given.champion.empty()) {
    write(genome_text(chosen_champion(run, given.champion).genome));
  } else if (!given.table.empty()) {
    run.write_csv(given.table, write);
  } else if (given.configuration) {
    write(to_toml(run.experiment()));
  } else {
    for (const std::string& table : run.tables()) write(table + '\n');
  }
}

void export_run(const Arguments& given) {
  const int asked = (given.champion.empty() ? 0 : 1) + (given.table.empty() ? 0 : 1) +
                    (given.configuration ? 1 : 0) + (given.list ? 1 : 0);
  if (asked != 1) {
    throw InputError("export: expected one of --champion, --table, --configuration and --list");
  }
  const Overwrite overwrite = given.overwrite ? Overwrite::yes : Overwrite::no;
  const RunReader run(given.run);
  if (given.out.empty()) {
    export_to(run, given, [](std::string_view text) { fmt::print("{}", text); });
    return;
  }
  OutputFile file(given.out, overwrite);
  export_to(run, given, [&](std::string_view text) { file.write(text); });
  file.commit();
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("export", "Writes tables (CSV) or champions (genome JSON) of a run");
  auto given = std::make_shared<Arguments>();
  command->add_option("RUN", given->run, "directory of a run, or its run.db")->required();
  command->add_option("--champion", given->champion,
                      "genome of the best by eq 6: best (of the run), or a generation's number");
  command->add_option("--table", given->table, "table as CSV; --list names them");
  command->add_flag("--configuration", given->configuration, "the complete experiment (TOML)");
  command->add_flag("--list", given->list, "names of the tables");
  command->add_option("--out", given->out, "file to write; default: standard output");
  command->add_flag("--overwrite,--force", given->overwrite, "replace a file that exists");
  command->callback([given] { export_run(*given); });
}

}  // namespace metamorph::evolve
