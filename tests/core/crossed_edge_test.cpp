#include "core/locomotion/crossed_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/body/outline_crossing.h"
#include "core/body/predicates.h"
#include "core/locomotion/segment_distance.h"
#include "metamorph/body.h"
#include "tests/bodies.h"

namespace metamorph::tests {
namespace {

using core::Index;

/// The jaws with the upper one moved down.
struct Jaws {
  explicit Jaws(double down) : body(jaws_body()), x(body.x), y(body.y) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i] > 2.5 && y[i] > 3) y[i] -= down;
  }
  /// Two edges have a point in common, none of them on the line of the other.
  bool meet(const std::array<Index, 2>& e, const std::array<Index, 2>& f) const {
    const auto at = [&](Index node) {
      return core::Point{x[static_cast<std::size_t>(node)], y[static_cast<std::size_t>(node)]};
    };
    const auto sides = [&](const auto& g, const auto& h) {
      return core::exact_orientation(at(g[0]), at(g[1]), at(h[0])) *
             core::exact_orientation(at(g[0]), at(g[1]), at(h[1]));
    };
    return sides(e, f) < 0 && sides(f, e) < 0;
  }

  core::Body body;
  std::vector<double> x, y;
};

TEST(CrossedEdge, NothingWhereTheOutlineIsWhole) {
  for (const core::Body& body : {jaws_body(), ring_body(2, 4), pinched_body(), blob_body(40, 1)})
    EXPECT_FALSE(core::crossed_edge(body, body.x, body.y).has_value());
  const Jaws open(3);
  EXPECT_FALSE(core::crossed_edge(open.body, open.x, open.y).has_value());
}

TEST(CrossedEdge, IsOneThatMeetsAnotherAndNamesTheNearestOfTheirEnds) {
  int crossed = 0;
  for (double down = 3; down < 7; down += 0.0625 + 1e-3) {
    const Jaws jaws(down);
    const auto outline = core::outline_of(jaws.body.triangles);
    const auto found = core::crossed_edge(jaws.body, jaws.x, jaws.y);
    ASSERT_EQ(found.has_value(), core::first_crossing(jaws.x, jaws.y, outline).has_value());
    if (!found) continue;
    ++crossed;
    // Every end of two edges that meet and its distance from the other: the node told is the
    // nearest of those of some such two, of which the spring is one.
    const auto& spring = jaws.body.springs[static_cast<std::size_t>(found->spring)];
    bool told = false;
    for (const auto& e : outline) {
      if (std::minmax(e[0], e[1]) != std::minmax(spring[0], spring[1])) continue;
      for (const auto& f : outline) {
        if ((f[0] != found->node && f[1] != found->node) || !jaws.meet(e, f)) continue;
        const double distance = core::distance_from_edge(jaws.x, jaws.y, found->node, e);
        double least = distance;
        for (const Index node : f)
          least = std::min(least, core::distance_from_edge(jaws.x, jaws.y, node, e));
        for (const Index node : e)
          least = std::min(least, core::distance_from_edge(jaws.x, jaws.y, node, f));
        told = told || distance == least;
      }
    }
    EXPECT_TRUE(told) << "down " << down << ", spring " << found->spring << ", node "
                      << found->node;
  }
  EXPECT_GT(crossed, 10);
}

}  // namespace
}  // namespace metamorph::tests
