#pragma once

#include <string>

#include "evolve/run/sqlite.h"
#include "metamorph/outcome.h"

namespace metamorph::evolve {

/// Column definitions of an outcome, "status TEXT NOT NULL, distance REAL, ...", from the one list
/// of its fields (metamorph/outcome_fields.h). What says nothing of an outcome is NULL.
std::string outcome_columns();

/// The statement that adds a row to the table of outcomes: generation, position, trial, cells,
/// created and died of the embryo, and what bind_outcome() binds.
std::string outcome_insertion();

void bind_outcome(Statement& statement, const core::Outcome& outcome);

}  // namespace metamorph::evolve
