#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "evolve/search/axes.h"
#include "evolve/search/niches.h"
#include "evolve/search/population_json.h"
#include "tests/evolve/told_search.h"

namespace metamorph::evolve {
namespace {

using ::testing::HasSubstr;
using tests::integer;
using tests::invented;
using tests::real;
using tests::refusal;
using tests::table_of;
using tests::two_axes;

using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

TEST(Axes, AreChosenByNameAndGoFromEndToEnd) {
  SearchSetup setup = two_axes("map-elites");
  std::vector<Axis> axes = axes_of(setup);
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_EQ(axes[0].descriptor, 2u);
  EXPECT_EQ(axes[1].low, -2);
  EXPECT_EQ(position_on(axes, {{}, {-2, 77, 1}, 1}), (Numbers{0.25, 0}));
  EXPECT_EQ(position_on(axes, {{}, {6, 77, 4}, 1}), (Numbers{1, 2}));  // beyond the end
  EXPECT_TRUE(position_on(axes, {{}, {}, 1}).empty());
  setup.settings.values["axis_low"] = Numbers{1, 5};
  setup.settings.values["axis_high"] = Numbers{2, 15};
  axes = axes_of(setup);
  EXPECT_EQ(position_on(axes, {{}, {10, 77, 1.25}, 1}), (Numbers{0.25, 0.5}));
}

TEST(Axes, OfWrongSettingsGetALine) {
  for (const std::string kind : {"map-elites", "nslc", "dns"}) {
    const SearchSetup setup = two_axes(kind);
    EXPECT_EQ(refusal(setup, [](auto&) {}), "made");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["axes"] = Names{}; }),
              "search.axes: expected one at least of a.x, a.y, b.y");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["axes"] = Names{"a.x", "a.z"}; }),
              "search.axes: expected none but a.x, a.y, b.y (\"a.z\" is unknown)");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["axes"] = Names{"a.x", "a.x"}; }),
              "search.axes: expected each descriptor once");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["axis_low"] = Numbers{1}; }),
              "search.axis_low: expected a number for each of the 2 axes, or none");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["axis_high"] = Numbers{1, 2, 3}; }),
              "search.axis_high: expected a number for each of the 2 axes, or none");
    EXPECT_EQ(refusal(setup,
                      [](auto& v) {
                        v["axis_low"] = Numbers{0, 1};
                        v["axis_high"] = Numbers{1, 1};
                      }),
              "search.axis_low: expected low ends below high ones, a.x goes from 1 to 1");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["axis_high"] = Numbers{-1, 1}; }),
              "search.axis_high: expected low ends below high ones, b.y goes from 0 to -1");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["bins"] = Numbers{2, 3, 4}; }),
              "search.bins: expected a whole number, or one for each of the 2 axes");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["bins"] = Numbers{}; }),
              "search.bins: expected a whole number, or one for each of the 2 axes");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["bins"] = Numbers{2.5}; }),
              "search.bins: expected a whole number, or one for each of the 2 axes");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["bins"] = Numbers{0}; }),
              "search.bins: expected a number from 1 to 1000000");
    EXPECT_EQ(refusal(setup, [](auto& v) { v["bins"] = Numbers{2000}; }),
              "search.bins: expected at most 1000000 niches, these are 4000000");
  }
}

/// Who was told of.
struct Known {
  std::int64_t id;
  double quality;
  Evaluation evaluation;
  Genome genome;
};

TEST(MapElites, KeepsTheBestOfEveryNiche) {
  for (const int centres : {0, 12}) {
    SearchSetup setup = two_axes("map-elites");
    setup.settings.values["niches"] = centres;
    const auto search = make_search(setup);
    const std::vector<Axis> axes = axes_of(setup);
    const Niches niches = centres == 0 ? Niches::grid({4, 5}) : Niches::centroidal(centres, 2, 1);
    std::vector<Known> all;
    std::map<std::int64_t, Row> held;  // by niche, as the table tells
    double last_score = 0;
    for (int g = 0; g < 20; ++g) {
      const Asked asked = search->ask();
      EXPECT_EQ(asked.genomes.size(), 30u);
      const std::vector<Evaluation> evaluations = invented(asked);
      for (std::size_t i = 0; i < asked.genomes.size(); ++i) {
        all.push_back({asked.lineage[i].id, geometric_mean(evaluations[i]), evaluations[i],
                       asked.genomes[i]});
      }
      const std::size_t elites = table_of(*search, "elites"), qd = table_of(*search, "qd");
      const Told told = search->tell(evaluations);
      for (const Row& row : told.rows[elites]) {
        EXPECT_EQ(integer(row, 0), g);
        held[integer(row, 1)] = row;
      }
      // By brute force: of each niche the best of all there ever were, of equals the first.
      std::map<std::int64_t, const Known*> best;
      for (const Known& known : all) {
        const std::vector<double> position = position_on(axes, known.evaluation);
        if (position.empty()) continue;
        const Known*& here = best[niches.niche_of(position)];
        if (here == nullptr || known.quality > here->quality) here = &known;
      }
      ASSERT_EQ(held.size(), best.size());
      double score = 0;
      for (const auto& [niche, known] : best) {
        const Row& row = held.at(niche);
        EXPECT_EQ(integer(row, 2), known->id);
        EXPECT_EQ(real(row, 3), known->quality);
        EXPECT_EQ(nlohmann::json::parse(std::get<std::string>(row[4])).get<Numbers>(),
                  known->evaluation.descriptors);
        EXPECT_EQ(genome_of(nlohmann::json::parse(std::get<std::string>(row[5]))), known->genome);
        score += known->quality;
      }
      ASSERT_EQ(told.rows[qd].size(), 1u);
      const Row& worth = told.rows[qd][0];
      EXPECT_EQ(integer(worth, 1), static_cast<std::int64_t>(best.size()));
      EXPECT_EQ(integer(worth, 2), niches.count());
      EXPECT_EQ(real(worth, 3), static_cast<double>(best.size()) / niches.count());
      EXPECT_NEAR(real(worth, 4), score, 1e-12 * score);
      EXPECT_GE(real(worth, 4), last_score);
      EXPECT_EQ(integer(worth, 7), static_cast<std::int64_t>(told.rows[elites].size()));
      last_score = real(worth, 4);
      // Whoever is in the map scores its quality, all others nothing.
      for (std::size_t i = 0; i < asked.genomes.size(); ++i) {
        const bool in = std::any_of(best.begin(), best.end(), [&](const auto& entry) {
          return entry.second->id == asked.lineage[i].id;
        });
        EXPECT_EQ(told.scores[i], in ? geometric_mean(evaluations[i]) : 0);
      }
      // The next parents are elites.
      for (const Lineage& child : search->ask().lineage) {
        for (const std::int64_t parent : {child.parent_a, child.parent_b}) {
          if (parent < 0) continue;
          EXPECT_TRUE(std::any_of(best.begin(), best.end(),
                                  [&](const auto& entry) { return entry.second->id == parent; }));
        }
      }
      const std::size_t where = table_of(*search, "centroids");
      EXPECT_EQ(told.rows[where].size(), g == 0 ? static_cast<std::size_t>(centres) : 0u);
    }
    EXPECT_GT(last_score, 0);
    EXPECT_GT(held.size(), 3u);
  }
}

TEST(MapElites, CentroidsStandInTheUnitsOfTheAxes) {
  SearchSetup setup = two_axes("map-elites");
  setup.settings.values["niches"] = 6;
  const auto search = make_search(setup);
  const std::vector<double> unit = Niches::centroidal(6, 2, 1).centres();
  const Told told = search->tell(invented(search->ask()));
  const std::vector<Row>& rows = told.rows[table_of(*search, "centroids")];
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const auto centre = nlohmann::json::parse(std::get<std::string>(rows[c][1])).get<Numbers>();
    EXPECT_EQ(centre, (Numbers{4 * unit[2 * c], -2 + 4 * unit[2 * c + 1]}));
  }
}

TEST(MapElites, WhileNobodyBehavesTheBroodBreedsItself) {
  const auto search = make_search(two_axes("map-elites"));
  const std::vector<Evaluation> failed(30, Evaluation{{0, 0}, {}, 1});
  std::set<std::int64_t> before;
  for (int g = 0; g < 3; ++g) {
    const Asked asked = search->ask();
    for (const Lineage& child : asked.lineage) {
      EXPECT_EQ(child.parent_a < 0 || before.contains(child.parent_a), true);
      EXPECT_EQ(child.parent_a < 0, g == 0);
    }
    before.clear();
    for (const Lineage& child : asked.lineage) before.insert(child.id);
    const Told told = search->tell(failed);
    EXPECT_EQ(integer(told.rows[table_of(*search, "qd")][0], 1), 0);
  }
}

TEST(MapElites, BreedsNobodyWhoLivesAlready) {
  const auto search = make_search(two_axes("map-elites"));
  std::vector<Genome> all;
  for (int g = 0; g < 10; ++g) {
    const Asked asked = search->ask();
    for (const Genome& genome : asked.genomes) {
      EXPECT_EQ(std::count(all.begin(), all.end(), genome), 0);
      all.push_back(genome);
    }
    // Everybody is better than all before and in a niche of its own, as far as there are some.
    std::vector<Evaluation> evaluations(30, Evaluation{{g + 1.0, g + 1.0}, {0, 0, 0}, 1});
    for (std::size_t i = 0; i < 30; ++i) {
      evaluations[i].descriptors = {-2 + 0.2 * static_cast<double>(i % 20), 0,
                                    static_cast<double>(i % 4)};
    }
    search->tell(evaluations);
  }
}

TEST(Origins, CountChildrenAndThoseThatEnter) {
  for (const std::string kind : {"map-elites", "nslc", "dns", "nsga2"}) {
    const auto search = make_search(two_axes(kind));
    const std::size_t origins = table_of(*search, "origins");
    std::map<std::int64_t, double> known;  // quality by individual
    for (int g = 0; g < 6; ++g) {
      const Asked asked = search->ask();
      const std::vector<Evaluation> evaluations = invented(asked);
      std::int64_t expected = 0;
      for (std::size_t i = 0; i < evaluations.size(); ++i) {
        const auto [id, a, b] = asked.lineage[i];
        known[id] = geometric_mean(evaluations[i]);
        expected += a >= 0 && known[id] > known.at(a) && (b < 0 || known[id] > known.at(b)) ? 1 : 0;
      }
      const std::int64_t dead = std::count_if(
          evaluations.begin(), evaluations.end(),
          [](const Evaluation& evaluation) { return geometric_mean(evaluation) == 0; });
      const Told told = search->tell(evaluations);
      std::int64_t children = 0, better = 0, entered = 0, told_dead = 0;
      for (const Row& row : told.rows[origins]) {
        EXPECT_EQ(std::get<std::string>(row[1]) == "first", g == 0);
        children += integer(row, 3);
        better += integer(row, 4);
        entered += integer(row, 5);
        told_dead += integer(row, 6);
      }
      EXPECT_EQ(children, 30);
      EXPECT_EQ(better, expected);
      EXPECT_EQ(told_dead, dead);
      const std::string summary = kind == "nsga2" ? "fronts" : "qd";
      EXPECT_EQ(entered, std::get<std::int64_t>(told.rows[table_of(*search, summary)][0].back()));
    }
  }
}

TEST(MapElites, RefusesAMapThatItDidNotSave) {
  const SearchSetup setup = two_axes("map-elites");
  const auto search = make_search(setup);
  search->tell(invented(search->ask()));
  const auto state = search->save();
  const auto again = make_search(setup);
  try {
    again->load(state, [](const Table&) { return std::vector<Row>{}; });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("table elites fills 0 niches: expected"));
  }
  EXPECT_THROW(again->load(std::vector<std::uint8_t>{1, 2, 3},
                           [](const Table&) { return std::vector<Row>{}; }),
               std::runtime_error);
}

}  // namespace
}  // namespace metamorph::evolve
