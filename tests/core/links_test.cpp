#include "core/development/links.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "core/development/delaunay.h"

namespace metamorph::core {
namespace {

using Edge = std::array<Index, 2>;
using Edges = std::vector<Edge>;

Edges selected(const std::vector<double>& x, const std::vector<double>& y, double limit,
               const Edges& edges) {
  Edges links;
  LinkSelection().select(x, y, limit, edges, links);
  return links;
}

bool connected(const Edges& edges, Index cells, Index from, Index to) {
  std::vector<bool> reached(static_cast<std::size_t>(cells));
  reached[static_cast<std::size_t>(from)] = true;
  for (bool grew = true; grew;) {
    grew = false;
    for (const auto& [i, j] : edges) {
      if (reached[static_cast<std::size_t>(i)] == reached[static_cast<std::size_t>(j)]) continue;
      reached[static_cast<std::size_t>(i)] = reached[static_cast<std::size_t>(j)] = true;
      grew = true;
    }
  }
  return reached[static_cast<std::size_t>(to)];
}

TEST(Links, TheLimitItselfIsShortEnough) {
  const std::vector<double> x = {0, 1.5, 0.75}, y = {0, 0, 1};
  const Edges edges = {{0, 1}, {0, 2}, {1, 2}};
  EXPECT_EQ(selected(x, y, 1.5, edges), edges);
  const double less = std::nextafter(1.5, 0.0);
  EXPECT_EQ(selected(x, y, less, edges), (Edges{{0, 2}, {1, 2}}));
}

TEST(Links, TwoCellsAreLinkedHoweverFarApart) {
  EXPECT_EQ(selected({0, 100}, {0, 0}, 1.5, {{0, 1}}), (Edges{{0, 1}}));
}

TEST(Links, OfEquallyLongBridgesTheOneWithLowerIndicesStays) {
  // A rectangle of 4 by 1: two pairs, joined by two sides of length 4 and a diagonal.
  const std::vector<double> x = {0, 4, 4, 0}, y = {0, 0, 1, 1};
  EXPECT_EQ(selected(x, y, 1.5, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}}),
            (Edges{{0, 1}, {0, 3}, {1, 2}}));
}

// A long edge stays iff its ends have no path of short edges and of longer ones before it.
RC_GTEST_PROP(Links, AgreeWithTheDefinition, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(1, 25);
  std::vector<double> x(count), y(count);
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = *rc::gen::inRange(-60, 60) * 0.1;
    y[i] = *rc::gen::inRange(-60, 60) * 0.1;
  }
  Triangulation t;
  triangulate(x, y, t);
  const auto square = [&](const Edge& e) {
    const auto i = static_cast<std::size_t>(e[0]), j = static_cast<std::size_t>(e[1]);
    return (x[j] - x[i]) * (x[j] - x[i]) + (y[j] - y[i]) * (y[j] - y[i]);
  };
  const auto cells = static_cast<Index>(count);
  Edges expected;
  for (const Edge& e : t.edges) {
    Edges before;
    for (const Edge& other : t.edges) {
      if (square(other) <= 2.25 || std::tuple(square(other), other) < std::tuple(square(e), e)) {
        before.push_back(other);
      }
    }
    if (square(e) <= 2.25 || !connected(before, cells, e[0], e[1])) expected.push_back(e);
  }
  const Edges links = selected(x, y, 1.5, t.edges);
  RC_ASSERT(links == expected);
  for (Index i = 1; i < cells; ++i) RC_ASSERT(connected(links, cells, 0, i));
}

}  // namespace
}  // namespace metamorph::core
