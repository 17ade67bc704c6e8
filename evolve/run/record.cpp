#include "evolve/run/record.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "evolve/evaluation/stopwatch.h"
#include "evolve/experiment/experiment_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/output_file.h"
#include "evolve/run/descriptor_table.h"
#include "evolve/run/outcome_table.h"
#include "evolve/run/record_schema.h"
#include "evolve/run/search_tables.h"
#include "evolve/run/session.h"
#include "evolve/run/shared_disk.h"

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
  file_ = directory / lock_file;
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) {
    throw InputError(fmt::format("{}: cannot be written: {}", file_.string(),
                                 std::error_code(errno, std::generic_category()).message()));
  }
  // A lock of the open file that holds between machines too, where the file system has any.
  struct flock whole{};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(descriptor_, F_OFD_SETLK, &whole) != 0) {
    const int reason = errno;
    ::close(descriptor_);
    if (reason == EAGAIN || reason == EACCES) {
      throw InputError(
          fmt::format("{}: another metamorph evolve is writing this run", directory.string()));
    }
    throw InputError(fmt::format("{}: cannot be locked: {}: expected a disk that has locks",
                                 file_.string(),
                                 std::error_code(reason, std::generic_category()).message()));
  }
}

bool DirectoryLock::is_gone() const {
  struct stat held{}, there{};
  return fstat(descriptor_, &held) != 0 || stat(file_.c_str(), &there) != 0 ||
         held.st_dev != there.st_dev || held.st_ino != there.st_ino;
}

DirectoryLock::~DirectoryLock() { close(descriptor_); }

Record::Record(const std::filesystem::path& directory) : directory_(directory) {}

Record::Record(const std::filesystem::path& directory, const Experiment& experiment, int threads)
    : directory_(make_directory(directory)), lock_(std::make_unique<DirectoryLock>(directory)) {
  database_ = std::make_unique<Database>(directory / record_file, Database::Mode::create);
  // Before there is a journal beside it: the file by itself always holds the experiment.
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
  begin_journal();
}

std::unique_ptr<Record> Record::resume(const std::filesystem::path& directory, int threads,
                                       const std::function<void(Record&)>& accept) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(directory / record_file, error)) {
    throw InputError(fmt::format("{}: holds no {}: expected the directory of a run",
                                 directory.string(), record_file));
  }
  std::unique_ptr<Record> record(new Record(directory));
  record->lock_ = std::make_unique<DirectoryLock>(directory);
  record->database_ = std::make_unique<Database>(directory / record_file, Database::Mode::write);
  Database& database = *record->database_;
  require_format(database);
  Integrity(database).check_all();
  if (accept) accept(*record);
  remove_abandoned(directory);
  record->begin_journal();
  Transaction transaction(database);
  record->start_session(threads);
  transaction.commit();
  return record;
}

Record::~Record() {
  try {
    close();
  } catch (const InputError&) {
  }
}

void Record::begin_journal() {
  // Readers may look on while the run writes. A write-ahead log needs memory that all who open the
  // file share, which machines do not.
  database_->run(shared_disk_of(directory_) ? "PRAGMA journal_mode = DELETE"
                                            : "PRAGMA journal_mode = WAL");
}

void Record::close() {
  if (database_ == nullptr) return;
  try {
    finish();
  } catch (...) {
    database_.reset();
    throw;
  }
  database_.reset();
}

void Record::finish() {
  check_place();
  Transaction transaction(*database_);
  write_last_duration();
  transaction.commit();
  // A finished run is one plain file that can be copied and read from read-only places.
  database_->leave_journal();
  check_place();
}

void Record::check_place() {
  if (database_->has_moved()) {
    throw InputError(
        fmt::format("{}: was deleted, moved or replaced while the run was being written: what is "
                    "recorded is not where it should be",
                    database_->file().string()));
  }
  if (lock_->is_gone()) {
    throw InputError(
        fmt::format("{}: {} was deleted or replaced while the run was being written: another "
                    "program may write it too",
                    directory_.string(), lock_file));
  }
}

void Record::start_session(int threads) {
  TableDigest digest;
  Statement insert(*database_, "INSERT INTO sessions VALUES (?, ?, ?)", &digest);
  Statement count(*database_, "SELECT coalesce(max(session), 0) + 1 FROM sessions");
  count.step();
  const std::int64_t session = count.integer(0);
  auto facts = session_facts(threads);
  facts.emplace_back("disk", shared_disk_of(directory_).value_or("local"));
  for (const auto& [key, value] : facts) insert.bind(session).bind(key).bind(value).run();
  write_digests(*database_, Ledger::session, session, {{"sessions", digest}});
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
  Transaction transaction(*database_);
  Statement update(*database_, "UPDATE run SET value = ? WHERE key = 'configuration'");
  update.bind(to_toml(changed)).run();
  if (is_framed(*database_)) {
    write_digests(*database_, Ledger::chained, before_generations, frame_digests(*database_));
    chain_ = chain_of(*database_);
    Statement select(*database_, "SELECT state FROM checkpoint");
    if (select.step()) {
      Checkpoint checkpoint = decode(select.blob(0), database_->file().string());
      checkpoint.chain = chain_;
      write_checkpoint(checkpoint);
    }
  }
  transaction.commit();
}

void Record::write_checkpoint(const Checkpoint& checkpoint) {
  Statement replace(*database_, "INSERT OR REPLACE INTO checkpoint VALUES (1, ?, ?)");
  replace.bind(checkpoint.generation).bind_blob(encode(checkpoint)).run();
}

/// Makes the tables of the search, and the digests of what stands before all generations.
void Record::frame(const Search& search) {
  Transaction transaction(*database_);
  if (!is_framed(*database_)) {
    for (const Table& table : search.tables()) database_->run(creation_of(table));
    write_digests(*database_, Ledger::chained, before_generations, frame_digests(*database_));
  }
  transaction.commit();
  chain_ = chain_of(*database_);
  tables_ = counted_tables(*database_);
  for (const Table& table : search.tables()) {
    if (std::find(tables_.begin(), tables_.end(), table.name) == tables_.end()) {
      throw InputError(fmt::format("{}: has no table {}: expected the record of such a search",
                                   database_->file().string(), table.name));
    }
  }
}

int Record::generations_done() {
  Statement count(*database_, "SELECT count(*) FROM generations");
  count.step();
  return static_cast<int>(count.integer(0));
}

BestEver Record::restore(Search& search) {
  const std::string source = database_->file().string();
  frame(search);
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
  check_place();
  written_.clear();
  for (const std::string& table : tables_) written_[table];  // of no rows, too
  Transaction transaction(*database_);
  write_last_duration();
  write_individuals(result);
  write_summary(result);
  write_search(result, search);
  const TableDigest timings = write_clock(result, seconds);
  write_digests(*database_, Ledger::chained, result.generation, written_);
  const std::uint64_t chain = chained(chain_, result.generation, written_);
  write_checkpoint({search.generation(), search.save(), best, chain});
  transaction.commit();
  // Only now: what fails before is rolled back, and the record may still be closed.
  chain_ = chain;
  last_timings_ = timings;
  last_generation_ = result.generation;
  last_duration_ = watch.lap();
}

Statement Record::insertion(const std::string& table, const std::string& sql) {
  return Statement(*database_, sql, &written_[table]);
}

/// What no other run of the experiment has alike. Returns the digest of the timings, which wait for
/// the last one.
TableDigest Record::write_clock(const GenerationResult& result, const PhaseSeconds& seconds) {
  TableDigest timings;
  Statement timing(*database_, "INSERT INTO timings VALUES (?, ?, ?)", &timings);
  const auto values = seconds.values();
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {  // the last phase is writing this
    timing.bind(result.generation).bind(PhaseSeconds::names[i]).bind(values[i]).run();
  }
  TableDigest digest;
  Statement work(*database_, "INSERT INTO work VALUES (?, ?, ?, ?, ?)", &digest);
  work.bind(result.generation).bind(result.work.individuals).bind(result.work.developed);
  work.bind(result.work.bodies).bind(result.work.simulated).run();
  write_digests(*database_, Ledger::session, result.generation,
                {{"timings", timings}, {"work", digest}});
  return timings;
}

void Record::write_last_duration() {
  if (last_generation_ < 0) return;
  TableDigest timings = last_timings_;
  Statement timing(*database_, "INSERT INTO timings VALUES (?, ?, ?)", &timings);
  timing.bind(last_generation_).bind(PhaseSeconds::names.back()).bind(last_duration_).run();
  write_digests(*database_, Ledger::session, last_generation_, {{"timings", timings}});
}

void Record::write_individuals(const GenerationResult& result) {
  Statement individual = insertion(
      "individuals", "INSERT INTO individuals VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  Statement row = insertion("outcomes", outcome_insertion());
  Statement described = insertion("descriptors", descriptor_insertion());
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
  Statement generation =
      insertion("generations", "INSERT INTO generations VALUES (?, ?, ?, ?, ?, ?)");
  generation.bind(result.generation).bind(champion).bind(result.eq6[best]);
  generation.bind(mean(result.eq6))
      .bind(*std::max_element(result.scores.begin(), result.scores.end()));
  generation.bind(mean(result.scores)).run();

  Statement trial_row =
      insertion("generation_trials", "INSERT INTO generation_trials VALUES (?, ?, ?, ?, ?, ?)");
  Statement status_row =
      insertion("status_counts", "INSERT INTO status_counts VALUES (?, ?, ?, ?)");
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
  Statement champion_row =
      insertion("champions", "INSERT INTO champions VALUES (?, ?, ?, ?, ?, ?)");
  champion_row.bind(result.generation).bind(static_cast<int>(best)).bind(champion);
  champion_row.bind(result.eq6[best]).bind(result.scores[best]);
  champion_row.bind(genome_text(result.asked.genomes[best])).run();
}

void Record::write_search(const GenerationResult& result, const Search& search) {
  const std::vector<Table> tables = search.tables();
  for (std::size_t t = 0; t < tables.size(); ++t) {
    write_rows(*database_, tables[t], result.search_rows[t], written_[tables[t].name]);
  }
}

}  // namespace metamorph::evolve
