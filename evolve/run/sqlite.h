#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace metamorph::evolve {

class Database;
class RowHash;
struct TableDigest;

/// A prepared statement. Values are bound in order with bind(); NaN is stored as NULL and read back
/// as NaN. Every failure of SQLite throws InputError with the file and the reason in one line.
class Statement {
 public:
  /// What is bound to a statement with a digest counts in it, a row for every run.
  Statement(Database& database, std::string_view sql, TableDigest* digest = nullptr);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::int64_t value);
  Statement& bind(int value) { return bind(static_cast<std::int64_t>(value)); }
  Statement& bind(double value);
  Statement& bind(std::string_view value);
  Statement& bind_blob(std::span<const std::uint8_t> value);
  Statement& bind_null();

  /// Fetches the next row; false at the end, and the statement can be bound and run again.
  bool step();
  /// Runs a statement that returns no rows.
  void run();

  int columns() const;
  std::string name(int column) const;
  bool is_null(int column) const;
  bool is_real(int column) const;
  bool is_integer(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  std::span<const std::uint8_t> blob(int column) const;  ///< valid until the next step

 private:
  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int next_ = 1;  ///< parameter the next bind() sets
  TableDigest* digest_;
  std::unique_ptr<RowHash> hash_;  ///< of what was bound since the last run; with a digest only
};

/// An open SQLite file. Where its writer was killed, what it left half done is undone, for which
/// Mode::read writes too; where it may not, it reads a copy.
class Database {
 public:
  enum class Mode { create, write, read };
  Database(const std::filesystem::path& file, Mode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void run(const std::string& sql);  ///< one or more statements without results
  /// Writes into the file all that stands in its journal, and does without one, so that the file by
  /// itself is the whole database. Where somebody else reads it the journal stays.
  void leave_journal();
  /// True if the file is no longer where it was opened: deleted, moved, or replaced.
  bool has_moved() const;
  void check(int code);  ///< throws InputError unless code is SQLITE_OK, ROW or DONE
  sqlite3* handle() { return database_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  void open(const std::filesystem::path& file, int flags);
  void close();
  bool needs_to_write();
  std::filesystem::path copy_aside();

  std::filesystem::path file_;
  std::filesystem::path aside_;  ///< a directory with a copy of the file; empty: there is none
  sqlite3* database_ = nullptr;
};

/// As long as it lives, the database shows one state, whatever others write. In another one it does
/// nothing.
class ReadTransaction {
 public:
  explicit ReadTransaction(Database& database);
  ~ReadTransaction();
  ReadTransaction(const ReadTransaction&) = delete;
  ReadTransaction& operator=(const ReadTransaction&) = delete;

 private:
  Database& database_;
  bool open_;
};

/// Begins a transaction; rolls it back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace metamorph::evolve
