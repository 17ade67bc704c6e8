#include "evolve/run/search_tables.h"

#include <fmt/format.h>

#include <cassert>

namespace metamorph::evolve {
namespace {

const char* name_of(Table::Type type) {
  switch (type) {
    case Table::Type::integer:
      return "INTEGER";
    case Table::Type::real:
      return "REAL";
    case Table::Type::text:
      break;
  }
  return "TEXT";
}

/// The names of the first columns, "a, b".
std::string columns_of(const Table& table, std::size_t count) {
  std::string text;
  for (std::size_t c = 0; c < count; ++c) {
    text += fmt::format("{}\"{}\"", c == 0 ? "" : ", ", table.columns[c].name);
  }
  return text;
}

std::string keys_of(const Table& table) {
  return columns_of(table, static_cast<std::size_t>(table.keys));
}

}  // namespace

std::string creation_of(const Table& table) {
  std::string sql = fmt::format("CREATE TABLE IF NOT EXISTS \"{}\" (", table.name);
  for (const Table::Column& column : table.columns) {
    sql += fmt::format("\"{}\" {} NOT NULL, ", column.name, name_of(column.type));
  }
  return sql + fmt::format("PRIMARY KEY ({})) WITHOUT ROWID", keys_of(table));
}

void write_rows(Database& database, const Table& table, const std::vector<Row>& rows,
                TableDigest& digest) {
  std::string places;
  for (std::size_t c = 0; c < table.columns.size(); ++c) places += c == 0 ? "?" : ", ?";
  Statement insert(database, fmt::format("INSERT INTO \"{}\" VALUES ({})", table.name, places),
                   &digest);
  for (const Row& row : rows) {
    assert(row.size() == table.columns.size());
    for (const Cell& cell : row) {
      std::visit([&](const auto& value) { insert.bind(value); }, cell);
    }
    insert.run();
  }
}

std::vector<Row> read_rows(Database& database, const Table& table) {
  Statement select(
      database, fmt::format("SELECT {} FROM \"{}\" ORDER BY {}",
                            columns_of(table, table.columns.size()), table.name, keys_of(table)));
  std::vector<Row> rows;
  while (select.step()) {
    Row& row = rows.emplace_back();
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const int column = static_cast<int>(c);
      switch (table.columns[c].type) {
        case Table::Type::integer:
          row.emplace_back(select.integer(column));
          break;
        case Table::Type::real:
          row.emplace_back(select.real(column));
          break;
        case Table::Type::text:
          row.emplace_back(select.text(column));
          break;
      }
    }
  }
  return rows;
}

}  // namespace metamorph::evolve
