#include "evolve/search/pool_search.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "evolve/search/offspring.h"
#include "evolve/search/origins.h"
#include "evolve/search/population_json.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

using Json = nlohmann::json;
using enum Table::Type;

const Table pool_table = {"pool",
                          {{"generation", integer},
                           {"position", integer},
                           {"individual", integer},
                           {"born", integer},
                           {"quality", real}},
                          2};

// The bindings name every field: a new one does not compile before it is thought of here.

Json to_json(const Member& member) {
  const auto& [id, born, genome, evaluation, quality] = member;
  const auto& [objectives, descriptors, factor] = evaluation;
  return {id, born, metamorph::evolve::to_json(genome), objectives, descriptors, factor, quality};
}

Member member_of(const Json& json) {
  Member member;
  auto& [id, born, genome, evaluation, quality] = member;
  auto& [objectives, descriptors, factor] = evaluation;
  json.at(0).get_to(id);
  json.at(1).get_to(born);
  genome = genome_of(json.at(2));
  json.at(3).get_to(objectives);
  json.at(4).get_to(descriptors);
  json.at(5).get_to(factor);
  json.at(6).get_to(quality);
  return member;
}

}  // namespace

Json Survival::save() const { return nullptr; }

PoolSearch::PoolSearch(const SearchSetup& setup, std::unique_ptr<Survival> survival)
    : neat_(setup.neat),
      problem_(setup.problem),
      threads_(core::thread_count(setup.threads)),
      survival_(std::move(survival)),
      brood_(first_brood(setup)) {}

Asked PoolSearch::ask() const { return asked_of(brood_, problem_); }

Told PoolSearch::tell(std::span<const Evaluation> evaluations) {
  check_told(evaluations, brood_.state.genomes.size(), problem_);
  const std::int64_t first_child = brood_.state.individuals.front().id;
  std::vector<double> qualities;
  std::vector<Member> children;
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    qualities.push_back(geometric_mean(evaluations[i]));
    children.push_back({brood_.state.individuals[i].id, brood_.state.generation,
                        brood_.state.genomes[i], evaluations[i], qualities[i]});
  }
  std::vector<Member> pool = std::move(pool_);
  pool.insert(pool.end(), children.begin(), children.end());
  std::sort(pool.begin(), pool.end(), [](const Member& a, const Member& b) { return a.id < b.id; });
  const Survival::Judgement judged = survival_->judge(pool);

  Told told;
  told.scores.resize(children.size());
  for (std::size_t p = 0; p < pool.size(); ++p) {
    if (pool[p].id < first_child) continue;
    told.scores[static_cast<std::size_t>(pool[p].id - first_child)] = judged.scores[p];
  }
  const auto places = static_cast<std::size_t>(neat_.population);
  pool_.clear();
  std::vector<std::uint8_t> lives_on(children.size(), 0);
  int entered = 0;
  for (std::size_t place = 0; place < std::min(places, pool.size()); ++place) {
    Member& member = pool_.emplace_back(std::move(pool[judged.order[place]]));
    if (member.id < first_child) continue;
    lives_on[static_cast<std::size_t>(member.id - first_child)] = 1;
    ++entered;
  }
  told.rows = survival_->rows(brood_.state.generation, pool_, children, entered);
  told.rows.push_back(origin_rows(brood_.state, qualities, brood_.parents, lives_on));
  std::vector<Row>& living = told.rows.emplace_back();
  for (std::size_t i = 0; i < pool_.size(); ++i) {
    living.push_back({std::int64_t{brood_.state.generation}, static_cast<std::int64_t>(i),
                      pool_[i].id, std::int64_t{pool_[i].born}, pool_[i].quality});
  }
  breed();
  return told;
}

void PoolSearch::breed() {
  std::vector<Parent> parents;
  for (const Member& member : pool_) parents.push_back({member.id, &member.genome, member.quality});
  const auto count = static_cast<std::uint32_t>(parents.size());
  breed_from(
      parents,
      [&](RandomStream& stream) {
        std::size_t best = stream.below(count);
        for (int more = 1; more < survival_->tournament(); ++more) {
          best = std::min(best, std::size_t{stream.below(count)});
        }
        return best;
      },
      neat_, threads_, brood_);
}

std::vector<Table> PoolSearch::tables() const {
  std::vector<Table> tables = survival_->tables();
  tables.push_back(origins_table(true));
  tables.push_back(pool_table);
  return tables;
}

std::vector<std::uint8_t> PoolSearch::save() const {
  Json pool = Json::array();
  for (const Member& member : pool_) pool.push_back(to_json(member));
  return Json::to_cbor(Json{{"brood", metamorph::evolve::to_json(brood_)},
                            {"pool", std::move(pool)},
                            {"survival", survival_->save()}});
}

void PoolSearch::load(std::span<const std::uint8_t> state, const RowsOf& rows) {
  try {
    const Json json = Json::from_cbor(state.begin(), state.end());
    Brood brood = brood_of(json.at("brood"), neat_, problem_);
    std::vector<Member> pool;
    for (const Json& member : json.at("pool")) pool.push_back(member_of(member));
    survival_->load(json.at("survival"), rows);
    brood_ = std::move(brood);
    pool_ = std::move(pool);
  } catch (const Json::exception& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace metamorph::evolve
