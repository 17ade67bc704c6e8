#pragma once

// Searches that are told numbers instead of bodies.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "metamorph/searches.h"

namespace metamorph::tests {

/// A problem of two objectives and three descriptors, two of which are the search's axes.
inline evolve::SearchSetup two_axes(const std::string& kind, int population = 30) {
  evolve::SearchSetup setup;
  setup.settings.kind = kind;
  setup.settings.values["axes"] = std::vector<std::string>{"b.y", "a.x"};
  setup.settings.values["bins"] = std::vector<double>{4, 5};
  setup.settings.values["neighbours"] = 4;
  setup.neat.population = population;
  setup.neat.hidden_nodes = 2;
  setup.problem.objectives = {{"a", 1}, {"b", 2}};
  setup.problem.descriptors = {{"a.x", 0, -2, 2}, {"a.y", 0, -9, 9}, {"b.y", 1, 0, 4}};
  setup.problem.generations = 20;
  setup.problem.seed = 7;
  setup.threads = 1;
  return setup;
}

/// A function of the genome's weights alone; every ninth weight sum means a failure, and values are
/// coarse, so that many are equal.
inline evolve::Evaluation invented(const evolve::Genome& genome) {
  double even = 0, odd = 0, squares = 0;
  for (const evolve::LinkGene& link : genome.links) {
    (link.innovation % 2 == 0 ? even : odd) += link.weight;
    squares += link.weight * link.weight;
  }
  const auto coarse = [](double x) { return std::round(4 * x) / 4; };
  evolve::Evaluation evaluation;
  evaluation.objectives = {std::max(0.0, coarse(3 + even / 4)),
                           std::max(0.0, coarse(3 - even / 4))};
  evaluation.factor = squares > 60 ? 0.5 : 1;
  if (static_cast<int>(std::abs(odd) * 8) % 9 == 0) {
    evaluation.objectives = {0, 0};
    return evaluation;
  }
  evaluation.descriptors = {coarse(odd / 4), coarse(even), coarse(squares / 20)};
  return evaluation;
}

inline std::vector<evolve::Evaluation> invented(const evolve::Asked& asked) {
  std::vector<evolve::Evaluation> all;
  for (const evolve::Genome& genome : asked.genomes) all.push_back(invented(genome));
  return all;
}

/// Which of its tables has that name.
inline std::size_t table_of(const evolve::Search& search, const std::string& name) {
  const std::vector<evolve::Table> tables = search.tables();
  std::size_t t = 0;
  while (tables.at(t).name != name) ++t;
  return t;
}

inline std::int64_t integer(const evolve::Row& row, std::size_t column) {
  return std::get<std::int64_t>(row.at(column));
}
inline double real(const evolve::Row& row, std::size_t column) {
  return std::get<double>(row.at(column));
}

/// The line that a setup is refused with; "made" if it is not.
template <class Change>
std::string refusal(evolve::SearchSetup setup, Change change) {
  change(setup.settings.values);
  try {
    make_search(setup);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "made";
}

}  // namespace metamorph::tests
