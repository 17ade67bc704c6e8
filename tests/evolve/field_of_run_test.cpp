// The map of a run of map-elites, the fronts of a run of nsga2, as pictures.

#include "evolve/study/field_of_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "evolve/search/axes.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::lines_of;
using tests::run_whole;
using tests::TemporaryDirectory;
using tests::tiny_experiment;
using tests::tiny_newt;

Experiment along(const std::string& kind, std::vector<std::string> axes) {
  Experiment e = tiny_experiment(kind, 4);
  e.search.values["axis_low"] = std::vector<double>(axes.size(), -1);
  e.search.values["axis_high"] = std::vector<double>(axes.size(), 1);
  e.search.values["axes"] = std::move(axes);
  return e;
}

/// [niche] Where its last elite stands, by the descriptors in the record.
std::map<int, Point> elites_of(const RunReader& run) {
  const std::vector<Axis> axes = axes_of(search_setup_of(run.experiment(), 1));
  std::map<int, std::pair<int, Point>> last;
  run.read("elites", "generation, niche, descriptors", [&](const TableRow& row) {
    const auto numbers = nlohmann::json::parse(row.text(2)).get<std::vector<double>>();
    auto& [generation, point] = last[row.integer(1)];
    if (row.integer(0) < generation) return;
    generation = row.integer(0);
    point = {numbers[axes[0].descriptor], numbers[axes[1].descriptor]};
  });
  std::map<int, Point> elites;
  for (const auto& [niche, elite] : last) elites[niche] = elite.second;
  return elites;
}

TEST(MapOfRun, HasTheTileOfEveryEliteWhereItStands) {
  const TemporaryDirectory directory;
  Experiment e = along("map-elites", {"larva.x", "adult.x"});
  e.search.values["bins"] = std::vector<double>{5, 8};
  run_whole(directory.path() / "run", e);
  const RunReader run(directory.path() / "run");
  const Field field = map_of(run);
  const std::map<int, Point> elites = elites_of(run);
  ASSERT_GT(elites.size(), 2u);
  ASSERT_EQ(field.tiles.size(), elites.size());
  std::size_t t = 0;
  for (const auto& [niche, where] : elites) {
    const Field::Tile& tile = field.tiles[t++];
    EXPECT_NEAR(tile.right - tile.left, 2.0 / 5, 1e-12);
    EXPECT_NEAR(tile.top - tile.bottom, 2.0 / 8, 1e-12);
    // Whoever is beyond an end stands in the niche at that end.
    EXPECT_NEAR(std::clamp(where.x, -1.0, 1.0), (tile.left + tile.right) / 2, 1.0 / 5 + 1e-12);
    EXPECT_NEAR(std::clamp(where.y, -1.0, 1.0), (tile.bottom + tile.top) / 2, 1.0 / 8 + 1e-12);
  }
}

TEST(MapOfRun, WithoutAGridHasAPointForEveryEliteAtTheCentreThatIsNearest) {
  const TemporaryDirectory directory;
  Experiment e = along("map-elites", {"larva.x", "adult.x"});
  e.search.values["niches"] = 30;
  run_whole(directory.path() / "run", e);
  const RunReader run(directory.path() / "run");
  const Field field = map_of(run);
  const std::map<int, Point> elites = elites_of(run);
  ASSERT_EQ(field.points.size(), elites.size());
  const auto distance = [](Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); };
  std::size_t own = 0;
  for (const auto& [niche, where] : elites) {
    ASSERT_EQ(field.points[own].points.size(), 1u);
    const double to_own = distance(where, field.points[own].points[0]);
    for (const Field::Points& other : field.points) {
      EXPECT_LE(to_own, distance(where, other.points[0]) + 1e-12);
    }
    ++own;
  }
}

TEST(MapOfRun, NeedsElitesAndTwoAxes) {
  const TemporaryDirectory directory;
  run_whole(directory.path() / "one", along("map-elites", {"adult.x"}));
  run_whole(directory.path() / "simple", tiny_experiment("simple", 1));
  EXPECT_THAT(lines_of([&] { map_of(RunReader(directory.path() / "one")); }),
              ElementsAre(HasSubstr("search.axes: 1 of them: expected two")));
  EXPECT_THAT(lines_of([&] { map_of(RunReader(directory.path() / "simple")); }),
              ElementsAre(HasSubstr("expected a run of map-elites")));
}

TEST(FrontOfRun, HasThoseOfSixGenerationsWhomNobodyDominates) {
  const TemporaryDirectory directory;
  run_whole(directory.path() / "run", tiny_experiment("nsga2", 9));
  const RunReader run(directory.path() / "run");
  const Field field = front_of(run);
  EXPECT_EQ(field.remark, "generations 0, 1, 3, 4, 6, 8");
  ASSERT_EQ(field.points.size(), 6u);
  std::vector<Point> last;
  run.read("front", "generation, objective_larva, objective_adult", [&](const TableRow& row) {
    if (row.integer(0) == 8) last.push_back({row.number(1), row.number(2)});
  });
  ASSERT_EQ(field.points.back().points.size(), last.size());
  for (const Field::Points& front : field.points) {
    EXPECT_TRUE(front.steps);
    for (const Point& a : front.points) {
      EXPECT_LT(a.x, field.high.x);
      EXPECT_LT(a.y, field.high.y);
      for (const Point& b : front.points) {
        EXPECT_FALSE(a.x >= b.x && a.y >= b.y && (a.x > b.x || a.y > b.y));
      }
    }
  }
}

TEST(FrontOfRun, IsDrawnToTheSameBytes) {
  const TemporaryDirectory directory;
  run_whole(directory.path() / "run", tiny_experiment("nsga2", 1));
  const Field field = front_of(RunReader(directory.path() / "run"));
  const std::string picture = draw_field(field, "front.svg", 2);
  EXPECT_THAT(picture, HasSubstr("</svg>"));
  EXPECT_EQ(draw_field(field, "front.svg", 2), picture);
}

TEST(FrontOfRun, NeedsFrontsAndTwoTrials) {
  const TemporaryDirectory directory;
  run_whole(directory.path() / "newt", tiny_newt("nsga2", 1));
  run_whole(directory.path() / "simple", tiny_experiment("simple", 1));
  EXPECT_THAT(lines_of([&] { front_of(RunReader(directory.path() / "newt")); }),
              ElementsAre(HasSubstr("3 trials: expected two")));
  EXPECT_THAT(lines_of([&] { front_of(RunReader(directory.path() / "simple")); }),
              ElementsAre(HasSubstr("expected a run of nsga2")));
}

}  // namespace
}  // namespace metamorph::evolve
