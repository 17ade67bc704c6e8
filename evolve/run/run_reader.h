#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "evolve/experiment/experiment.h"
#include "evolve/run/elite_table.h"
#include "evolve/run/lineage.h"
#include "evolve/run/search_health.h"
#include "metamorph/evaluator.h"
#include "metamorph/genome.h"

namespace metamorph::evolve {

class Database;
class Integrity;
class Statement;

/// The best individual by eq 6 of one generation, as recorded.
struct Champion {
  int generation = 0;
  std::int64_t individual = 0;
  double eq6 = 0;
  double score = 0;
  Genome genome;                      ///< exact: replays to the recorded bits
  std::vector<double> distances;      ///< [trials] d; 0 where not run
  std::vector<std::string> statuses;  ///< [trials] "" where not run
};

/// A row of a table while it is read; columns are counted as they were asked for.
class TableRow {
 public:
  explicit TableRow(const Statement& row) : row_(row) {}
  double number(int column) const;  ///< NaN: NULL
  int integer(int column) const;
  std::string text(int column) const;

 private:
  const Statement& row_;
};

/// Reads the record of a run, also while it is being written. What it gives is what was written:
/// all that it reads is compared with the record's digests (integrity.h). Throws InputError.
class RunReader {
 public:
  /// `run` is a run's directory or its run.db.
  explicit RunReader(const std::filesystem::path& run);
  ~RunReader();

  /// Compares the whole record with its digests, and looks through the pages of the file.
  void verify() const;

  Experiment experiment() const;
  int generations_done() const;
  Champion champion(int generation) const;
  Champion best() const;  ///< of all generations: by eq 6, then score, then the earliest
  std::map<std::string, std::int64_t> status_counts() const;              ///< of the whole run
  std::vector<std::pair<std::string, double>> phase_seconds() const;      ///< of the whole run
  std::vector<std::pair<std::string, std::string>> last_session() const;  ///< key, value
  /// Of all generations.
  EvaluationWork work() const;
  SearchHealth health() const;
  RecordedMap elites() const;  ///< of a run of map-elites
  std::vector<GenerationFitness> fitness() const;
  std::map<std::int64_t, Ancestor> ancestors(const std::vector<std::int64_t>& individuals) const;

  std::vector<std::string> tables() const;  ///< tables and views
  /// Visits all rows of a table or view, in no promised order. Precondition: it has these columns.
  void read(const std::string& table, const std::string& columns,
            const std::function<void(const TableRow&)>& visit) const;
  /// A table as CSV: a header line, then the rows in order of their key; numbers read back to the
  /// same bits, NULL is empty.
  void write_csv(const std::string& table,
                 const std::function<void(std::string_view)>& write) const;

  const std::filesystem::path& file() const { return file_; }

 private:
  class Reading;
  Champion read_champion(int generation) const;

  std::filesystem::path file_;
  std::unique_ptr<Database> database_;
  std::unique_ptr<Integrity> integrity_;
};

}  // namespace metamorph::evolve
