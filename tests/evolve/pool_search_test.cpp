// The searches whose parents and children compete for places: nsga2, dns, nslc.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "evolve/search/axes.h"
#include "evolve/search/local_competition.h"
#include "evolve/search/niches.h"
#include "evolve/search/nondominated.h"
#include "metamorph/metrics.h"
#include "tests/evolve/random_genomes.h"
#include "tests/evolve/told_search.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using testing::test_stream;
using tests::integer;
using tests::invented;
using tests::real;
using tests::table_of;
using tests::two_axes;

struct One {
  std::int64_t id = 0;
  Evaluation evaluation;
};

std::vector<std::int64_t> living(const Search& search, const Told& told) {
  std::vector<std::int64_t> ids;
  for (const Row& row : told.rows[table_of(search, "pool")]) ids.push_back(integer(row, 2));
  return ids;
}

/// Tells a search what is invented for so many generations and compares who lives on, and the
/// children's scores, with what `expected` makes of all who compete, the eldest first: the
/// survivors, best first, and the scores. Calls see(told, survivors) in each.
template <class Expected, class See>
void follow(const SearchSetup& setup, int generations, Expected expected, See see) {
  const auto search = make_search(setup);
  std::vector<One> pool;
  for (int g = 0; g < generations; ++g) {
    const Asked asked = search->ask();
    ASSERT_EQ(asked.genomes.size(), static_cast<std::size_t>(setup.neat.population));
    std::set<std::int64_t> parents;
    for (const One& one : pool) parents.insert(one.id);
    for (const Lineage& child : asked.lineage) {
      for (const std::int64_t parent : {child.parent_a, child.parent_b}) {
        EXPECT_TRUE(parent < 0 || parents.contains(parent));
      }
      EXPECT_EQ(child.parent_a < 0, g == 0);
    }
    const std::vector<Evaluation> evaluations = invented(asked);
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      pool.push_back({asked.lineage[i].id, evaluations[i]});
    }
    std::sort(pool.begin(), pool.end(), [](const One& a, const One& b) { return a.id < b.id; });
    const auto [order, scores] = expected(pool);
    const Told told = search->tell(evaluations);

    std::vector<One> next;
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < static_cast<std::size_t>(setup.neat.population); ++i) {
      next.push_back(pool[order[i]]);
      ids.push_back(next.back().id);
    }
    ASSERT_EQ(living(*search, told), ids) << "generation " << g;
    for (std::size_t p = 0; p < pool.size(); ++p) {
      const std::int64_t child = pool[p].id - asked.lineage[0].id;
      if (child >= 0) {
        EXPECT_NEAR(told.scores[static_cast<std::size_t>(child)], scores[p], 1e-14);
      }
    }
    pool = next;
    see(*search, told, pool);
  }
}

using Verdict = std::pair<std::vector<std::size_t>, std::vector<double>>;

std::vector<double> costly(const Evaluation& evaluation) {
  std::vector<double> objectives = evaluation.objectives;
  for (double& objective : objectives) objective *= evaluation.factor;
  return objectives;
}

TEST(Nsga2, KeepsTheBestFrontsAndTellsTheFirst) {
  const auto expected = [](const std::vector<One>& pool) {
    std::vector<std::vector<double>> points;
    for (const One& one : pool) points.push_back(costly(one.evaluation));
    const Ranking ranking = rank(points);
    Verdict verdict{ranking.order, {}};
    for (const int front : ranking.front) verdict.second.push_back(1.0 / (1 + front));
    return verdict;
  };
  std::size_t largest = 0;
  follow(two_axes("nsga2"), 15, expected,
         [&](const Search& search, const Told& told, const std::vector<One>& pool) {
           const std::size_t front = table_of(search, "front");
           const std::vector<Table::Column> columns = search.tables()[front].columns;
           ASSERT_EQ(columns.size(), 5u);
           EXPECT_EQ(columns[3].name, "objective_a");
           EXPECT_EQ(columns[4].name, "objective_b");
           // Those of the pool whom nobody dominates, each with its objectives.
           std::vector<std::vector<double>> points, nondominated;
           for (const One& one : pool) points.push_back(costly(one.evaluation));
           const std::vector<int> fronts = front_numbers(points);
           std::map<std::int64_t, Row> rows;
           for (const Row& row : told.rows[front]) rows[integer(row, 1)] = row;
           EXPECT_EQ(rows.size(), told.rows[front].size());
           for (std::size_t i = 0; i < pool.size(); ++i) {
             ASSERT_EQ(rows.contains(pool[i].id), fronts[i] == 0);
             if (fronts[i] != 0) continue;
             nondominated.push_back({real(rows[pool[i].id], 3), real(rows[pool[i].id], 4)});
             EXPECT_EQ(nondominated.back(), points[i]);
           }
           largest = std::max(largest, rows.size());
           const Row& summary = told.rows[table_of(search, "fronts")][0];
           EXPECT_EQ(real(summary, 3), hypervolume(nondominated, std::vector<double>{0, 0}));
         });
  EXPECT_GT(largest, 2u);
}

TEST(Nsga2, ColumnsOfTrialsThatDifferInCapitalsDiffer) {
  SearchSetup setup = two_axes("nsga2");
  setup.problem.objectives = {{"Larva", 1}, {"larva", 2}, {"crowding", 2}};
  const auto search = make_search(setup);
  std::vector<std::string> names;
  const std::vector<Table> tables = search->tables();
  for (const auto& column : tables[table_of(*search, "front")].columns) {
    names.push_back(column.name);
  }
  EXPECT_THAT(names, ElementsAre("generation", "individual", "crowding", "objective_Larva",
                                 "objective_larva_1", "objective_crowding"));
}

// Objectives 4 less the squared distance of the three weights to (1, 0, 0) and to (-1, 0, 0): the
// true front is the segment between both, where f_1 = 4 - x^2 and f_2 = 4 - (2 - x)^2 for x from 0
// to 2, and the area below it is the integral of f_2 d f_1, 40/3.
TEST(Nsga2, ConvergesToTheTrueFront) {
  SearchSetup setup = two_axes("nsga2", 60);
  setup.shape = free_shape(2, 1);
  setup.neat.hidden_nodes = 0;
  setup.neat.add_link = setup.neat.add_node = setup.neat.remove_link = 0;
  const double area = 40.0 / 3;
  for (const std::uint64_t seed : {1u, 2u}) {
    setup.problem.seed = seed;
    const auto search = make_search(setup);
    double first = 0, last = 0;
    for (int g = 0; g < 60; ++g) {
      const Asked asked = search->ask();
      std::vector<Evaluation> evaluations;
      for (const Genome& genome : asked.genomes) {
        ASSERT_EQ(genome.links.size(), 3u);
        double rest = 0;
        for (std::size_t l = 1; l < 3; ++l) rest += genome.links[l].weight * genome.links[l].weight;
        const double w = genome.links[0].weight;
        evaluations.push_back({{std::max(0.0, 4 - (w - 1) * (w - 1) - rest),
                                std::max(0.0, 4 - (w + 1) * (w + 1) - rest)},
                               {},
                               1});
      }
      const Told told = search->tell(evaluations);
      const double now = real(told.rows[table_of(*search, "fronts")][0], 3);
      EXPECT_LE(now, area);
      if (g == 0) first = now;
      last = now;
    }
    EXPECT_LT(first, 0.95 * area);
    EXPECT_GT(last, 0.98 * area);
  }
}

/// Mean distance to the k nearest that are fitter, by sorting all.
double plain_distance_to_fitter(const std::vector<Placed>& all, std::size_t q, int k) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool same = all[i].quality == all[q].quality;
    if (all[i].quality < all[q].quality || (same && i >= q)) continue;
    double square = 0;
    for (std::size_t d = 0; d < all[i].position.size(); ++d) {
      square += std::pow(all[i].position[d] - all[q].position[d], 2);
    }
    distances.push_back(std::sqrt(square));
  }
  if (distances.empty()) return std::numeric_limits<double>::infinity();
  std::sort(distances.begin(), distances.end());
  if (distances.size() > static_cast<std::size_t>(k)) distances.resize(static_cast<std::size_t>(k));
  double sum = 0;
  for (const double distance : distances) sum += distance;
  return sum / static_cast<double>(distances.size());
}

TEST(DistancesToFitter, ByHand) {
  const std::vector<Placed> all = {
      {1, {0, 0}, 5}, {2, {3, 4}, 4}, {3, {3, 4}, 4}, {4, {0, 1}, 3}, {5, {9, 9}, 5}};
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> one = distances_to_fitter(all, 1, 1);
  // The third is the second's copy, the fifth equals the first and comes later.
  EXPECT_THAT(one, ElementsAre(infinity, 5, 0, 1, std::hypot(9, 9)));
  EXPECT_EQ(distances_to_fitter(all, 2, 1)[3], (1 + std::hypot(3, 3)) / 2);
}

TEST(Dns, KeepsThoseFarFromAllWhoAreFitter) {
  SearchSetup setup = two_axes("dns");
  setup.settings.values["fitter_neighbours"] = 2;
  const std::vector<Axis> axes = axes_of(setup);
  const auto expected = [&](const std::vector<One>& pool) {
    std::vector<Placed> all;
    for (const One& one : pool) {
      const std::vector<double> position = position_on(axes, one.evaluation);
      if (!position.empty()) all.push_back({one.id, position, geometric_mean(one.evaluation)});
    }
    std::map<std::int64_t, double> fitness;
    for (std::size_t i = 0; i < all.size(); ++i) {
      fitness[all[i].id] = plain_distance_to_fitter(all, i, 2);
    }
    Verdict verdict;
    for (std::size_t p = 0; p < pool.size(); ++p) {
      verdict.first.push_back(p);
      const auto found = fitness.find(pool[p].id);
      if (found == fitness.end()) fitness[pool[p].id] = -1;
      const double c = fitness[pool[p].id];
      verdict.second.push_back(c < 0 ? 0 : std::isinf(c) ? 1 : c / (1 + c));
    }
    std::stable_sort(verdict.first.begin(), verdict.first.end(), [&](std::size_t a, std::size_t b) {
      return fitness[pool[a].id] > fitness[pool[b].id];
    });
    return verdict;
  };
  double last_best = 0;
  follow(setup, 15, expected,
         [&](const Search& search, const Told& told, const std::vector<One>& pool) {
           // What the pool would be worth as a map of 4 x 5 niches; the best never dies.
           const Niches niches = Niches::grid({4, 5});
           std::map<int, double> best;
           for (const One& one : pool) {
             const std::vector<double> position = position_on(axes, one.evaluation);
             if (position.empty()) continue;
             double& here = best[niches.niche_of(position)];
             here = std::max(here, geometric_mean(one.evaluation));
           }
           double score = 0, top = 0;
           for (const auto& [niche, quality] : best) {
             score += quality;
             top = std::max(top, quality);
           }
           const Row& worth = told.rows[table_of(search, "qd")][0];
           EXPECT_EQ(integer(worth, 1), static_cast<std::int64_t>(best.size()));
           EXPECT_NEAR(real(worth, 4), score, 1e-13 * score);
           EXPECT_GE(top, last_best);
           last_best = top;
         });
}

/// Among all but itself: mean distance of the k nearest and how many are worse, by sorting all.
std::pair<double, int> plain_neighbourhood(const std::vector<Placed>& all, std::size_t q, int k) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].id == all[q].id) continue;
    double square = 0;
    for (std::size_t d = 0; d < all[i].position.size(); ++d) {
      const double difference = all[i].position[d] - all[q].position[d];
      square += difference * difference;
    }
    near.emplace_back(square, i);
  }
  std::sort(near.begin(), near.end());
  if (near.size() > static_cast<std::size_t>(k)) near.resize(static_cast<std::size_t>(k));
  double sum = 0;
  int worse = 0;
  for (const auto& [square, i] : near) {
    sum += std::sqrt(square);
    worse += all[i].quality < all[q].quality ? 1 : 0;
  }
  return {near.empty() ? 0 : sum / static_cast<double>(near.size()), worse};
}

TEST(Neighbourhoods, ByHand) {
  const std::vector<Placed> all = {{1, {0}, 5}, {2, {1}, 4}, {3, {3}, 6},
                                   {4, {7}, 5}, {1, {0}, 5}, {9, {-1}, 1}};
  const std::vector<Neighbourhood> two = neighbourhoods(all, 4, 2, 1);
  ASSERT_EQ(two.size(), 4u);
  EXPECT_EQ(two[0].novelty, 1);  // 1 and -1; the entry of its own does not count
  EXPECT_EQ(two[0].worse, 2);
  EXPECT_EQ(two[1].novelty, 1);  // both of the first, 1 away
  EXPECT_EQ(two[1].worse, 0);
  EXPECT_EQ(two[2].novelty, 2.5);  // 1, and the first of those at 0
  EXPECT_EQ(two[2].worse, 2);
  EXPECT_EQ(two[3].novelty, 5);
  EXPECT_EQ(two[3].worse, 1);
  EXPECT_EQ(neighbourhoods(std::vector<Placed>{{1, {0}, 5}}, 1, 3, 1)[0].novelty, 0);
}

TEST(Nslc, KeepsTheNewAndTheLocallyBest) {
  const SearchSetup setup = two_axes("nslc");
  const std::vector<Axis> axes = axes_of(setup);
  std::vector<Placed> archive;
  std::size_t behaving = 0;
  const auto expected = [&](const std::vector<One>& pool) {
    std::vector<Placed> all;
    for (const One& one : pool) {
      const std::vector<double> position = position_on(axes, one.evaluation);
      if (!position.empty()) all.push_back({one.id, position, geometric_mean(one.evaluation)});
    }
    behaving = all.size();
    all.insert(all.end(), archive.begin(), archive.end());
    std::vector<std::vector<double>> points;
    std::size_t next = 0;
    for (const One& one : pool) {
      if (one.evaluation.descriptors.empty()) {
        points.push_back({-1, -1});
        continue;
      }
      const auto [novelty, worse] = plain_neighbourhood(all, next++, 4);
      points.push_back({novelty, static_cast<double>(worse)});
    }
    const Ranking ranking = rank(points);
    Verdict verdict{ranking.order, {}};
    for (std::size_t p = 0; p < pool.size(); ++p) {
      verdict.second.push_back(points[p][0] < 0 ? 0 : 1.0 / (1 + ranking.front[p]));
    }
    return verdict;
  };
  follow(setup, 15, expected, [&](const Search& search, const Told& told, const std::vector<One>&) {
    const std::vector<Row>& added = told.rows[table_of(search, "archive")];
    EXPECT_EQ(added.size(), 5u);
    std::set<std::int64_t> different;
    for (const Row& row : added) {
      EXPECT_EQ(integer(row, 0), static_cast<std::int64_t>(archive.size()));
      // Of this generation, each once.
      EXPECT_TRUE(different.insert(integer(row, 1)).second);
      EXPECT_GE(integer(row, 1), integer(row, 2) * 30);
      EXPECT_LT(integer(row, 1), integer(row, 2) * 30 + 30);
      archive.push_back(
          {integer(row, 1),
           nlohmann::json::parse(std::get<std::string>(row[4])).get<std::vector<double>>(),
           real(row, 3)});
    }
  });
  EXPECT_GT(behaving, 10u);
}

// Whoever fails stands behind all others, and still there are always enough parents.
TEST(Pool, OfFailuresGoesOn) {
  for (const std::string kind : {"nslc", "dns", "nsga2"}) {
    const auto search = make_search(two_axes(kind));
    const std::vector<Evaluation> failed(30, Evaluation{{0, 0}, {}, 1});
    for (int g = 0; g < 3; ++g) {
      const Told told = search->tell(failed);
      EXPECT_EQ(living(*search, told).size(), 30u);
      // Of equals the eldest stay.
      EXPECT_EQ(living(*search, told).back(), 29);
    }
    std::vector<Evaluation> better = failed;
    better[17] = {{1, 1}, {0, 0, 0}, 1};
    const std::int64_t who = search->ask().lineage[17].id;
    EXPECT_EQ(living(*search, search->tell(better)).front(), who);
  }
}

TEST(Pool, RefusesWhatDoesNotFitTheProblem) {
  for (const std::string kind : {"map-elites", "nslc", "dns", "nsga2"}) {
    const auto search = make_search(two_axes(kind));
    EXPECT_THROW(search->tell(std::vector<Evaluation>(29, {{1, 1}, {}, 1})), std::invalid_argument);
    EXPECT_THROW(search->tell(std::vector<Evaluation>(30, {{1}, {}, 1})), std::invalid_argument);
    EXPECT_THROW(search->tell(std::vector<Evaluation>(30, {{1, 1}, {1}, 1})),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace metamorph::evolve
