#include "evolve/run/integrity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "evolve/files/input_error.h"
#include "evolve/run/checkpoint.h"
#include "evolve/run/record_schema.h"

namespace metamorph::evolve {
namespace {

constexpr std::array<std::string_view, 3> of_sessions = {"sessions", "timings", "work"};
constexpr std::array<std::string_view, 2> of_frame = {"run", "trials"};
constexpr std::array<std::string_view, 3> of_the_record = {"checkpoint", "digests",
                                                           "session_digests"};
// A row of theirs is written in the generation (or session) that its first column names. A search
// is free to tell of another generation than the one it is in.
constexpr std::array<std::string_view, 10> numbered = {
    "sessions",      "timings",     "work",     "generations", "generation_trials",
    "status_counts", "individuals", "outcomes", "descriptors", "champions"};
constexpr std::array<std::string_view, 2> shown_by_views = {"champions", "outcomes"};

template <class List>
bool contains(const List& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

const char* name_of(Ledger ledger) {
  return ledger == Ledger::session ? "session_digests" : "digests";
}

void hash_row(Statement& row, RowHash& hash, TableDigest& digest) {
  for (int c = 0; c < row.columns(); ++c) {
    if (row.is_null(c)) {
      hash.add_null();
    } else if (row.is_real(c)) {
      hash.add(row.real(c));
    } else if (row.is_integer(c)) {
      hash.add(row.integer(c));
    } else {
      const auto bytes = row.blob(c);
      hash.add(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
  }
  hash.end_row(digest);
}

TableDigest digest_of(Statement& rows) {
  RowHash hash;
  TableDigest digest;
  while (rows.step()) hash_row(rows, hash, digest);
  return digest;
}

std::string place_of(std::string_view table, std::int64_t number) {
  return fmt::format("table {}, {} {}", table, table == "sessions" ? "session" : "generation",
                     number);
}

/// Calls `link(number, digests)` for every number of the chain in order.
template <class Link>
void for_each_link(Database& database, Link link) {
  Statement select(database, "SELECT * FROM digests ORDER BY number");
  Digests digests;
  std::int64_t number = before_generations;
  while (select.step()) {
    if (!digests.empty() && select.integer(0) != number) {
      link(number, digests);
      digests.clear();
    }
    number = select.integer(0);
    digests[select.text(1)] = {select.integer(2), static_cast<std::uint64_t>(select.integer(3))};
  }
  if (!digests.empty()) link(number, digests);
}

}  // namespace

Ledger ledger_of(std::string_view table) {
  return contains(of_sessions, table) ? Ledger::session : Ledger::chained;
}

void write_digests(Database& database, Ledger ledger, std::int64_t number, const Digests& digests) {
  Statement insert(database,
                   fmt::format("INSERT OR REPLACE INTO {} VALUES (?, ?, ?, ?)", name_of(ledger)));
  for (const auto& [table, digest] : digests) {
    insert.bind(number).bind(table).bind(digest.rows);
    insert.bind(static_cast<std::int64_t>(digest.sum)).run();
  }
}

std::uint64_t chained(std::uint64_t chain, std::int64_t number, const Digests& digests) {
  std::string bytes;
  append_bytes(bytes, chain);
  append_bytes(bytes, static_cast<std::uint64_t>(number));
  for (const auto& [table, digest] : digests) {
    append_bytes(bytes, table.size());
    bytes += table;
    append_bytes(bytes, static_cast<std::uint64_t>(digest.rows));
    append_bytes(bytes, digest.sum);
  }
  return hash_of(bytes);
}

std::uint64_t chain_of(Database& database) {
  std::uint64_t chain = 0;
  for_each_link(database, [&](std::int64_t number, const Digests& digests) {
    chain = chained(chain, number, digests);
  });
  return chain;
}

Digests frame_digests(Database& database) {
  Digests digests;
  for (const std::string_view table : of_frame) {
    Statement rows(database, fmt::format("SELECT * FROM {}", table));
    digests[std::string(table)] = digest_of(rows);
  }
  Statement definitions(database,
                        "SELECT type, name, tbl_name, sql FROM sqlite_master WHERE name NOT LIKE "
                        "'sqlite%'");
  digests["sqlite_master"] = digest_of(definitions);
  return digests;
}

std::vector<std::string> counted_tables(Database& database) {
  std::vector<std::string> tables;
  Statement names(database, "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name");
  while (names.step()) {
    const std::string name = names.text(0);
    if (ledger_of(name) == Ledger::chained && !contains(of_frame, name) &&
        !contains(of_the_record, name)) {
      tables.push_back(name);
    }
  }
  return tables;
}

RowDigests digests_of(Database& database, const std::string& table) {
  Statement rows(database, fmt::format("SELECT * FROM \"{}\"", table));
  RowDigests found = {contains(numbered, table), {}};
  if (!found.is_numbered) found.of[0] = {};
  RowHash hash;
  while (rows.step()) hash_row(rows, hash, found.of[found.is_numbered ? rows.integer(0) : 0]);
  return found;
}

void require_format(Database& database) {
  const std::string file = database.file().string();
  Statement tables(database, "SELECT count(*) FROM sqlite_master WHERE name = 'run'");
  tables.step();
  if (tables.integer(0) == 0) {
    throw InputError(
        fmt::format("{}: holds no experiment: expected \"{}\", the record of a run, with the "
                    "{}-wal or {}-journal that stood beside it",
                    file, record_format, record_file, record_file));
  }
  Statement select(database, "SELECT value FROM run WHERE key = 'format'");
  const std::string format = select.step() ? select.text(0) : "";
  if (format != record_format) {
    throw InputError(
        fmt::format("{}: format = \"{}\": expected \"{}\", the record of a run of this version",
                    file, format, record_format));
  }
}

bool is_framed(Database& database) {
  Statement any(database, "SELECT 1 FROM digests LIMIT 1");
  return any.step();
}

void Integrity::refuse(const std::string& what) const {
  throw InputError(fmt::format("{}: damaged: {}", database_.file().string(), what));
}

int Integrity::check_frame() {
  if (!is_framed(database_)) {
    // Made, and killed before its first generation began.
    for (const char* table : {"generations", "checkpoint"}) {
      Statement any(database_, fmt::format("SELECT 1 FROM {} LIMIT 1", table));
      if (any.step()) refuse("table digests: is empty");
    }
    return 0;
  }
  Statement last(database_, "SELECT max(number) FROM digests");
  last.step();
  const std::int64_t generations = last.integer(0) + 1;
  if (generations == checked_generations_) return checked_generations_;

  std::int64_t next = before_generations;
  std::uint64_t chain = 0;
  for_each_link(database_, [&](std::int64_t number, const Digests& digests) {
    if (number != next) refuse(fmt::format("table digests, generation {}: is missing", next));
    if (number == before_generations) check_definitions(digests);
    chain = chained(chain, number, digests);
    ++next;
  });
  check_checkpoint(generations, chain);
  checked_generations_ = static_cast<int>(generations);
  return checked_generations_;
}

void Integrity::check_definitions(const Digests& recorded_ones) {
  for (const auto& [table, digest] : frame_digests(database_)) {
    const auto expected = recorded_ones.find(table);
    if (expected == recorded_ones.end() || expected->second != digest) {
      refuse(fmt::format("table {}: is not what was written", table));
    }
  }
}

void Integrity::check_checkpoint(std::int64_t generations, std::uint64_t chain) {
  Statement state(database_, "SELECT generation, state FROM checkpoint");
  if (!state.step()) {
    if (generations == 0) return;
    throw InputError(fmt::format("{}: checkpoint is missing", database_.file().string()));
  }
  const Checkpoint checkpoint = decode(state.blob(1), database_.file().string());
  for (const std::int64_t generation : {std::int64_t{checkpoint.generation}, state.integer(0)}) {
    if (generation != generations) {
      refuse(fmt::format("checkpoint of generation {}: expected {}", generation, generations));
    }
  }
  if (checkpoint.chain != chain) refuse("table digests: is not what was written");
}

void Integrity::check_table(const std::string& table) {
  const int generations = check_frame();
  if (contains(of_frame, table)) return;
  {
    Statement type(database_, "SELECT type FROM sqlite_master WHERE name = ?");
    type.bind(table);
    if (!type.step()) refuse(fmt::format("table {}: is missing", table));
    if (type.text(0) == "view") {
      for (const std::string_view shown : shown_by_views) check_table(std::string(shown));
      return;
    }
  }
  std::map<std::int64_t, TableDigest> expected;
  Statement digests(
      database_, fmt::format("SELECT number, rows, sum FROM {} WHERE \"table\" = ? AND number >= 0",
                             name_of(ledger_of(table))));
  digests.bind(table);
  std::int64_t numbers = 0;
  TableDigest all;
  while (digests.step()) {
    const TableDigest digest = {digests.integer(1), static_cast<std::uint64_t>(digests.integer(2))};
    if (digest.rows != 0) expected[digests.integer(0)] = digest;
    all += digest;
    ++numbers;
  }
  if (table != "sessions" && numbers != generations) {
    refuse(fmt::format("table {}: digests of {} generations: expected {}", table, numbers,
                       generations));
  }
  const auto [is_numbered, found] = digests_of(database_, table);
  if (!is_numbered) {
    if (found.at(0) != all) refuse(fmt::format("table {}: is not what was written", table));
    return;
  }
  const auto [wrong, other] =
      std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
  if (wrong == expected.end() && other == found.end()) return;
  const bool is_expected =
      other == found.end() || (wrong != expected.end() && wrong->first <= other->first);
  refuse(place_of(table, is_expected ? wrong->first : other->first) + ": is not what was written");
}

void Integrity::check_generation(const std::string& table, int generation) {
  check_frame();
  Statement digest(database_,
                   fmt::format("SELECT rows, sum FROM {} WHERE number = ? AND \"table\" = ?",
                               name_of(ledger_of(table))));
  digest.bind(generation).bind(table);
  if (!digest.step()) refuse(place_of(table, generation) + ": its digest is missing");
  const TableDigest expected = {digest.integer(0), static_cast<std::uint64_t>(digest.integer(1))};
  Statement rows(database_, fmt::format("SELECT * FROM \"{}\" WHERE generation = ?", table));
  rows.bind(generation);
  if (digest_of(rows) != expected) {
    refuse(place_of(table, generation) + ": is not what was written");
  }
}

void Integrity::check_all() {
  {
    Statement pages(database_, "PRAGMA quick_check(1)");
    if (!pages.step() || pages.text(0) != "ok") refuse(pages.text(0));
  }
  check_frame();
  for (const std::string& table : counted_tables(database_)) check_table(table);
  for (const std::string_view table : of_sessions) check_table(std::string(table));
}

}  // namespace metamorph::evolve
