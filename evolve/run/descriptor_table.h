#pragma once

#include <string>

#include "evolve/run/sqlite.h"
#include "metamorph/descriptors.h"

namespace metamorph::evolve {

/// Column definitions of what describes an individual in a trial, "cells REAL, elongation REAL,
/// ...", from the one list of it (metamorph/descriptors.h). What says nothing is NULL.
std::string descriptor_columns();

/// The statement that adds a row to that table: generation, position, trial, and what
/// bind_descriptors() binds.
std::string descriptor_insertion();

void bind_descriptors(Statement& statement, const TrialDescriptors& descriptors);

}  // namespace metamorph::evolve
