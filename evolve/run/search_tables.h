#pragma once

#include <string>
#include <vector>

#include "evolve/run/sqlite.h"
#include "evolve/run/table_digest.h"
#include "metamorph/search.h"

namespace metamorph::evolve {

/// The statement that makes a table of a search, where there is none of that name.
std::string creation_of(const Table& table);

/// Adds rows to a table and counts them in the digest. Precondition: as many cells as columns, of
/// their types.
void write_rows(Database& database, const Table& table, const std::vector<Row>& rows,
                TableDigest& digest);

/// All rows of a table in order of its keys.
std::vector<Row> read_rows(Database& database, const Table& table);

}  // namespace metamorph::evolve
