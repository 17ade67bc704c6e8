#include "evolve/run/record.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "evolve/evaluation/stopwatch.h"
#include "evolve/experiment/experiment_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/run/descriptor_table.h"
#include "evolve/run/outcome_table.h"
#include "evolve/run/record_schema.h"
#include "evolve/run/search_tables.h"
#include "evolve/run/session.h"

namespace metamorph::evolve {
namespace {

std::filesystem::path make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error || !std::filesystem::is_directory(directory)) {
    throw InputError(fmt::format("{}: cannot be made: {}", directory.string(),
                                 error ? error.message() : "a file of that name exists"));
  }
  if (!std::filesystem::is_empty(directory, error) || error) {
    throw InputError(fmt::format(
        "{}: is not empty: expected a new directory for the run; --resume {} goes on with a run",
        directory.string(), directory.string()));
  }
  return directory;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

std::string record_schema() {
  std::string sql = record_tables;
  const auto put = [&](std::string_view place, const std::string& columns) {
    sql.replace(sql.find(place), place.size(), columns);
  };
  put("OUTCOME_COLUMNS", outcome_columns());
  put("DESCRIPTOR_COLUMNS", descriptor_columns());
  return sql + work_table;
}

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "run.lock";
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) {
    throw InputError(fmt::format("{}: cannot be written: {}", file.string(),
                                 std::error_code(errno, std::generic_category()).message()));
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor_);
    throw InputError(
        fmt::format("{}: another metamorph evolve is writing this run", directory.string()));
  }
}

DirectoryLock::~DirectoryLock() { close(descriptor_); }

Record::Record(const std::filesystem::path& directory) : directory_(directory) {}

Record::Record(const std::filesystem::path& directory, const Experiment& experiment, int threads)
    : directory_(make_directory(directory)), lock_(std::make_unique<DirectoryLock>(directory)) {
  database_ = std::make_unique<Database>(directory / record_file, Database::Mode::create);
  // Readers may look on while the run writes.
  database_->run("PRAGMA journal_mode = WAL");
  Transaction transaction(*database_);
  database_->run(record_schema());
  Statement insert(*database_, "INSERT INTO run VALUES (?, ?)");
  insert.bind("format").bind(record_format).run();
  insert.bind("experiment").bind(experiment.name).run();
  insert.bind("seed").bind(std::to_string(experiment.seed)).run();
  insert.bind("configuration").bind(to_toml(experiment)).run();
  Statement trial(*database_, "INSERT INTO trials VALUES (?, ?, ?, ?)");
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const Trial& given = experiment.trials[t];
    trial.bind(static_cast<int>(t)).bind(given.name).bind(given.stage).bind(given.scene).run();
  }
  start_session(threads);
  transaction.commit();
}

std::unique_ptr<Record> Record::resume(const std::filesystem::path& directory, int threads) {
  if (!std::filesystem::is_regular_file(directory / record_file)) {
    throw InputError(fmt::format("{}: holds no {}: expected the directory of a run",
                                 directory.string(), record_file));
  }
  std::unique_ptr<Record> record(new Record(directory));
  record->lock_ = std::make_unique<DirectoryLock>(directory);
  record->database_ = std::make_unique<Database>(directory / record_file, Database::Mode::write);
  Database& database = *record->database_;
  {
    Statement tables(database, "SELECT count(*) FROM sqlite_master WHERE name = 'run'");
    tables.step();
    if (tables.integer(0) == 0) {
      throw InputError(
          fmt::format("{}: holds no experiment: the run was stopped before it began "
                      "(delete its directory), or this is no record of a run",
                      database.file().string()));
    }
  }
  {
    Statement check(database, "PRAGMA quick_check(1)");
    if (!check.step() || check.text(0) != "ok") {
      throw InputError(fmt::format("{}: damaged: {}", database.file().string(), check.text(0)));
    }
  }
  {
    Statement format(database, "SELECT value FROM run WHERE key = 'format'");
    if (!format.step() || format.text(0) != record_format) {
      throw InputError(fmt::format("{}: format = \"{}\": expected \"{}\"", database.file().string(),
                                   format.text(0), record_format));
    }
  }
  database.run("PRAGMA journal_mode = WAL");
  Transaction transaction(database);
  record->start_session(threads);
  transaction.commit();
  return record;
}

Record::~Record() {
  if (database_ == nullptr) return;
  try {
    write_last_duration();
    // A finished run is one plain file that can be copied and read from read-only places. Where a
    // reader keeps it open the journal stays, and nothing is lost.
    database_->run("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE");
  } catch (const InputError&) {
  }
}

void Record::start_session(int threads) {
  Statement insert(*database_, "INSERT INTO sessions VALUES (?, ?, ?)");
  Statement count(*database_, "SELECT coalesce(max(session), 0) + 1 FROM sessions");
  count.step();
  const std::int64_t session = count.integer(0);
  for (const auto& [key, value] : session_facts(threads)) {
    insert.bind(session).bind(key).bind(value).run();
  }
}

Experiment Record::experiment() {
  Statement select(*database_, "SELECT value FROM run WHERE key = 'configuration'");
  if (!select.step()) {
    throw InputError(fmt::format("{}: holds no configuration", database_->file().string()));
  }
  return parse_experiment(select.text(0), database_->file().string() + " (configuration)");
}

void Record::change_generations(int generations) {
  Experiment changed = experiment();
  changed.generations = generations;
  Statement update(*database_, "UPDATE run SET value = ? WHERE key = 'configuration'");
  update.bind(to_toml(changed)).run();
}

int Record::generations_done() {
  Statement count(*database_, "SELECT count(*) FROM generations");
  count.step();
  return static_cast<int>(count.integer(0));
}

BestEver Record::restore(Search& search) {
  const std::string source = database_->file().string();
  for (const Table& table : search.tables()) database_->run(creation_of(table));
  const int done = generations_done();
  Statement select(*database_, "SELECT state FROM checkpoint");
  if (!select.step()) {
    if (done > 0) throw InputError(source + ": checkpoint is missing");
    return {};
  }
  const Checkpoint checkpoint = decode(select.blob(0), source);
  if (checkpoint.generation != done) {
    throw InputError(fmt::format("{}: checkpoint of generation {}: expected {}", source,
                                 checkpoint.generation, done));
  }
  try {
    search.load(checkpoint.search,
                [&](const Table& table) { return read_rows(*database_, table); });
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: checkpoint: state of the search: {}", source, error.what()));
  }
  if (search.generation() != done) {
    throw InputError(
        fmt::format("{}: checkpoint: state of the search in generation {}: expected "
                    "{}",
                    source, search.generation(), done));
  }
  return checkpoint.best;
}

void Record::write(const GenerationResult& result, const PhaseSeconds& seconds,
                   const Search& search, const BestEver& best) {
  Stopwatch watch;
  Transaction transaction(*database_);
  write_last_duration();
  write_individuals(result);
  write_summary(result);
  write_search(result, search);
  Statement timing(*database_, "INSERT INTO timings VALUES (?, ?, ?)");
  const auto values = seconds.values();
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {  // the last phase is this one
    timing.bind(result.generation).bind(PhaseSeconds::names[i]).bind(values[i]).run();
  }
  Statement work(*database_, "INSERT INTO work VALUES (?, ?, ?, ?, ?)");
  work.bind(result.generation).bind(result.work.individuals).bind(result.work.developed);
  work.bind(result.work.bodies).bind(result.work.simulated).run();
  Statement checkpoint(*database_, "INSERT OR REPLACE INTO checkpoint VALUES (1, ?, ?)");
  checkpoint.bind(search.generation());
  checkpoint.bind_blob(encode({search.generation(), search.save(), best})).run();
  transaction.commit();
  last_generation_ = result.generation;
  last_duration_ = watch.lap();
}

void Record::write_last_duration() {
  if (last_generation_ < 0) return;
  Statement timing(*database_, "INSERT INTO timings VALUES (?, ?, ?)");
  timing.bind(last_generation_).bind(PhaseSeconds::names.back()).bind(last_duration_).run();
  last_generation_ = -1;
}

void Record::write_individuals(const GenerationResult& result) {
  Statement individual(*database_,
                       "INSERT INTO individuals VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  Statement row(*database_, outcome_insertion());
  Statement described(*database_, descriptor_insertion());
  for (std::size_t i = 0; i < result.individuals.size(); ++i) {
    const Lineage& who = result.asked.lineage[i];
    const Genome& genome = result.asked.genomes[i];
    const Evaluated& e = result.individuals[i];
    individual.bind(result.generation).bind(static_cast<int>(i)).bind(who.id).bind(who.parent_a);
    individual.bind(who.parent_b).bind(result.scores[i]).bind(result.eq6[i]);
    individual.bind(e.penalty).bind(e.created).bind(e.died);
    individual.bind(static_cast<int>(genome.nodes.size()));
    individual.bind(static_cast<int>(genome.links.size())).run();
    for (std::size_t t = 0; t < e.trials.size(); ++t) {
      if (e.evaluated[t] == 0) continue;
      const StageCounts& stage = e.stages[t];
      row.bind(result.generation).bind(static_cast<int>(i)).bind(static_cast<int>(t));
      row.bind(stage.cells).bind(stage.created).bind(stage.died);
      bind_outcome(row, e.trials[t]);
      row.run();
      if (std::isnan(e.descriptors[t].cells)) continue;
      described.bind(result.generation).bind(static_cast<int>(i)).bind(static_cast<int>(t));
      bind_descriptors(described, e.descriptors[t]);
      described.run();
    }
  }
}

void Record::write_summary(const GenerationResult& result) {
  const std::size_t best = result.champion;
  const std::int64_t champion = result.asked.lineage[best].id;
  Statement generation(*database_, "INSERT INTO generations VALUES (?, ?, ?, ?, ?, ?)");
  generation.bind(result.generation).bind(champion).bind(result.eq6[best]);
  generation.bind(mean(result.eq6))
      .bind(*std::max_element(result.scores.begin(), result.scores.end()));
  generation.bind(mean(result.scores)).run();

  Statement trial_row(*database_, "INSERT INTO generation_trials VALUES (?, ?, ?, ?, ?, ?)");
  Statement status_row(*database_, "INSERT INTO status_counts VALUES (?, ?, ?, ?)");
  for (std::size_t t = 0; t < result.individuals[best].trials.size(); ++t) {
    std::vector<double> distances;
    for (const Evaluated& one : result.individuals) {
      if (one.evaluated[t] != 0) distances.push_back(one.trials[t].distance);
    }
    const int trial = static_cast<int>(t);
    trial_row.bind(result.generation).bind(trial).bind(static_cast<int>(distances.size()));
    trial_row.bind(result.individuals[best].trials[t].distance);
    trial_row.bind(distances.empty() ? 0.0 : *std::max_element(distances.begin(), distances.end()));
    trial_row.bind(distances.empty() ? 0.0 : mean(distances)).run();
    const auto counts = count_statuses(result, trial);
    for (const core::Status status : core::all_statuses) {
      const int count = counts[static_cast<std::size_t>(status)];
      if (count == 0) continue;
      status_row.bind(result.generation).bind(trial).bind(core::name(status)).bind(count).run();
    }
  }
  Statement champion_row(*database_, "INSERT INTO champions VALUES (?, ?, ?, ?, ?, ?)");
  champion_row.bind(result.generation).bind(static_cast<int>(best)).bind(champion);
  champion_row.bind(result.eq6[best]).bind(result.scores[best]);
  champion_row.bind(genome_text(result.asked.genomes[best])).run();
}

void Record::write_search(const GenerationResult& result, const Search& search) {
  const std::vector<Table> tables = search.tables();
  for (std::size_t t = 0; t < tables.size(); ++t) {
    write_rows(*database_, tables[t], result.search_rows[t]);
  }
}

}  // namespace metamorph::evolve
