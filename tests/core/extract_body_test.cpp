#include "metamorph/extraction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>
#include <set>

#include "tests/bodies.h"
#include "tests/embryos.h"

namespace metamorph::core {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Seven points: a centre and six neighbours at distance 1.
std::vector<tests::Point> hexagon_at(double x, double y) {
  std::vector<tests::Point> points = {{x, y}};
  for (const auto& [u, v] : tests::lattice_neighbours({0, 0})) {
    points.emplace_back(x + u + 0.5 * v, y + 0.5 * std::numbers::sqrt3 * v);
  }
  return points;
}

std::vector<tests::Point> joined(std::vector<tests::Point> a, const std::vector<tests::Point>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// What every extracted body must be: sound, without holes or pinches, and of the embryo's cells.
void expect_proper(const Extraction& extraction, const Embryo& embryo) {
  ASSERT_EQ(extraction.status, Status::ok);
  const Body& body = extraction.body;
  EXPECT_THAT(check(body), IsEmpty());
  ASSERT_EQ(body.cell.size(), body.x.size());
  EXPECT_TRUE(std::is_sorted(body.cell.begin(), body.cell.end()));
  for (std::size_t i = 0; i < body.cell.size(); ++i) {
    const auto cell = static_cast<std::size_t>(body.cell[i]);
    EXPECT_EQ(body.x[i], embryo.x[cell]);
    EXPECT_EQ(body.y[i], embryo.y[cell]);
    EXPECT_EQ(body.period[i], embryo.period[cell]);
    EXPECT_EQ(body.phase[i], embryo.phase[cell]);
  }
  EXPECT_EQ(body.node_count() - static_cast<Index>(body.springs.size()) +
                static_cast<Index>(body.triangles.size()),
            1);
  std::set<Index> seen;
  for (const auto& edge : outline_of(body.triangles)) EXPECT_TRUE(seen.insert(edge[0]).second);
}

TEST(ExtractBody, NoCellIsEmpty) {
  EXPECT_EQ(extract_body(Embryo{}).status, Status::empty);
  EXPECT_EQ(extract_body(Embryo{}, 0).status, Status::empty);
  Embryo failed;
  failed.status = Status::bad_development;
  EXPECT_EQ(extract_body(failed).status, Status::bad_development);
}

TEST(ExtractBody, CellsWithoutTrianglesAreNoBody) {
  const std::vector<tests::Point> row = {{0, 0}, {1, 0}, {2, 0},   {3, 0}, {4, 0},
                                         {5, 0}, {6, 0}, {7.2, 0}, {8, 0}, {9, 0}};
  for (std::size_t n = 1; n <= row.size(); ++n) {
    const Embryo embryo = tests::embryo_at({row.begin(), row.begin() + static_cast<long>(n)});
    EXPECT_EQ(embryo.links.size(), n - 1);
    EXPECT_EQ(extract_body(embryo).status, Status::no_body);
    EXPECT_EQ(extract_body(embryo, 0).status, Status::no_body);
    EXPECT_THAT(extract_body(embryo).body.x, IsEmpty());
  }
}

TEST(ExtractBody, ASlightlyBentRowIsNoBody) {
  std::vector<tests::Point> row;
  for (int i = 0; i < 10; ++i) row.emplace_back(i, 0.01 * i * i);
  const Embryo embryo = tests::embryo_at(row);
  ASSERT_FALSE(embryo.faces.empty());
  EXPECT_EQ(extract_body(embryo).status, Status::no_body);
}

TEST(ExtractBody, AHexagonIsTakenWhole) {
  const Embryo embryo = tests::embryo_at(tests::jittered(hexagon_at(0, 0)));
  EXPECT_EQ(extract_body(embryo, 8).status, Status::no_body);
  const Extraction extraction = extract_body(embryo, 7);
  expect_proper(extraction, embryo);
  EXPECT_THAT(extraction.body.cell, ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_EQ(extraction.body.triangles.size(), 6u);
  EXPECT_EQ(outline_of(extraction.body.triangles).size(), 6u);
}

TEST(ExtractBody, ADentInTheOutlineStaysOutside) {
  // A hexagon without one of its outer cells: the hull edge over the gap is sqrt(3) > 1.5 long.
  auto points = hexagon_at(0, 0);
  points.erase(points.begin() + 2);
  const Extraction extraction = extract_body(tests::embryo_at(tests::jittered(points)), 3);
  EXPECT_EQ(extraction.body.node_count(), 6);
  EXPECT_EQ(extraction.body.triangles.size(), 4u);
}

TEST(ExtractBody, AProtrusionOfSpringsDropsOut) {
  const auto points = joined(hexagon_at(0, 0), {{2, 0}, {3, 0.01}, {4, 0}});
  const Embryo embryo = tests::embryo_at(tests::jittered(points));
  const Extraction extraction = extract_body(embryo, 7);
  expect_proper(extraction, embryo);
  EXPECT_THAT(extraction.body.cell, ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST(ExtractBody, OfTwoBlobsOnALineTheLargerStays) {
  auto points = joined(hexagon_at(0, 0), {{2, 0}, {3, 0}, {4, 0}});
  points = joined(points, hexagon_at(6, 0));
  const Embryo even = tests::embryo_at(tests::jittered(points));
  EXPECT_THAT(extract_body(even, 7).body.cell, ElementsAre(0, 1, 2, 3, 4, 5, 6));  // a tie

  points.emplace_back(6.5, -std::numbers::sqrt3);  // the second one grows by a cell
  const Embryo uneven = tests::embryo_at(tests::jittered(points));
  const Extraction extraction = extract_body(uneven, 7);
  expect_proper(extraction, uneven);
  EXPECT_EQ(extraction.body.cell.size(), 8u);
  EXPECT_EQ(extraction.body.cell.front(), 10);
}

TEST(ExtractBody, OfTwoBlobsWithACommonCellOneStays) {
  // The shared cell (1, 0) belongs to both hexagons and has index 1: the tie goes to the next.
  auto points = hexagon_at(0, 0);
  for (const auto& [x, y] : hexagon_at(2, 0)) {
    if (x > 1.1) points.emplace_back(x, y);
  }
  ASSERT_EQ(points.size(), 13u);
  // Moved apart in y, the upper and lower gaps beside the common cell are open (links over 1.5 d).
  for (auto& [x, y] : points) {
    if (x > 0.4 && x < 0.6) x -= 0.3;
    if (x > 1.4 && x < 1.6) x += 0.3;
  }
  const Embryo embryo = tests::embryo_at(tests::jittered(points));
  const Extraction extraction = extract_body(embryo, 7);
  expect_proper(extraction, embryo);
  EXPECT_THAT(extraction.body.cell, ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST(ExtractBody, AnEnclosedHoleIsFilled) {
  // A closed chain of 14 cells, radius 2.25 d: no triangle has three links, yet all are inside.
  std::vector<tests::Point> chain;
  for (int i = 0; i < 14; ++i) {
    const double angle = 2 * std::numbers::pi * i / 14;
    chain.emplace_back(2.25 * std::cos(angle), 2.25 * std::sin(angle));
  }
  const Embryo embryo = tests::embryo_at(tests::jittered(chain));
  EXPECT_EQ(embryo.links.size(), 14u);
  const Extraction extraction = extract_body(embryo);
  expect_proper(extraction, embryo);
  EXPECT_EQ(extraction.body.triangles.size(), 12u);
  EXPECT_GT(
      *std::max_element(extraction.body.rest_length.begin(), extraction.body.rest_length.end()),
      2.0);

  // Opened by one cell it encloses nothing.
  chain.erase(chain.begin() + 5);
  EXPECT_EQ(extract_body(tests::embryo_at(tests::jittered(chain))).status, Status::no_body);
}

TEST(ExtractBody, ACellInsideARingBelongsToTheBodyWithoutALinkOfItsOwn) {
  std::vector<tests::Point> points;
  for (int i = 0; i < 14; ++i) {
    const double angle = 2 * std::numbers::pi * i / 14;
    points.emplace_back(2.25 * std::cos(angle), 2.25 * std::sin(angle));
  }
  points.emplace_back(0, 0);
  const Embryo embryo = tests::embryo_at(tests::jittered(points));
  const Extraction extraction = extract_body(embryo);
  expect_proper(extraction, embryo);
  EXPECT_EQ(extraction.body.node_count(), 15);
}

TEST(ExtractBody, TheSmallestBodyIsMinCells) {
  const Body strip = tests::strip_body(8);
  std::vector<tests::Point> points;
  for (std::size_t i = 0; i < strip.x.size(); ++i) points.emplace_back(strip.x[i], strip.y[i]);
  const Embryo embryo = tests::embryo_at(tests::jittered(points));
  EXPECT_EQ(extract_body(embryo, 8).status, Status::ok);
  EXPECT_EQ(extract_body(embryo, 9).status, Status::no_body);
}

/// A hexagonal patch of radius 3 (37 cells, 54 faces) with a random part of its 90 edges linked:
/// extraction looks at nothing but faces and links, and this shows it every topology.
Embryo random_links(std::uint64_t seed, double share) {
  const Body patch = tests::disc_body(37);
  evolve::RandomStream random(evolve::Purpose::test, seed, 1, 0);
  std::vector<std::array<Index, 2>> links;
  for (const auto& edge : patch.springs) {
    if (random.chance(share)) links.push_back(edge);
  }
  std::vector<tests::Point> points;
  for (std::size_t i = 0; i < patch.x.size(); ++i) points.emplace_back(patch.x[i], patch.y[i]);
  return tests::embryo_of(points, patch.triangles, links);
}

using TriangleSet = std::set<std::array<Index, 3>>;

std::array<Index, 3> sorted(std::array<Index, 3> t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// The definition, literally: sets of faces grown until nothing changes.
TriangleSet brute_force(const Embryo& embryo) {
  const auto shared = [](const auto& a, const auto& b) {
    std::vector<Index> common;
    for (const Index i : sorted(a)) {
      if (std::count(b.begin(), b.end(), i)) common.push_back(i);
    }
    return common;
  };
  const auto linked = [&](Index a, Index b) {
    return std::count(embryo.links.begin(), embryo.links.end(),
                      std::array{std::min(a, b), std::max(a, b)}) > 0;
  };
  const std::size_t n = embryo.faces.size();
  std::vector<bool> outside(n, false);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t f = 0; f < n; ++f) {
      if (outside[f]) continue;
      const auto& face = embryo.faces[f];
      for (std::size_t k = 0; k < 3 && !outside[f]; ++k) {
        const Index a = face[k], b = face[(k + 1) % 3];
        if (linked(a, b)) continue;
        bool hull = true;
        for (std::size_t g = 0; g < n; ++g) {
          if (g == f || shared(face, embryo.faces[g]).size() != 2) continue;
          const auto common = shared(face, embryo.faces[g]);
          if (common != std::vector{std::min(a, b), std::max(a, b)}) continue;
          hull = false;
          if (outside[g]) outside[f] = true;
        }
        if (hull) outside[f] = true;
      }
      changed = changed || outside[f];
    }
  }
  std::vector<std::size_t> label(n);
  for (std::size_t f = 0; f < n; ++f) label[f] = f;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t f = 0; f < n; ++f) {
      for (std::size_t g = 0; g < n; ++g) {
        if (outside[f] || outside[g] || label[f] <= label[g]) continue;
        if (shared(embryo.faces[f], embryo.faces[g]).size() < 2) continue;
        label[f] = label[g];
        changed = true;
      }
    }
  }
  TriangleSet best;
  std::set<Index> best_cells;
  for (std::size_t part = 0; part < n; ++part) {
    TriangleSet triangles;
    std::set<Index> cells;
    for (std::size_t f = 0; f < n; ++f) {
      if (outside[f] || label[f] != part) continue;
      triangles.insert(sorted(embryo.faces[f]));
      cells.insert(embryo.faces[f].begin(), embryo.faces[f].end());
    }
    if (cells.size() > best_cells.size() ||
        (cells.size() == best_cells.size() && cells < best_cells)) {
      best = triangles;
      best_cells = cells;
    }
  }
  return best;
}

RC_GTEST_PROP(ExtractBody, AgreesWithTheDefinition, ()) {
  const Embryo embryo = random_links(*rc::gen::inRange<std::uint64_t>(0, 1000000),
                                     0.3 + 0.1 * *rc::gen::inRange(0, 6));
  const Extraction extraction = extract_body(embryo, 3);
  TriangleSet found;
  for (const auto& t : extraction.body.triangles) {
    found.insert(sorted({extraction.body.cell[static_cast<std::size_t>(t[0])],
                         extraction.body.cell[static_cast<std::size_t>(t[1])],
                         extraction.body.cell[static_cast<std::size_t>(t[2])]}));
  }
  RC_ASSERT(found == brute_force(embryo));
  RC_ASSERT((extraction.status == Status::no_body) == found.empty());
  if (!found.empty()) expect_proper(extraction, embryo);
}

RC_GTEST_PROP(ExtractBody, DoesNotDependOnTheOrderOfFaces, ()) {
  Embryo embryo = random_links(*rc::gen::inRange<std::uint64_t>(0, 1000000), 0.6);
  const Body expected = extract_body(embryo, 3).body;
  evolve::RandomStream random(evolve::Purpose::test, *rc::gen::inRange<std::uint64_t>(0, 1000000),
                              2, 0);
  for (std::size_t i = embryo.faces.size(); i > 1; --i) {
    std::swap(embryo.faces[i - 1], embryo.faces[random.below(static_cast<std::uint32_t>(i))]);
  }
  for (auto& face : embryo.faces) {
    std::rotate(face.begin(), face.begin() + random.below(3), face.end());
  }
  const Body body = extract_body(embryo, 3).body;
  RC_ASSERT(body.triangles == expected.triangles);
  RC_ASSERT(body.cell == expected.cell);
  RC_ASSERT(body.springs == expected.springs);
  RC_ASSERT(body.rest_length == expected.rest_length);
  RC_ASSERT(body.rest_area == expected.rest_area);
}

}  // namespace
}  // namespace metamorph::core
