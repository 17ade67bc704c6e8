// MAP-Elites (Mouret and Clune 2015): the best of every niche.

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "evolve/search/offspring.h"
#include "evolve/search/origins.h"
#include "evolve/search/population_json.h"
#include "evolve/search/quality_map.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

using enum Table::Type;

/// Every entry into a niche: its last row is who holds it. descriptors: JSON list of all of the
/// problem; genome: JSON as in checkpoints. Numbers read back to the same bits.
const Table elites_table = {"elites",
                            {{"generation", integer},
                             {"niche", integer},
                             {"individual", integer},
                             {"quality", real},
                             {"descriptors", text},
                             {"genome", text}},
                            2};

struct Elite {
  std::int64_t individual = 0;
  double quality = 0;
  Genome genome;
};

/// Quality is the geometric mean of the objectives (eq 6). An elite keeps the quality that it
/// entered with. Whoever has no behaviour enters no niche.
class MapElites : public Search {
 public:
  explicit MapElites(const SearchSetup& setup)
      : neat_(setup.neat),
        problem_(setup.problem),
        threads_(core::thread_count(setup.threads)),
        map_(setup),
        brood_(first_brood(setup)) {}

  Asked ask() const override { return asked_of(brood_, problem_); }
  int generation() const override { return brood_.state.generation; }

  /// Scores: the quality of whoever is in the map afterwards, 0 of all others.
  Told tell(std::span<const Evaluation> evaluations) override {
    check_told(evaluations, brood_.state.genomes.size(), problem_);
    std::vector<double> qualities;
    std::map<int, std::size_t> entries;  // who of the brood holds a niche now
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      qualities.push_back(geometric_mean(evaluations[i]));
      const std::optional<int> niche = map_.niche_of(evaluations[i]);
      if (!niche) continue;
      const auto held = elites_.find(*niche);
      if (held != elites_.end() && qualities[i] <= held->second.quality) continue;
      elites_[*niche] = {brood_.state.individuals[i].id, qualities[i], brood_.state.genomes[i]};
      entries[*niche] = i;
    }

    Told told;
    told.scores.assign(evaluations.size(), 0.0);
    std::vector<std::uint8_t> entered(evaluations.size(), 0);
    std::vector<Row> rows;
    for (const auto& [niche, i] : entries) {
      told.scores[i] = qualities[i];
      entered[i] = 1;
      rows.push_back({std::int64_t{brood_.state.generation}, std::int64_t{niche},
                      brood_.state.individuals[i].id, qualities[i],
                      nlohmann::json(evaluations[i].descriptors).dump(),
                      to_json(brood_.state.genomes[i]).dump()});
    }
    std::map<int, double> worth;
    for (const auto& [niche, elite] : elites_) worth[niche] = elite.quality;
    told.rows = map_.rows(brood_.state.generation, worth, static_cast<int>(entries.size()));
    told.rows.push_back(origin_rows(brood_.state, qualities, brood_.parents, entered));
    told.rows.push_back(std::move(rows));
    breed(qualities);
    return told;
  }

  std::vector<Table> tables() const override {
    std::vector<Table> tables = map_.tables();
    tables.push_back(origins_table(true));
    tables.push_back(elites_table);
    return tables;
  }

  std::vector<std::uint8_t> save() const override {
    return nlohmann::json::to_cbor(
        nlohmann::json{{"brood", to_json(brood_)}, {"filled", elites_.size()}});
  }

  void load(std::span<const std::uint8_t> state, const RowsOf& rows) override {
    try {
      const nlohmann::json json = nlohmann::json::from_cbor(state.begin(), state.end());
      Brood brood = brood_of(json.at("brood"), neat_, problem_);
      const std::vector<Row> entries = rows(elites_table);
      std::map<int, const Row*> last;
      for (const Row& row : entries) {
        last[static_cast<int>(std::get<std::int64_t>(row[1]))] = &row;
      }
      if (last.size() != json.at("filled").get<std::size_t>()) {
        throw std::runtime_error("table elites fills " + std::to_string(last.size()) +
                                 " niches: expected " + json.at("filled").dump());
      }
      elites_.clear();
      for (const auto& [niche, row] : last) {
        elites_[niche] = {std::get<std::int64_t>((*row)[2]), std::get<double>((*row)[3]),
                          genome_of(nlohmann::json::parse(std::get<std::string>((*row)[5])))};
      }
      brood_ = std::move(brood);
    } catch (const nlohmann::json::exception& error) {
      throw std::runtime_error(error.what());
    }
  }

 private:
  /// Uniformly from the map; while nobody is in it, from the brood.
  void breed(const std::vector<double>& qualities) {
    std::vector<Parent> parents;
    for (const auto& [niche, elite] : elites_) {
      parents.push_back({elite.individual, &elite.genome, elite.quality});
    }
    for (std::size_t i = 0; elites_.empty() && i < brood_.state.genomes.size(); ++i) {
      parents.push_back({brood_.state.individuals[i].id, &brood_.state.genomes[i], qualities[i]});
    }
    breed_from(
        parents,
        [&](RandomStream& stream) {
          return stream.below(static_cast<std::uint32_t>(parents.size()));
        },
        neat_, threads_, brood_);
  }

  NeatSettings neat_;
  Problem problem_;
  int threads_;
  QualityMap map_;
  Brood brood_;
  std::map<int, Elite> elites_;  ///< by niche
};

std::unique_ptr<Search> make(const SearchSetup& setup) {
  return std::make_unique<MapElites>(setup);
}

}  // namespace

SearchKind map_elites_search() {
  return {"map-elites", "the best of every niche (grid or CVT MAP-Elites)", axis_settings(), make,
          axis_faults};
}

}  // namespace metamorph::evolve
