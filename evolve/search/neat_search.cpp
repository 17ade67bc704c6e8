#include "evolve/search/neat_search.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evolve/search/population_json.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {

nlohmann::json Scorer::save() const { return nullptr; }

NeatSearch::NeatSearch(const SearchSetup& setup, std::unique_ptr<Scorer> scorer)
    : settings_(setup.neat),
      problem_(setup.problem),
      threads_(core::thread_count(setup.threads)),
      scorer_(std::move(scorer)),
      population_(first_generation(settings_, problem_.seed, setup.shape)) {}

Asked NeatSearch::ask() const {
  Asked asked;
  asked.generation = population_.generation;
  asked.genomes = population_.genomes;
  for (const Individual& individual : population_.individuals) {
    asked.lineage.push_back({individual.id, individual.parent_a, individual.parent_b});
  }
  asked.measured = scorer_->measured(population_.generation);
  if (asked.measured.empty()) asked.measured.assign(problem_.objectives.size(), 1);
  return asked;
}

Told NeatSearch::tell(std::span<const Evaluation> evaluations) {
  const bool fit =
      evaluations.size() == population_.genomes.size() &&
      std::all_of(evaluations.begin(), evaluations.end(), [&](const Evaluation& e) {
        return e.objectives.size() == problem_.objectives.size() &&
               (e.descriptors.empty() || e.descriptors.size() == problem_.descriptors.size());
      });
  if (!fit) {
    throw std::invalid_argument(
        "tell: expected one evaluation per genome, each with the problem's objectives, and its "
        "descriptors or none");
  }
  Told told;
  told.scores = scorer_->score(population_, evaluations);
  told.rows = rows_of(told.scores);
  next_generation(population_, settings_, told.scores,
                  scorer_->restarts_records(population_.generation), threads_);
  return told;
}

std::vector<Table> NeatSearch::tables() const {
  using Type = Table::Type;
  std::vector<Table> tables = {
      {"populations",
       {{"generation", Type::integer},
        {"species", Type::integer},
        {"compatibility_threshold", Type::real}},
       1},
      {"members",
       {{"generation", Type::integer}, {"position", Type::integer}, {"species", Type::integer}},
       2},
      {"species",
       {{"generation", Type::integer},
        {"id", Type::integer},
        {"age", Type::integer},
        {"size", Type::integer},
        {"best_ever", Type::real},
        {"stagnant", Type::integer},
        {"best_score", Type::real},
        {"mean_score", Type::real}},
       2}};
  for (Table& table : scorer_->tables()) tables.push_back(std::move(table));
  return tables;
}

std::vector<std::vector<Row>> NeatSearch::rows_of(const std::vector<double>& scores) const {
  const std::int64_t generation = population_.generation;
  std::vector<std::vector<Row>> rows(3);
  rows[0].push_back({generation, static_cast<std::int64_t>(population_.species.size()),
                     population_.compatibility_threshold});
  for (std::size_t i = 0; i < population_.individuals.size(); ++i) {
    rows[1].push_back({generation, static_cast<std::int64_t>(i),
                       std::int64_t{population_.individuals[i].species}});
  }
  for (const Species& species : population_.species) {
    double best = 0, sum = 0;
    int members = 0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      if (population_.individuals[i].species != species.id) continue;
      best = members == 0 ? scores[i] : std::max(best, scores[i]);
      sum += scores[i];
      ++members;
    }
    rows[2].push_back({generation, std::int64_t{species.id}, std::int64_t{species.age},
                       std::int64_t{species.size}, species.best_ever,
                       std::int64_t{species.stagnant}, best, members > 0 ? sum / members : 0.0});
  }
  for (auto& more : scorer_->rows()) rows.push_back(std::move(more));
  return rows;
}

std::vector<std::uint8_t> NeatSearch::save() const {
  return nlohmann::json::to_cbor(
      nlohmann::json{{"population", to_json(population_)}, {"scorer", scorer_->save()}});
}

void NeatSearch::load(std::span<const std::uint8_t> state, const RowsOf& rows) {
  try {
    const nlohmann::json json = nlohmann::json::from_cbor(state.begin(), state.end());
    PopulationState population = population_of(json.at("population"));
    scorer_->load(json.at("scorer"), rows);
    const auto expected = static_cast<std::size_t>(settings_.population);
    if (population.genomes.size() != expected || population.individuals.size() != expected ||
        population.seed != problem_.seed) {
      throw std::runtime_error("expected population " + std::to_string(expected) + ", seed " +
                               std::to_string(problem_.seed));
    }
    population_ = std::move(population);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace metamorph::evolve
