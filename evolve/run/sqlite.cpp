#include "evolve/run/sqlite.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "evolve/files/input_error.h"
#include "evolve/run/table_digest.h"

namespace metamorph::evolve {

Database::Database(const std::filesystem::path& file, Mode mode) : file_(file) {
  // A missing file would be created by the write mode and look like an empty run.
  std::error_code error;
  if (mode != Mode::create && !std::filesystem::is_regular_file(file, error)) {
    const bool exists = std::filesystem::exists(file, error);
    throw InputError(fmt::format("{}: {}: expected the record of a run", file.string(),
                                 exists  ? "not a file"
                                 : error ? error.message()
                                         : "no such file"));
  }
  const int writing =
      mode == Mode::create ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READWRITE;
  try {
    if (mode != Mode::read) {
      open(file, writing);
    } else {
      // What a killed writer left in a journal is played back by the first statement that reads:
      // in place, or where the directory cannot be written, in a copy.
      open(file, SQLITE_OPEN_READONLY);
      if (needs_to_write()) {
        open(file, writing);
        if (needs_to_write()) open(copy_aside(), writing);
      }
      run("PRAGMA query_only = ON");
    }
    run("PRAGMA foreign_keys = ON; PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON");
  } catch (...) {
    close();
    throw;
  }
}

Database::~Database() { close(); }

void Database::open(const std::filesystem::path& file, int flags) {
  sqlite3_close(std::exchange(database_, nullptr));
  check(sqlite3_open_v2(file.c_str(), &database_, flags, nullptr));
  sqlite3_busy_timeout(database_, 60000);
  sqlite3_limit(database_, SQLITE_LIMIT_LENGTH, 1 << 29);  // a damaged length asks for no more
}

void Database::close() {
  sqlite3_close(std::exchange(database_, nullptr));
  std::error_code error;
  if (!aside_.empty()) std::filesystem::remove_all(aside_, error);
}

bool Database::needs_to_write() {
  const int code =
      sqlite3_exec(database_, "SELECT 1 FROM sqlite_master", nullptr, nullptr, nullptr);
  return (code & 0xff) == SQLITE_READONLY || (code & 0xff) == SQLITE_CANTOPEN;
}

std::filesystem::path Database::copy_aside() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "metamorph-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr) {
    throw InputError(
        fmt::format("{}: its writer was killed, and neither its directory nor {} can be "
                    "written: expected one of them for what has to be undone",
                    file_.string(), name));
  }
  aside_ = name;
  for (const char* part : {"", "-wal", "-journal"}) {
    const std::string from = file_.string() + part;
    if (!std::filesystem::exists(from, error)) continue;
    std::filesystem::copy_file(from, aside_ / (file_.filename().string() + part), error);
    if (error) throw InputError(fmt::format("{}: cannot be copied: {}", from, error.message()));
  }
  for (const auto& copied : std::filesystem::directory_iterator(aside_)) {
    std::filesystem::permissions(copied, std::filesystem::perms::owner_write,
                                 std::filesystem::perm_options::add, error);
  }
  return aside_ / file_.filename();
}

void Database::check(int code) {
  if (code == SQLITE_OK || code == SQLITE_ROW || code == SQLITE_DONE) return;
  std::string reason = database_ == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(database_);
  switch (code & 0xff) {
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      reason += ": not the record of a run, or damaged";
      break;
    case SQLITE_FULL:
      reason += ": make room and go on with --resume; all generations before this one are safe";
      break;
    case SQLITE_IOERR:
      reason +=
          ": is there room, and may a file grow this large? All generations before this one "
          "are safe: go on with --resume";
      break;
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
      reason += ": check that the directory exists and can be written";
      break;
    default:
      break;
  }
  throw InputError(fmt::format("{}: {}", file_.string(), reason));
}

void Database::run(const std::string& sql) {
  check(sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr));
}

void Database::leave_journal() {
  constexpr const char* sql = "PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE";
  sqlite3_busy_timeout(database_, 1000);
  const int code = sqlite3_exec(database_, sql, nullptr, nullptr, nullptr);
  if ((code & 0xff) != SQLITE_BUSY && (code & 0xff) != SQLITE_LOCKED) check(code);
}

bool Database::has_moved() const {
  int moved = 0;
  return sqlite3_file_control(database_, "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK &&
         moved != 0;
}

Statement::Statement(Database& database, std::string_view sql, TableDigest* digest)
    : database_(database),
      digest_(digest),
      hash_(digest == nullptr ? nullptr : std::make_unique<RowHash>()) {
  database.check(sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()),
                                    &statement_, nullptr));
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::bind(std::int64_t value) {
  if (hash_ != nullptr) hash_->add(value);
  database_.check(sqlite3_bind_int64(statement_, next_++, value));
  return *this;
}

Statement& Statement::bind(double value) {
  if (hash_ != nullptr) hash_->add(value);
  database_.check(sqlite3_bind_double(statement_, next_++, value));
  return *this;
}

Statement& Statement::bind(std::string_view value) {
  if (hash_ != nullptr) hash_->add(value);
  database_.check(sqlite3_bind_text(statement_, next_++, value.data(),
                                    static_cast<int>(value.size()), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind_blob(std::span<const std::uint8_t> value) {
  database_.check(
      sqlite3_bind_blob64(statement_, next_++, value.data(), value.size(), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind_null() {
  if (hash_ != nullptr) hash_->add_null();
  database_.check(sqlite3_bind_null(statement_, next_++));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  sqlite3_reset(statement_);
  next_ = 1;
  database_.check(code);
  return false;
}

void Statement::run() {
  while (step()) {
  }
  if (hash_ != nullptr) hash_->end_row(*digest_);
}

int Statement::columns() const { return sqlite3_column_count(statement_); }

std::string Statement::name(int column) const { return sqlite3_column_name(statement_, column); }

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

bool Statement::is_real(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_FLOAT;
}

bool Statement::is_integer(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_INTEGER;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double Statement::real(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN()
                         : sqlite3_column_double(statement_, column);
}

std::string Statement::text(int column) const {
  const auto* text = sqlite3_column_text(statement_, column);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

std::span<const std::uint8_t> Statement::blob(int column) const {
  const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_, column));
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

ReadTransaction::ReadTransaction(Database& database)
    : database_(database), open_(sqlite3_get_autocommit(database.handle()) != 0) {
  if (open_) database_.run("BEGIN");
}

ReadTransaction::~ReadTransaction() {
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  // An error may have rolled it back already; the failure itself is on its way as an exception.
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

}  // namespace metamorph::evolve
