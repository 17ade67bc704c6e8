#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "metamorph/evaluation.h"
#include "metamorph/genome.h"

namespace metamorph::evolve {

/// Where an individual comes from. Parent -1: none (the first ones); b alone -1: asexual.
struct Lineage {
  std::int64_t id = 0;  ///< counts individuals ever bred in the run
  std::int64_t parent_a = -1, parent_b = -1;
  bool operator==(const Lineage&) const = default;
};

/// What a search wants evaluated next.
struct Asked {
  int generation = 0;
  std::vector<Genome> genomes;
  std::vector<Lineage> lineage;             ///< [genomes]
  std::vector<std::uint8_t> measured = {};  ///< [objectives] 0: this one is not needed yet
};

/// A table of what a search tells about itself. The record of a run keeps it under its name.
struct Table {
  enum class Type { integer, real, text };
  struct Column {
    std::string name;
    Type type;
  };
  std::string name;
  std::vector<Column> columns;  ///< the first `keys` of them tell rows apart
  int keys = 1;
};

/// Comes back from a record to the same bits, but for the sign of a zero.
using Cell = std::variant<std::int64_t, double, std::string>;
using Row = std::vector<Cell>;  ///< [columns] of their types

/// What came of an evaluation.
struct Told {
  std::vector<double> scores;          ///< [genomes] >= 0, by the search's own rule
  std::vector<std::vector<Row>> rows;  ///< [tables] rows that this generation adds
};

/// A search: asks for genomes, is told how they did, asks for the next. It depends on its settings
/// and on what it was told alone: the same bits for any number of threads, and for one that was
/// saved and loaded in between.
class Search {
 public:
  virtual ~Search() = default;

  /// The individuals to evaluate now. Asking twice gives the same.
  virtual Asked ask() const = 0;
  /// Takes the evaluations of what ask() gave, in its order (std::invalid_argument if they do not
  /// fit the problem), and goes on to the next generation.
  virtual Told tell(std::span<const Evaluation> evaluations) = 0;
  /// Generations told so far.
  virtual int generation() const = 0;

  /// True if another number of generations would have been another search from the start.
  virtual bool is_paced() const { return false; }

  virtual std::vector<Table> tables() const { return {}; }
  /// All that decides how it goes on, but for what can be read back from its tables.
  /// A search that does not say how it is saved throws std::logic_error: no record can keep it.
  virtual std::vector<std::uint8_t> save() const {
    throw std::logic_error("this search cannot be saved");
  }
  /// Gives the rows of one of its tables, in order of their keys.
  using RowsOf = std::function<std::vector<Row>(const Table&)>;
  /// The inverse. Throws std::runtime_error if the state is not one that this search saved.
  virtual void load(std::span<const std::uint8_t> /*state*/, const RowsOf& /*rows*/) {
    throw std::logic_error("this search cannot be saved");
  }
};

}  // namespace metamorph::evolve
