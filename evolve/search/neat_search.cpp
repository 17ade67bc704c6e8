#include "evolve/search/neat_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "evolve/genetics/species.h"
#include "evolve/search/offspring.h"
#include "evolve/search/origins.h"
#include "evolve/search/population_json.h"
#include "metamorph/threads.h"
#include "metamorph/variation.h"

namespace metamorph::evolve {

namespace {
// Tables that every NEAT search has, in this order; with separated stages another one follows, then
// those of its scorer.
constexpr std::size_t origins_place = 3, changes_place = 4, own_tables = 5;

}  // namespace

nlohmann::json Scorer::save() const { return nullptr; }

std::vector<std::string> neat_notes(const SearchSetup& setup) {
  const NeatSettings& neat = setup.neat;
  const int room = species_range(neat).max;
  if (room == neat.species_max) return {};
  return {fmt::format(
      "neat.population = {} has room for {} species of neat.species_members = {}: steering to no "
      "more, though neat.species_max = {}",
      neat.population, room, neat.species_members, neat.species_max)};
}

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
  asked.measured = measured();
  return asked;
}

std::vector<std::uint8_t> NeatSearch::measured() const {
  std::vector<std::uint8_t> measured = scorer_->measured(population_.generation);
  if (measured.empty()) measured.assign(problem_.objectives.size(), 1);
  return measured;
}

Told NeatSearch::tell(std::span<const Evaluation> evaluations) {
  check_told(evaluations, population_.genomes.size(), problem_);
  Told told;
  told.scores = scorer_->score(population_, evaluations);
  std::vector<double> merits;
  const std::vector<std::uint8_t> measured = this->measured();
  for (Evaluation evaluation : evaluations) {
    std::size_t kept = 0;
    for (std::size_t o = 0; o < measured.size(); ++o) {
      if (measured[o] != 0) evaluation.objectives[kept++] = evaluation.objectives[o];
    }
    evaluation.objectives.resize(kept);
    merits.push_back(geometric_mean(evaluation));
  }
  told.rows = rows_of(told.scores);
  told.rows[origins_place] = origin_rows(population_, merits, better_parents(), {});
  std::vector<Row>& changes = told.rows[changes_place];
  const auto note = [&](int id, std::string_view change) {
    changes.push_back(
        {std::int64_t{population_.generation}, std::int64_t{id}, std::string(change)});
  };
  if (population_.generation == 0) {
    for (const Species& species : population_.species) note(species.id, "founded");
  }
  parents_ = std::move(merits);
  first_parent_ = population_.individuals.front().id;
  const int next_species = population_.next_species;
  for (const auto& [id, why] :
       next_generation(population_, settings_, told.scores,
                       scorer_->restarts_records(population_.generation), threads_)) {
    note(id, species_end_names[static_cast<std::size_t>(why)].name);
  }
  for (const Species& species : population_.species) {
    if (species.id >= next_species) note(species.id, "founded");
  }
  return told;
}

std::vector<Table> NeatSearch::tables() const {
  using enum Table::Type;
  std::vector<Table> tables = {
      {"populations",
       {{"generation", integer}, {"species", integer}, {"compatibility_threshold", real}},
       1},
      {"members", {{"generation", integer}, {"position", integer}, {"species", integer}}, 2},
      {"species",
       {{"generation", integer},
        {"id", integer},
        {"age", integer},
        {"size", integer},
        {"best_ever", real},
        {"stagnant", integer},
        {"best_score", real},
        {"mean_score", real}},
       2},
      // Better, and dead (0), by the geometric mean of the measured objectives.
      origins_table(false),
      // In which generation a species was founded, or why it is no more.
      {"species_changes", {{"generation", integer}, {"species", integer}, {"change", text}}, 2}};
  // How many links a genome has, in the mean, that are expressed in these stages of life.
  if (settings_.separation != Separation::none) {
    tables.push_back(
        {"gene_stages",
         {{"generation", integer}, {"first", integer}, {"last", integer}, {"links", real}},
         3});
  }
  for (Table& table : scorer_->tables()) tables.push_back(std::move(table));
  return tables;
}

std::vector<std::vector<Row>> NeatSearch::rows_of(const std::vector<double>& scores) const {
  const std::int64_t generation = population_.generation;
  std::vector<std::vector<Row>> rows(own_tables);
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
  if (settings_.separation != Separation::none) rows.push_back(gene_rows());
  for (auto& more : scorer_->rows()) rows.push_back(std::move(more));
  return rows;
}

std::vector<double> NeatSearch::better_parents() const {
  const auto merit = [&](std::int64_t id) {
    return id < 0 ? -1.0 : parents_[static_cast<std::size_t>(id - first_parent_)];
  };
  std::vector<double> better;
  for (const Individual& child : population_.individuals) {
    better.push_back(std::max(merit(child.parent_a), merit(child.parent_b)));
  }
  return better;
}

std::vector<Row> NeatSearch::gene_rows() const {
  std::map<std::pair<int, int>, std::int64_t> links;
  for (const Stages& stages : possible_stages(settings_)) {
    links[{stages.first, std::min(stages.last, settings_.stages - 1)}] = 0;
  }
  for (const Genome& genome : population_.genomes) {
    for (const LinkGene& link : genome.links) {
      ++links[{link.stages.first, std::min(link.stages.last, settings_.stages - 1)}];
    }
  }
  std::vector<Row> rows;
  for (const auto& [stages, count] : links) {
    rows.push_back({std::int64_t{population_.generation}, std::int64_t{stages.first},
                    std::int64_t{stages.second},
                    static_cast<double>(count) / settings_.population});
  }
  return rows;
}

std::vector<std::uint8_t> NeatSearch::save() const {
  return nlohmann::json::to_cbor(nlohmann::json{{"population", to_json(population_)},
                                                {"parents", parents_},
                                                {"first_parent", first_parent_},
                                                {"scorer", scorer_->save()}});
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
    json.at("parents").get_to(parents_);
    json.at("first_parent").get_to(first_parent_);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace metamorph::evolve
