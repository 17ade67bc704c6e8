#pragma once

namespace metamorph::evolve {

inline constexpr const char* record_format = "metamorph-run/1";
inline constexpr const char* record_file = "run.db";

/// The tables of run.db. What depends on wall-clock, machine or interruptions stands in `sessions`,
/// `timings` and `work` alone: every other table is the same, bit for bit, for one configuration.
///
/// Units: distances and positions in cell diameters d; times in time units, steps as named.
inline constexpr const char* record_schema = R"sql(
-- format, experiment, seed, configuration (TOML, complete).
CREATE TABLE run (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
-- One set of rows per start or resume: version, compiler, flags, machine, threads, started.
CREATE TABLE sessions (session INTEGER, key TEXT, value TEXT NOT NULL,
  PRIMARY KEY (session, key)) WITHOUT ROWID;
CREATE TABLE trials (trial INTEGER PRIMARY KEY, name TEXT NOT NULL, stage INTEGER NOT NULL,
  scene TEXT NOT NULL);
CREATE TABLE generations (generation INTEGER PRIMARY KEY, champion INTEGER NOT NULL,
  best_eq6 REAL NOT NULL, mean_eq6 REAL NOT NULL, best_score REAL NOT NULL,
  mean_score REAL NOT NULL, species INTEGER NOT NULL, compatibility_threshold REAL NOT NULL,
  archive_added INTEGER NOT NULL, archive_size INTEGER NOT NULL, archive_threshold REAL NOT NULL);
CREATE TABLE generation_trials (generation INTEGER, trial INTEGER, evaluated INTEGER NOT NULL,
  champion_distance REAL NOT NULL, best_distance REAL NOT NULL, mean_distance REAL NOT NULL,
  PRIMARY KEY (generation, trial)) WITHOUT ROWID;
-- How many evaluations of a generation and trial ended with each status; none: no row.
CREATE TABLE status_counts (generation INTEGER, trial INTEGER, status TEXT, count INTEGER NOT NULL,
  PRIMARY KEY (generation, trial, status)) WITHOUT ROWID;
-- eq6 is the geometric mean of the distances, score what the search selects by.
CREATE TABLE individuals (generation INTEGER, position INTEGER, id INTEGER NOT NULL,
  parent_a INTEGER NOT NULL, parent_b INTEGER NOT NULL, species INTEGER NOT NULL,
  score REAL NOT NULL, eq6 REAL NOT NULL, penalty REAL NOT NULL, created INTEGER NOT NULL,
  died INTEGER NOT NULL, nodes INTEGER NOT NULL, links INTEGER NOT NULL,
  PRIMARY KEY (generation, position)) WITHOUT ROWID;
-- One row per evaluated trial of an individual. cells, created, died: the embryo at the stage end,
-- counted from the founder; body_cells, springs, triangles: the body; x, y: the final mean position.
-- Of a trial with several starts: what they amount to together (run/starts.h); steps and what
-- follows it are of one of them.
CREATE TABLE outcomes (generation INTEGER, position INTEGER, trial INTEGER, status TEXT NOT NULL,
  distance REAL NOT NULL, x REAL, y REAL, cells INTEGER NOT NULL, created INTEGER NOT NULL,
  died INTEGER NOT NULL, body_cells INTEGER NOT NULL, springs INTEGER NOT NULL,
  triangles INTEGER NOT NULL, steps INTEGER NOT NULL, settle_time REAL, min_area_ratio REAL,
  max_speed REAL, longest_spring REAL, long_spring_share REAL, failed_step INTEGER,
  failed_index INTEGER, failed_value REAL,
  PRIMARY KEY (generation, position, trial)) WITHOUT ROWID;
CREATE TABLE species (generation INTEGER, id INTEGER, age INTEGER NOT NULL, size INTEGER NOT NULL,
  best_ever REAL NOT NULL, stagnant INTEGER NOT NULL, best_score REAL NOT NULL,
  mean_score REAL NOT NULL, PRIMARY KEY (generation, id)) WITHOUT ROWID;
-- behaviour: JSON list, x and y of every trial; numbers read back to the same bits.
CREATE TABLE archive (number INTEGER PRIMARY KEY, individual INTEGER NOT NULL,
  generation INTEGER NOT NULL, novelty REAL NOT NULL, behaviour TEXT NOT NULL);
-- The best by eq 6 of every generation. genome: metamorph-genome/1.
CREATE TABLE champions (generation INTEGER PRIMARY KEY, position INTEGER NOT NULL,
  individual INTEGER NOT NULL, eq6 REAL NOT NULL, score REAL NOT NULL, genome TEXT NOT NULL);
CREATE TABLE checkpoint (only INTEGER PRIMARY KEY CHECK (only = 1), generation INTEGER NOT NULL,
  state BLOB NOT NULL);
CREATE TABLE timings (generation INTEGER, phase TEXT, seconds REAL NOT NULL,
  PRIMARY KEY (generation, phase)) WITHOUT ROWID;
-- What figures 10 to 18, 20 and 22 are drawn from.
CREATE VIEW champion_outcomes AS
  SELECT c.generation, c.individual, c.eq6, t.name AS trial_name, t.stage, t.scene, o.*
  FROM champions c
  JOIN outcomes o ON o.generation = c.generation AND o.position = c.position
  JOIN trials t ON t.trial = o.trial;
-- Cells that are born and die between the first and the last stage (figures 17 and 18).
CREATE VIEW metamorphosis AS
  SELECT a.generation, a.position, l.cells AS larva_cells, a.cells AS adult_cells,
    a.created - l.created AS born, a.died - l.died AS died
  FROM outcomes a
  JOIN outcomes l ON l.generation = a.generation AND l.position = a.position AND l.trial = 0
  JOIN trials tl ON tl.trial = 0
  JOIN trials ta ON ta.trial = a.trial AND ta.stage > tl.stage;
)sql";

/// Apart, because records of earlier versions lack it until they are resumed.
///
/// Individuals of a generation and their bodies in scenes: how many there were to develop and to
/// simulate, and how many of them were; the others were known already. After a resume less is
/// known.
inline constexpr const char* work_schema = R"sql(
CREATE TABLE IF NOT EXISTS work (generation INTEGER PRIMARY KEY, individuals INTEGER NOT NULL,
  developed INTEGER NOT NULL, bodies INTEGER NOT NULL, simulated INTEGER NOT NULL);
)sql";

}  // namespace metamorph::evolve
