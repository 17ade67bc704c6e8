#pragma once

#include <string>

namespace metamorph::evolve {

inline constexpr const char* record_format = "metamorph-run/4";
inline constexpr const char* record_file = "run.db";
inline constexpr const char* lock_file = "run.lock";

/// The tables of run.db. What depends on wall-clock, machine or interruptions stands in `sessions`,
/// `timings`, `work` and `session_digests` alone: every other table is the same, bit for bit, for
/// one configuration.
///
/// A search has tables of its own beside these (Search::tables()).
///
/// Units: distances and positions in cell diameters d; times in time units, steps as named.
inline constexpr const char* record_tables = R"sql(
-- format, experiment, seed, configuration (TOML, complete).
CREATE TABLE run (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
-- One set of rows per start or resume: version, compiler, flags, machine, threads, started.
CREATE TABLE sessions (session INTEGER, key TEXT, value TEXT NOT NULL,
  PRIMARY KEY (session, key)) WITHOUT ROWID;
CREATE TABLE trials (trial INTEGER PRIMARY KEY, name TEXT NOT NULL, stage INTEGER NOT NULL,
  scene TEXT NOT NULL);
CREATE TABLE generations (generation INTEGER PRIMARY KEY, champion INTEGER NOT NULL,
  best_eq6 REAL NOT NULL, mean_eq6 REAL NOT NULL, best_score REAL NOT NULL,
  mean_score REAL NOT NULL);
CREATE TABLE generation_trials (generation INTEGER, trial INTEGER, evaluated INTEGER NOT NULL,
  champion_distance REAL NOT NULL, best_distance REAL NOT NULL, mean_distance REAL NOT NULL,
  PRIMARY KEY (generation, trial)) WITHOUT ROWID;
-- How many evaluations of a generation and trial ended with each status; none: no row.
CREATE TABLE status_counts (generation INTEGER, trial INTEGER, status TEXT, count INTEGER NOT NULL,
  PRIMARY KEY (generation, trial, status)) WITHOUT ROWID;
-- eq6 is the geometric mean of the distances, score what the search selects by.
CREATE TABLE individuals (generation INTEGER, position INTEGER, id INTEGER NOT NULL,
  parent_a INTEGER NOT NULL, parent_b INTEGER NOT NULL, score REAL NOT NULL,
  eq6 REAL NOT NULL, penalty REAL NOT NULL, created INTEGER NOT NULL, died INTEGER NOT NULL, nodes INTEGER NOT NULL, links INTEGER NOT NULL,
  PRIMARY KEY (generation, position)) WITHOUT ROWID;
-- One row per evaluated trial of an individual. cells, created, died: the embryo at the stage end,
-- counted from the founder; body_cells, springs, triangles: the body; x, y: the final mean position.
-- Of a trial with several starts: what they amount to together (run/starts.h); steps and what
-- follows it are of one of them.
CREATE TABLE outcomes (generation INTEGER, position INTEGER, trial INTEGER, cells INTEGER NOT NULL,
  created INTEGER NOT NULL, died INTEGER NOT NULL, OUTCOME_COLUMNS,
  PRIMARY KEY (generation, position, trial)) WITHOUT ROWID;
-- What describes an individual in every trial in which it had a body (metamorph/descriptors.h); NULL
-- is what describes motion where it failed, and metamorphosis where no body came before. Of several
-- starts as in outcomes.
CREATE TABLE descriptors (generation INTEGER, position INTEGER, trial INTEGER, DESCRIPTOR_COLUMNS,
  PRIMARY KEY (generation, position, trial)) WITHOUT ROWID;
-- The best by eq 6 of every generation. genome: metamorph-genome/1.
CREATE TABLE champions (generation INTEGER PRIMARY KEY, position INTEGER NOT NULL,
  individual INTEGER NOT NULL, eq6 REAL NOT NULL, score REAL NOT NULL, genome TEXT NOT NULL);
CREATE TABLE checkpoint (only INTEGER PRIMARY KEY CHECK (only = 1), generation INTEGER NOT NULL,
  state BLOB NOT NULL);
CREATE TABLE timings (generation INTEGER, phase TEXT, seconds REAL NOT NULL,
  PRIMARY KEY (generation, phase)) WITHOUT ROWID;
-- What the rows of every table amount to that were written in a generation (run/integrity.h); -1: of
-- the experiment and of the tables' definitions. Those of tables that tell of wall-clock and machine
-- stand apart, by generation or session.
CREATE TABLE digests (number INTEGER, "table" TEXT, rows INTEGER NOT NULL, sum INTEGER NOT NULL,
  PRIMARY KEY (number, "table")) WITHOUT ROWID;
CREATE TABLE session_digests (number INTEGER, "table" TEXT, rows INTEGER NOT NULL,
  sum INTEGER NOT NULL, PRIMARY KEY (number, "table")) WITHOUT ROWID;
-- What figures 10 to 18, 20 and 22 are drawn from.
CREATE VIEW champion_outcomes AS
  SELECT c.generation, c.individual, c.eq6, t.name AS trial_name, t.stage, t.scene, o.*
  FROM champions c
  JOIN outcomes o ON o.generation = c.generation AND o.position = c.position
  JOIN trials t ON t.trial = o.trial;
-- Cells that are born and die from each stage of life to the next (figures 17 and 18); of the trials
-- of one stage the first stands for it.
CREATE VIEW stages AS
  SELECT stage, min(trial) AS trial, row_number() OVER (ORDER BY stage) AS number
  FROM trials GROUP BY stage;
CREATE VIEW metamorphosis AS
  SELECT b.generation, b.position, f.stage AS from_stage, t.stage AS to_stage,
    a.cells AS from_cells, b.cells AS to_cells, b.created - a.created AS born,
    b.died - a.died AS died
  FROM stages f JOIN stages t ON t.number = f.number + 1
  JOIN outcomes a ON a.trial = f.trial
  JOIN outcomes b ON b.trial = t.trial AND b.generation = a.generation AND b.position = a.position;
)sql";

/// Individuals of a generation and their bodies in scenes: how many there were to develop and to
/// simulate, and how many of them were; the others were known already. After a resume less is
/// known.
inline constexpr const char* work_table = R"sql(
CREATE TABLE work (generation INTEGER PRIMARY KEY, individuals INTEGER NOT NULL,
  developed INTEGER NOT NULL, bodies INTEGER NOT NULL, simulated INTEGER NOT NULL);
)sql";

/// The statements that make an empty record.
std::string record_schema();

}  // namespace metamorph::evolve
