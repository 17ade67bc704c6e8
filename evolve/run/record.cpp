#include "evolve/run/record.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "evolve/experiment/experiment_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/run/record_schema.h"
#include "evolve/run/session.h"
#include "evolve/run/stopwatch.h"

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
  database_->run(record_schema);
  database_->run(work_schema);
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
  database.run(work_schema);
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

Checkpoint Record::checkpoint() {
  const std::string source = database_->file().string();
  const Experiment recorded = experiment();
  Statement last(*database_, "SELECT count(*) FROM generations");
  last.step();
  const std::int64_t done = last.integer(0);

  Statement select(*database_, "SELECT state FROM checkpoint");
  if (!select.step()) {
    if (done > 0) throw InputError(source + ": checkpoint is missing");
    return {first_generation(recorded.neat, recorded.seed, shape_of(recorded.development)),
            initial_state(recorded.search),
            {}};
  }
  Checkpoint checkpoint = decode(select.blob(0), source);
  const PopulationState& population = checkpoint.population;
  if (population.generation != done || population.seed != recorded.seed ||
      population.genomes.size() != static_cast<std::size_t>(recorded.neat.population)) {
    throw InputError(
        fmt::format("{}: checkpoint of generation {}, seed {}, population {}: expected {}, {}, {}",
                    source, population.generation, population.seed, population.genomes.size(), done,
                    recorded.seed, recorded.neat.population));
  }
  Statement archive(
      *database_, "SELECT individual, generation, novelty, behaviour FROM archive ORDER BY number");
  while (archive.step()) {
    checkpoint.search.archive.push_back(
        {archive.integer(0), static_cast<int>(archive.integer(1)), archive.real(2),
         nlohmann::json::parse(archive.text(3)).get<std::vector<double>>()});
  }
  return checkpoint;
}

void Record::write(const PopulationState& population, const GenerationResult& result,
                   const PhaseSeconds& seconds, const Checkpoint& next) {
  Stopwatch watch;
  Transaction transaction(*database_);
  write_last_duration();
  write_individuals(population, result);
  write_summary(population, result, next);
  write_species(population, result);
  write_archive(result, next.search);
  Statement timing(*database_, "INSERT INTO timings VALUES (?, ?, ?)");
  const auto values = seconds.values();
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {  // the last phase is this one
    timing.bind(result.generation).bind(PhaseSeconds::names[i]).bind(values[i]).run();
  }
  Statement work(*database_, "INSERT INTO work VALUES (?, ?, ?, ?, ?)");
  work.bind(result.generation).bind(result.work.individuals).bind(result.work.developed);
  work.bind(result.work.bodies).bind(result.work.simulated).run();
  Statement checkpoint(*database_, "INSERT OR REPLACE INTO checkpoint VALUES (1, ?, ?)");
  checkpoint.bind(next.population.generation).bind_blob(encode(next)).run();
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

void Record::write_individuals(const PopulationState& population, const GenerationResult& result) {
  Statement individual(*database_,
                       "INSERT INTO individuals VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  Statement row(*database_,
                "INSERT INTO outcomes VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
                "?, ?, ?, ?, ?)");
  for (std::size_t i = 0; i < result.individuals.size(); ++i) {
    const Individual& who = population.individuals[i];
    const Genome& genome = population.genomes[i];
    const Evaluated& evaluated = result.individuals[i];
    const Evaluation& e = evaluated.evaluation;
    individual.bind(result.generation).bind(static_cast<int>(i)).bind(who.id).bind(who.parent_a);
    individual.bind(who.parent_b).bind(who.species).bind(result.scores[i]).bind(result.eq6[i]);
    individual.bind(e.penalty).bind(e.created).bind(e.died);
    individual.bind(static_cast<int>(genome.nodes.size()));
    individual.bind(static_cast<int>(genome.links.size())).run();
    for (std::size_t t = 0; t < e.trials.size(); ++t) {
      if (e.evaluated[t] == 0) continue;
      const core::Outcome& o = e.trials[t];
      const StageCounts& stage = evaluated.stages[t];
      row.bind(result.generation).bind(static_cast<int>(i)).bind(static_cast<int>(t));
      row.bind(core::name(o.status)).bind(o.distance);
      row.bind(o.mean_position[0]).bind(o.mean_position[1]);
      row.bind(stage.cells).bind(stage.created).bind(stage.died);
      row.bind(o.cells).bind(o.springs).bind(o.triangles).bind(o.steps);
      row.bind(o.settle_time).bind(o.min_area_ratio).bind(o.max_speed);
      row.bind(o.longest_spring).bind(o.long_spring_share);
      if (core::is_failure(o.status)) {
        row.bind(o.failed_step).bind(o.failed_index).bind(o.failed_value);
      } else {
        row.bind_null().bind_null().bind_null();
      }
      row.run();
    }
  }
}

void Record::write_summary(const PopulationState& population, const GenerationResult& result,
                           const Checkpoint& next) {
  const std::size_t best = result.champion;
  const Individual& champion = population.individuals[best];
  Statement generation(*database_,
                       "INSERT INTO generations VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  generation.bind(result.generation).bind(champion.id).bind(result.eq6[best]);
  generation.bind(mean(result.eq6))
      .bind(*std::max_element(result.scores.begin(), result.scores.end()));
  generation.bind(mean(result.scores)).bind(static_cast<int>(population.species.size()));
  generation.bind(population.compatibility_threshold);
  const std::size_t archive_size = next.search.archive.size();
  generation.bind(static_cast<std::int64_t>(archive_size - result.archive_before));
  generation.bind(static_cast<std::int64_t>(archive_size)).bind(next.search.archive_threshold);
  generation.run();

  Statement trial_row(*database_, "INSERT INTO generation_trials VALUES (?, ?, ?, ?, ?, ?)");
  Statement status_row(*database_, "INSERT INTO status_counts VALUES (?, ?, ?, ?)");
  for (std::size_t t = 0; t < result.individuals[best].evaluation.trials.size(); ++t) {
    std::vector<double> distances;
    for (const Evaluated& one : result.individuals) {
      if (one.evaluation.evaluated[t] != 0) distances.push_back(one.evaluation.trials[t].distance);
    }
    const int trial = static_cast<int>(t);
    trial_row.bind(result.generation).bind(trial).bind(static_cast<int>(distances.size()));
    trial_row.bind(result.individuals[best].evaluation.trials[t].distance);
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
  champion_row.bind(result.generation).bind(static_cast<int>(best)).bind(champion.id);
  champion_row.bind(result.eq6[best]).bind(result.scores[best]);
  champion_row.bind(genome_text(population.genomes[best])).run();
}

void Record::write_species(const PopulationState& population, const GenerationResult& result) {
  Statement row(*database_, "INSERT INTO species VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  for (const Species& species : population.species) {
    std::vector<double> scores;
    for (std::size_t i = 0; i < result.scores.size(); ++i) {
      if (population.individuals[i].species == species.id) scores.push_back(result.scores[i]);
    }
    row.bind(result.generation).bind(species.id).bind(species.age).bind(species.size);
    row.bind(species.best_ever).bind(species.stagnant);
    row.bind(scores.empty() ? 0.0 : *std::max_element(scores.begin(), scores.end()));
    row.bind(scores.empty() ? 0.0 : mean(scores)).run();
  }
}

void Record::write_archive(const GenerationResult& result, const SearchState& search) {
  Statement row(*database_, "INSERT INTO archive VALUES (?, ?, ?, ?, ?)");
  for (std::size_t n = result.archive_before; n < search.archive.size(); ++n) {
    const ArchiveEntry& entry = search.archive[n];
    row.bind(static_cast<std::int64_t>(n)).bind(entry.individual).bind(entry.generation);
    row.bind(entry.novelty).bind(nlohmann::json(entry.behaviour).dump()).run();
  }
}

}  // namespace metamorph::evolve
