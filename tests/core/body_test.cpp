#include "metamorph/body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "tests/bodies.h"

namespace metamorph::core {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<Body> sample_bodies() {
  std::vector<Body> bodies = {tests::triangle_body(), tests::hexagon_body(),
                              tests::strip_body(5),   tests::strip_body(24),
                              tests::disc_body(61),   tests::ring_body(2, 5)};
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    bodies.push_back(tests::blob_body(24 + 29 * static_cast<int>(seed), seed));
  }
  return bodies;
}

/// Twice the area within directed edges: the shoelace formula.
double enclosed_area(const Body& body, const std::vector<std::array<Index, 2>>& edges) {
  double sum = 0;
  for (const auto& [a, b] : edges) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    sum += body.x[i] * body.y[j] - body.x[j] * body.y[i];
  }
  return sum / 2;
}

std::vector<std::string> texts(const std::vector<BodyFault>& faults) {
  std::vector<std::string> result;
  for (const BodyFault& fault : faults) result.push_back(fault.what);
  return result;
}

TEST(Body, BuildersGiveSoundBodies) {
  for (const Body& body : sample_bodies()) EXPECT_THAT(texts(check(body)), IsEmpty());
  EXPECT_EQ(tests::hexagon_body().node_count(), 7);
  EXPECT_EQ(tests::strip_body(24).triangles.size(), 22u);
  EXPECT_EQ(tests::disc_body(61).node_count(), 61);
  EXPECT_EQ(tests::blob_body(256, 3).node_count(), 256);
}

TEST(Body, EdgesOfOneTriangleAndOfASquare) {
  EXPECT_THAT(edges_of({{2, 0, 1}}),
              ElementsAre(std::array<Index, 2>{0, 1}, std::array<Index, 2>{0, 2},
                          std::array<Index, 2>{1, 2}));
  EXPECT_EQ(edges_of({{0, 1, 2}, {0, 2, 3}}).size(), 5u);
  EXPECT_THAT(edges_of({}), IsEmpty());
}

TEST(Body, EdgesAreAscendingAndDistinct) {
  for (const Body& body : sample_bodies()) {
    std::set<std::array<Index, 2>> expected;
    for (const auto& t : body.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        expected.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
      }
    }
    EXPECT_EQ(edges_of(body.triangles), std::vector(expected.begin(), expected.end()));
  }
}

TEST(Body, OutlineRunsWithTheBodyOnItsLeft) {
  for (const Body& body : sample_bodies()) {
    const auto outline = outline_of(body.triangles);
    EXPECT_TRUE(std::is_sorted(outline.begin(), outline.end()));
    // Each edge is a side of exactly one triangle, in the triangle's direction.
    for (const auto& edge : outline) {
      int same = 0, opposite = 0;
      for (const auto& t : body.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
          same += t[k] == edge[0] && t[(k + 1) % 3] == edge[1];
          opposite += t[k] == edge[1] && t[(k + 1) % 3] == edge[0];
        }
      }
      EXPECT_EQ(same, 1);
      EXPECT_EQ(opposite, 0);
    }
    std::map<Index, int> balance;
    for (const auto& [a, b] : outline) {
      ++balance[a];
      --balance[b];
    }
    for (const auto& [node, difference] : balance) EXPECT_EQ(difference, 0) << node;
    // Sides: 3 F = 2 E - outline.
    EXPECT_EQ(3 * body.triangles.size(), 2 * body.springs.size() - outline.size());
  }
}

TEST(Body, AreasSumToTheAreaWithinTheOutline) {
  for (const Body& body : sample_bodies()) {
    double sum = 0;
    for (const double area : body.rest_area) sum += area;
    // Round-off of some hundred terms of size <= 400.
    EXPECT_NEAR(sum, enclosed_area(body, outline_of(body.triangles)), 1e-11);
  }
}

TEST(Body, EulerCharacteristicCountsHoles) {
  const auto euler = [](const Body& body) {
    return body.node_count() - static_cast<Index>(body.springs.size()) +
           static_cast<Index>(body.triangles.size());
  };
  EXPECT_EQ(euler(tests::ring_body(2, 5)), 0);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(euler(tests::blob_body(100, seed)), 1);
  }
}

TEST(Body, RestValuesOfTheUnitLattice) {
  const Body body = tests::disc_body(19);
  for (const double length : body.rest_length) EXPECT_NEAR(length, 1, 1e-15);
  for (const double area : body.rest_area) EXPECT_NEAR(area, std::numbers::sqrt3 / 4, 1e-15);
}

TEST(CheckBody, NamesEverySizeThatIsWrong) {
  Body body = tests::hexagon_body();
  body.y.pop_back();
  body.period.pop_back();
  body.phase.push_back(0);
  body.cell = {1};
  body.rest_length.clear();
  body.rest_area.push_back(1);
  EXPECT_THAT(texts(check(body)), ElementsAre("y: 6 values: expected 7, one per node",
                                              "period: 6 values: expected 7, one per node",
                                              "phase: 8 values: expected 7, one per node",
                                              "cell: 1 values: expected 7, one per node",
                                              "rest_length: 0 values: expected 12, one per spring",
                                              "rest_area: 7 values: expected 6, one per triangle"));
}

TEST(CheckBody, AnEmptyBodyIsAFault) {
  EXPECT_THAT(texts(check(Body{})),
              ElementsAre("nodes: 0: expected at least 3", "triangles: 0: expected at least 1"));
}

TEST(CheckBody, NamesEveryValueThatIsWrong) {
  Body body = tests::triangle_body();
  body.period = {0, -1, std::numeric_limits<double>::infinity()};
  body.phase[1] = std::numeric_limits<double>::quiet_NaN();
  body.rest_length[2] = 1e-4;
  body.rest_area[0] = 5e-4;
  const auto faults = check(body);
  EXPECT_THAT(texts(faults), ElementsAre("period[0]: 0: expected a finite number >= 0.001",
                                         "period[1]: -1: expected a finite number >= 0.001",
                                         "phase[1]: nan: expected a finite number",
                                         "period[2]: inf: expected a finite number >= 0.001",
                                         "rest_length[2]: 1e-04: expected at least 0.001",
                                         "rest_area[0]: 5e-04: expected at least 0.001"));
  EXPECT_EQ(faults.front().status, Status::bad_input);
  EXPECT_EQ(faults.back().status, Status::bad_geometry);
}

TEST(CheckBody, IndicesMustBeNodesAndDiffer) {
  Body body = tests::triangle_body();
  body.triangles[0] = {0, 1, 3};
  body.springs[1] = {-1, 2};
  EXPECT_THAT(texts(check(body)),
              ElementsAre("triangles[0]: [0, 1, 3]: expected node numbers from 0 to 2",
                          "springs[1]: [-1, 2]: expected node numbers from 0 to 2"));
  body = tests::triangle_body();
  body.triangles[0] = {0, 1, 1};
  const auto faults = check(body);
  EXPECT_THAT(texts(faults), ElementsAre("triangles[0]: [0, 1, 1]: expected different nodes"));
  EXPECT_EQ(faults[0].status, Status::bad_topology);
}

TEST(CheckBody, NonFiniteNodesAreBadInputAndNothingElse) {
  Body body = tests::triangle_body();
  body.x[1] = std::numeric_limits<double>::quiet_NaN();
  const auto faults = check(body);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].status, Status::bad_input);
  EXPECT_EQ(faults[0].what, "nodes[1]: [nan, 0.8660254037844386]: expected finite numbers");
}

TEST(CheckBody, NodesFarAwayAreBadInputAndNothingElse) {
  Body body = tests::triangle_body();
  for (double& x : body.x) x += 1e6 - 1;
  EXPECT_THAT(texts(check(body)), IsEmpty());
  body.x[1] = 1000000.5;
  body.y[2] = -1e300;
  const auto faults = check(body);
  EXPECT_THAT(texts(faults),
              ElementsAre(HasSubstr("nodes[1]: [1000000.5, "),
                          HasSubstr(", -1e+300]: expected within 1e6 of the origin")));
  EXPECT_EQ(status_of(faults), Status::bad_input);
}

TEST(CheckBody, APeriodHasALeastValue) {
  Body body = tests::triangle_body();
  body.period = {1e-3, 9e-4, 40};
  EXPECT_THAT(texts(check(body)),
              ElementsAre("period[1]: 9e-04: expected a finite number >= 0.001"));
}

TEST(CheckBody, CoincidentNodesAreBadGeometry) {
  Body body = tests::hexagon_body();
  body.x[1] = body.x[0] + 5e-4;
  body.y[1] = body.y[0];
  const auto faults = check(body);
  ASSERT_FALSE(faults.empty());
  EXPECT_THAT(faults[0].what, HasSubstr("nodes[1]: "));
  EXPECT_THAT(faults[0].what, HasSubstr("expected at least 0.001 from node 0"));
  EXPECT_EQ(faults[0].status, Status::bad_geometry);
}

TEST(CheckBody, ClockwiseAndFlatTrianglesAreBadGeometry) {
  Body body = tests::triangle_body();
  std::swap(body.triangles[0][1], body.triangles[0][2]);
  auto faults = check(body);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].status, Status::bad_geometry);
  EXPECT_THAT(faults[0].what, HasSubstr("triangles[0]: [0, 1, 2] with area -0.43"));

  body = tests::triangle_body();
  body.x = {0, 1, 2};
  body.y = {0, 0, 0};
  set_rest_from_nodes(body);
  faults = check(body);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].status, Status::bad_geometry);
}

TEST(CheckBody, AnIsolatedNodeIsBadTopology) {
  Body body = tests::triangle_body();
  body.x.push_back(5);
  body.y.push_back(5);
  body.period.push_back(40);
  body.phase.push_back(0);
  const auto faults = check(body);
  EXPECT_THAT(texts(faults), ElementsAre("nodes[3]: isolated: expected a triangle that has it"));
  EXPECT_EQ(faults[0].status, Status::bad_topology);
}

TEST(CheckBody, TwoTrianglesThatShareANodeOnlyAreTwoParts) {
  Body body;
  body.x = {0, 1, 0, -1, 0};
  body.y = {0, 0, 1, 0, -1};
  body.period.assign(5, 40);
  body.phase.assign(5, 0);
  body.triangles = {{0, 1, 2}, {0, 3, 4}};
  set_rest_from_nodes(body);
  const auto faults = check(body);
  EXPECT_THAT(texts(faults),
              ElementsAre("triangles[1]: in the second of 2 parts that share no edge: expected one "
                          "edge-connected part"));
  EXPECT_EQ(faults[0].status, Status::bad_topology);
}

TEST(CheckBody, NothingFitsBesideAClosedFan) {
  Body body = tests::hexagon_body();
  const Index centre = 3;  // by u, then v
  ASSERT_EQ(body.x[3], 0);
  ASSERT_EQ(body.y[3], 0);
  // A triangle on two new nodes close to the centre, within those that lie around it.
  body.x.insert(body.x.end(), {0.4, 0.1});
  body.y.insert(body.y.end(), {0.1, 0.4});
  body.period.insert(body.period.end(), 2, 40);
  body.phase.insert(body.phase.end(), 2, 0);
  body.triangles.push_back({centre, 7, 8});
  set_rest_from_nodes(body);
  EXPECT_THAT(texts(check(body)),
              testing::Contains("nodes[3]: 2 fans of triangles around it, 1 of them closed: "
                                "expected one closed fan, or open ones only"));
  EXPECT_EQ(status_of(check(body)), Status::bad_topology);
}

TEST(CheckBody, OverlappingTrianglesAreBadTopology) {
  Body body;
  body.x = {0, 1, 0, 0.2};
  body.y = {0, 0, 1, 2};
  body.period.assign(4, 40);
  body.phase.assign(4, 0);
  body.triangles = {{0, 1, 2}, {0, 1, 3}};
  set_rest_from_nodes(body);
  EXPECT_THAT(texts(check(body)), ElementsAre("edge [0, 1]: triangles 0 and 1 lie on one side of "
                                              "it: expected one on either side"));
  body.triangles.push_back({0, 1, 2});
  set_rest_from_nodes(body);
  EXPECT_THAT(texts(check(body)),
              ::testing::Contains("edge [0, 1]: 3 triangles: expected at most 2"));
}

TEST(CheckBody, SpringsMustBeTheEdges) {
  Body body = tests::strip_body(4);
  const auto edges = body.springs;
  ASSERT_EQ(edges.size(), 5u);
  std::array<Index, 2> diagonal{};  // the one pair that is no edge
  for (Index a = 0; a < 4; ++a) {
    for (Index b = a + 1; b < 4; ++b) {
      if (std::find(edges.begin(), edges.end(), std::array{a, b}) == edges.end()) diagonal = {a, b};
    }
  }
  body.springs[0] = diagonal;
  EXPECT_THAT(texts(check(body)),
              ElementsAre(HasSubstr("expected the edge of a triangle, lower node first"),
                          "springs: no [0, 1]: expected every edge of a triangle"));
  body.springs = edges;
  std::swap(body.springs[0], body.springs[1]);
  EXPECT_THAT(
      texts(check(body)),
      ElementsAre("springs: out of order or repeated: expected every edge once, ascending"));
}

RC_GTEST_PROP(CheckBody, DamagedBodiesAreNamedAndNeverCrash, ()) {
  Body body = tests::blob_body(24, *rc::gen::inRange<std::uint64_t>(0, 50));
  const auto pick = [](std::size_t size) { return *rc::gen::inRange<std::size_t>(0, size); };
  const int damages = *rc::gen::inRange(1, 4);
  for (int d = 0; d < damages; ++d) {
    switch (*rc::gen::inRange(0, 5)) {
      case 0:
        body.triangles[pick(body.triangles.size())][pick(3)] = *rc::gen::inRange(24, 1000);
        break;
      case 1:
        body.period[pick(body.period.size())] = -*rc::gen::inRange(0, 100);
        break;
      case 2:
        body.x[pick(body.x.size())] = std::numeric_limits<double>::infinity();
        break;
      case 3:
        body.springs[pick(body.springs.size())][pick(2)] = -*rc::gen::inRange(1, 100);
        break;
      default:
        body.rest_area.push_back(1);
    }
  }
  const auto faults = check(body);
  RC_ASSERT(!faults.empty());
  for (const BodyFault& fault : faults) {
    RC_ASSERT(is_failure(fault.status));
    RC_ASSERT(fault.what.find(": expected ") != std::string::npos);
  }
}

}  // namespace
}  // namespace metamorph::core
