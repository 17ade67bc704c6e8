// Changes a cell or a row of a record, so that it stays a database, and its digests with it: what
// is wrong in a record comes past the page format and the digests only so.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "evolve/files/input_error.h"
#include "evolve/run/checkpoint.h"
#include "evolve/run/integrity.h"
#include "tests/evolve/files.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

using namespace metamorph;
using evolve::Database;
using evolve::Statement;

namespace {

std::string one_of(Database& database, const std::string& sql, std::minstd_rand& random) {
  Statement select(database, sql);
  std::vector<std::string> all;
  while (select.step()) all.push_back(select.text(0));
  return all.empty() ? "" : all[random() % all.size()];
}

std::string changed(std::string text, std::minstd_rand& random) {
  const std::size_t size = text.size();
  text.resize(size + 1 + random() % 16);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size()));
  return text;
}

/// The rows that have a value which one row has in one column get another, or go.
void change_cell(Database& database, std::minstd_rand& random) {
  const std::string table =
      one_of(database, "SELECT name FROM sqlite_master WHERE type = 'table'", random);
  const std::string column =
      one_of(database, fmt::format("SELECT name FROM pragma_table_info('{}')", table), random);
  const std::string old =
      one_of(database, fmt::format("SELECT \"{}\" FROM \"{}\"", column, table), random);
  const std::string where = fmt::format("WHERE CAST(\"{}\" AS TEXT) IS ?", column);
  if (random() % 8 == 0) {
    Statement(database, fmt::format("DELETE FROM \"{}\" {}", table, where)).bind(old).run();
    return;
  }
  Statement update(database,
                   fmt::format("UPDATE OR REPLACE \"{}\" SET \"{}\" = ? {}", table, column, where));
  switch (random() % 5) {
    case 0:
      update.bind(static_cast<std::int64_t>(random() % 8) - 2);
      break;
    case 1:
      update.bind(static_cast<std::int64_t>(random() * random()));
      break;
    case 2:
      update.bind(static_cast<double>(random()) / 1e6 - 1e3);
      break;
    case 3:
      update.bind_null();
      break;
    default:
      update.bind(changed(old, random));
  }
  update.bind(old).run();
}

void renew_digests(Database& database) {
  std::vector<std::string> tables = evolve::counted_tables(database);
  tables.insert(tables.end(), {"sessions", "timings", "work"});
  for (const std::string& table : tables) {
    for (const auto& [number, digest] : evolve::digests_of(database, table).of) {
      evolve::write_digests(database, evolve::ledger_of(table), number, {{table, digest}});
    }
  }
  evolve::write_digests(database, evolve::Ledger::chained, evolve::before_generations,
                        evolve::frame_digests(database));
  Statement select(database, "SELECT state FROM checkpoint");
  if (!select.step()) return;
  evolve::Checkpoint checkpoint = evolve::decode(select.blob(0), "record");
  checkpoint.chain = evolve::chain_of(database);
  Statement(database, "UPDATE checkpoint SET state = ?")
      .bind_blob(evolve::encode(checkpoint))
      .run();
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  static const tests::TemporaryDirectory directory;
  std::minstd_rand random(seed);
  if (random() % 3 != 0) {
    const std::filesystem::path file = directory.path() / "mutated.db";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
      {
        Database database(file, Database::Mode::write);
        database.run("PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY");
        change_cell(database, random);
        if (random() % 4 != 0) renew_digests(database);
      }
      std::ifstream stream(file, std::ios::binary);
      const std::string bytes(std::istreambuf_iterator<char>(stream), {});
      if (!bytes.empty() && bytes.size() <= max_size) {
        std::copy(bytes.begin(), bytes.end(), data);
        return bytes.size();
      }
    } catch (const evolve::InputError&) {  // no database: by its bytes
    }
  }
  return LLVMFuzzerMutate(data, size, max_size);
}
