#include "evolve/run/run_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "evolve/experiment/experiment_file.h"
#include "evolve/files/csv_text.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/run/integrity.h"
#include "evolve/run/record_schema.h"
#include "evolve/run/sqlite.h"

namespace metamorph::evolve {
namespace {

std::filesystem::path record_of(const std::filesystem::path& run) {
  std::error_code error;
  return std::filesystem::is_directory(run, error) ? run / record_file : run;
}

}  // namespace

/// One state of the record for as long as something is read from it, after its frame was checked.
class RunReader::Reading {
 public:
  explicit Reading(const RunReader& run)
      : one_state_(*run.database_), generations_(run.integrity_->check_frame()) {}
  int generations() const { return generations_; }

 private:
  ReadTransaction one_state_;
  int generations_;
};

RunReader::RunReader(const std::filesystem::path& run)
    : file_(record_of(run)), database_(std::make_unique<Database>(file_, Database::Mode::read)) {
  require_format(*database_);
  integrity_ = std::make_unique<Integrity>(*database_);
}

RunReader::~RunReader() = default;

void RunReader::verify() const {
  const ReadTransaction one_state(*database_);
  integrity_->check_all();
}

Experiment RunReader::experiment() const {
  const Reading reading(*this);
  Statement select(*database_, "SELECT value FROM run WHERE key = 'configuration'");
  if (!select.step()) {
    throw InputError(fmt::format("{}: holds no configuration", file_.string()));
  }
  Experiment experiment = parse_experiment(select.text(0), file_.string() + " (configuration)");
  // Champions have an outcome for every row of the table.
  Statement trials(*database_, "SELECT count(*) FROM trials");
  trials.step();
  if (!std::cmp_equal(trials.integer(0), experiment.trials.size())) {
    throw InputError(fmt::format("{}: table trials: {} rows: expected {}, as in the configuration",
                                 file_.string(), trials.integer(0), experiment.trials.size()));
  }
  return experiment;
}

int RunReader::generations_done() const { return Reading(*this).generations(); }

Champion RunReader::champion(int generation) const {
  const Reading reading(*this);
  if (generation < 0 || generation >= reading.generations()) {
    throw InputError(fmt::format("{}: no such champion: expected a generation below {}",
                                 file_.string(), reading.generations()));
  }
  return read_champion(generation);
}

Champion RunReader::best() const {
  const Reading reading(*this);
  integrity_->check_table("champions");
  Statement best(*database_,
                 "SELECT generation FROM champions ORDER BY eq6 DESC, score DESC, generation");
  if (!best.step()) {
    throw InputError(
        fmt::format("{}: no champion yet: expected a generation at least", file_.string()));
  }
  return read_champion(static_cast<int>(best.integer(0)));
}

Champion RunReader::read_champion(int generation) const {
  for (const char* table : {"champions", "outcomes"}) {
    integrity_->check_generation(table, generation);
  }
  Statement select(*database_,
                   "SELECT generation, individual, eq6, score, genome, position FROM champions "
                   "WHERE generation = ?");
  select.bind(generation);
  if (!select.step()) {  // it was there a moment ago
    throw InputError(
        fmt::format("{}: damaged: table champions, generation {}", file_.string(), generation));
  }
  Champion champion;
  champion.generation = static_cast<int>(select.integer(0));
  champion.individual = select.integer(1);
  champion.eq6 = select.real(2);
  champion.score = select.real(3);
  champion.genome = parse_genome(
      select.text(4), fmt::format("{} (champion {})", file_.string(), champion.generation));
  Statement trials(*database_,
                   "SELECT coalesce(o.distance, 0), coalesce(o.status, '') FROM trials t LEFT JOIN "
                   "outcomes o ON o.trial = t.trial AND o.generation = ? AND o.position = ? "
                   "ORDER BY t.trial");
  trials.bind(champion.generation).bind(select.integer(5));
  while (trials.step()) {
    champion.distances.push_back(trials.real(0));
    champion.statuses.push_back(trials.text(1));
  }
  return champion;
}

std::map<std::string, std::int64_t> RunReader::status_counts() const {
  const Reading reading(*this);
  integrity_->check_table("status_counts");
  Statement select(*database_, "SELECT status, sum(count) FROM status_counts GROUP BY status");
  std::map<std::string, std::int64_t> counts;
  while (select.step()) counts[select.text(0)] = select.integer(1);
  return counts;
}

std::vector<std::pair<std::string, double>> RunReader::phase_seconds() const {
  const Reading reading(*this);
  integrity_->check_table("timings");
  Statement select(*database_,
                   "SELECT phase, sum(seconds) FROM timings GROUP BY phase ORDER BY 2 DESC");
  std::vector<std::pair<std::string, double>> phases;
  while (select.step()) phases.emplace_back(select.text(0), select.real(1));
  return phases;
}

std::vector<std::pair<std::string, std::string>> RunReader::last_session() const {
  const Reading reading(*this);
  integrity_->check_table("sessions");
  Statement select(*database_,
                   "SELECT key, value FROM sessions WHERE session = (SELECT max(session) FROM "
                   "sessions) ORDER BY key");
  std::vector<std::pair<std::string, std::string>> facts;
  while (select.step()) facts.emplace_back(select.text(0), select.text(1));
  return facts;
}

EvaluationWork RunReader::work() const {
  const Reading reading(*this);
  integrity_->check_table("work");
  Statement sum(*database_,
                "SELECT sum(individuals), sum(developed), sum(bodies), sum(simulated) FROM work");
  sum.step();
  return {sum.integer(0), sum.integer(1), sum.integer(2), sum.integer(3)};
}

SearchHealth RunReader::health() const {
  const Reading reading(*this);
  return search_health(*database_, *integrity_);
}

RecordedMap RunReader::elites() const {
  const Reading reading(*this);
  return read_elites(*database_, *integrity_, experiment());
}

std::vector<GenerationFitness> RunReader::fitness() const {
  const Reading reading(*this);
  integrity_->check_table("generations");
  return fitness_of(*database_);
}

std::map<std::int64_t, Ancestor> RunReader::ancestors(
    const std::vector<std::int64_t>& individuals) const {
  const Reading reading(*this);
  integrity_->check_table("individuals");
  return ancestors_of(*database_, individuals);
}

std::vector<std::string> RunReader::tables() const {
  const Reading reading(*this);
  Statement select(*database_,
                   "SELECT name FROM sqlite_master WHERE type IN ('table', 'view') AND name NOT IN "
                   "('checkpoint', 'digests', 'session_digests') ORDER BY name");
  std::vector<std::string> names;
  while (select.step()) names.push_back(select.text(0));
  return names;
}

double TableRow::number(int column) const { return row_.real(column); }
int TableRow::integer(int column) const { return static_cast<int>(row_.integer(column)); }
std::string TableRow::text(int column) const { return row_.text(column); }

void RunReader::read(const std::string& table, const std::string& columns,
                     const std::function<void(const TableRow&)>& visit) const {
  const Reading reading(*this);
  integrity_->check_table(table);
  Statement select(*database_, fmt::format("SELECT {} FROM \"{}\"", columns, table));
  const TableRow row(select);
  while (select.step()) visit(row);
}

void RunReader::write_csv(const std::string& table,
                          const std::function<void(std::string_view)>& write) const {
  const Reading reading(*this);
  const std::vector<std::string> known = tables();
  if (std::find(known.begin(), known.end(), table) == known.end()) {
    throw InputError(fmt::format("{}: table {}: expected one of {}", file_.string(), table,
                                 fmt::join(known, ", ")));
  }
  integrity_->check_table(table);
  Statement select(*database_, fmt::format("SELECT * FROM \"{}\"", table));
  std::string line;
  for (int c = 0; c < select.columns(); ++c) {
    line.append(c == 0 ? "" : ",").append(csv_field(select.name(c)));
  }
  write(line + '\n');
  while (select.step()) {
    line.clear();
    for (int c = 0; c < select.columns(); ++c) {
      if (c > 0) line += ',';
      if (select.is_real(c)) {
        line += fmt::format("{}", select.real(c));
      } else if (!select.is_null(c)) {
        line += csv_field(select.text(c));
      }
    }
    write(line + '\n');
  }
}

}  // namespace metamorph::evolve
