#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "evolve/run/sqlite.h"
#include "evolve/run/table_digest.h"

namespace metamorph::evolve {

/// [table] What it was given at once: in a generation, at the start of the run, in a session.
using Digests = std::map<std::string, TableDigest>;

/// The number under which the digests of the experiment and of the tables' definitions stand.
inline constexpr int before_generations = -1;

/// The table that digests are kept in. Those of `digests` are chained, so that none of them can be
/// missing or changed alone; those of `session_digests`, of tables that tell of wall-clock and
/// machine, are not: no two records have the same.
enum class Ledger { chained, session };
Ledger ledger_of(std::string_view table);

/// Writes digests under a number. Those that stand there already are replaced.
void write_digests(Database& database, Ledger ledger, std::int64_t number, const Digests& digests);

/// The chain after one more link: the digests of `number`.
std::uint64_t chained(std::uint64_t chain, std::int64_t number, const Digests& digests);

/// The digests of the experiment (tables run, trials) and of all tables' definitions, from what
/// stands in the database.
Digests frame_digests(Database& database);

/// The chain over all of `digests`, up to the last generation.
std::uint64_t chain_of(Database& database);

/// The tables whose rows are counted in every generation, those of its search among them.
std::vector<std::string> counted_tables(Database& database);

/// What stands in a table now.
struct RowDigests {
  bool is_numbered = false;  ///< its first column is the generation or session of writing
  std::map<std::int64_t, TableDigest> of;  ///< [number] else all under 0
};
RowDigests digests_of(Database& database, const std::string& table);

/// True if the record has been given its tables and its experiment's digests.
bool is_framed(Database& database);

/// Whether a record is what was written. All faults throw InputError with one line that names the
/// file, the table and where known the generation. Precondition of every call: the database shows
/// one state meanwhile (ReadTransaction, or nobody else writes).
class Integrity {
 public:
  explicit Integrity(Database& database) : database_(database) {}

  /// The experiment, the definitions of the tables, and the chain of digests up to the checkpoint;
  /// nothing is read again as long as no generation was added. Returns the generations done.
  int check_frame();
  /// All rows of a table; of a view: of the tables that it shows.
  void check_table(const std::string& table);
  /// The rows of one generation of a table that is numbered by it.
  void check_generation(const std::string& table, int generation);
  /// Everything: the pages of the file, the frame and all tables.
  void check_all();

 private:
  [[noreturn]] void refuse(const std::string& what) const;
  void check_definitions(const Digests& recorded_ones);
  void check_checkpoint(std::int64_t generations, std::uint64_t chain);

  Database& database_;
  int checked_generations_ = -1;  ///< that check_frame() has seen; -1: not called yet
};

}  // namespace metamorph::evolve
