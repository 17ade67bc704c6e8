#include "kernels/cell_mechanics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "kernels/reference/cell_mechanics.h"
#include "tests/tolerance.h"

namespace metamorph::kernels {
namespace {

using Links = std::vector<std::array<int, 2>>;

/// An embryo with its rings, padded by cells at rest in the origin.
template <class T>
struct Cells {
  std::vector<NodeRecord<T>> cell;
  std::vector<NodeRecord<T>> next;
  std::vector<int> first_slot = {0};
  std::vector<std::uint32_t> neighbour;

  Cells(std::vector<NodeRecord<T>> records, const Links& links) : cell(std::move(records)) {
    const std::size_t count = cell.size();
    cell.resize((count + cell_lanes - 1) / cell_lanes * cell_lanes);
    next.resize(cell.size());
    std::vector<std::vector<int>> ring(cell.size());
    for (const auto& [i, j] : links) {
      ring[static_cast<std::size_t>(i)].push_back(j);
      ring[static_cast<std::size_t>(j)].push_back(i);
    }
    for (auto& list : ring) std::sort(list.begin(), list.end());
    for (std::size_t first = 0; first < cell.size(); first += cell_lanes) {
      std::size_t slots = 0;
      for (std::size_t i = first; i < first + cell_lanes; ++i)
        slots = std::max(slots, ring[i].size());
      first_slot.push_back(first_slot.back() + static_cast<int>(slots));
      for (std::size_t s = 0; s < slots; ++s) {
        for (std::size_t i = first; i < first + cell_lanes; ++i) {
          const std::size_t other = s < ring[i].size() ? static_cast<std::size_t>(ring[i][s]) : i;
          neighbour.push_back(record_offset<T>(static_cast<std::uint32_t>(other)));
        }
      }
    }
  }

  CellRings rings() const {
    return {static_cast<int>(first_slot.size()) - 1, first_slot.data(), first_slot.data() + 1,
            neighbour.data()};
  }

  void step(const CellMechanics<T>& mechanics) {
    step_cells(mechanics, rings(), cell.data(), next.data());
    cell.swap(next);
  }

  /// Forces without drag, as the change of velocity in a step of 1: rounded once more than the
  /// forces themselves where cells move, exact where they rest.
  struct Forces {
    std::vector<T> x, y;
  };
  Forces forces(CellMechanics<T> mechanics) {
    mechanics.step = T(1);
    mechanics.drag = T(0);
    step_cells(mechanics, rings(), cell.data(), next.data());
    Forces result;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      result.x.push_back(next[i].vx - cell[i].vx);
      result.y.push_back(next[i].vy - cell[i].vy);
    }
    return result;
  }
};

/// A patch of a triangular lattice, pulled out of shape and moving.
template <class T>
std::vector<NodeRecord<T>> patch(int width, int height) {
  std::vector<NodeRecord<T>> cells;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const double n = j * width + i;
      cells.push_back({static_cast<T>(i + 0.5 * j + 0.1 * std::sin(3 * n)),
                       static_cast<T>(0.9 * j + 0.1 * std::cos(5 * n)),
                       static_cast<T>(0.2 * std::sin(7 * n)),
                       static_cast<T>(0.2 * std::cos(11 * n))});
    }
  }
  return cells;
}

Links patch_links(int width, int height) {
  Links links;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const int n = j * width + i;
      if (i + 1 < width) links.push_back({n, n + 1});
      if (j + 1 < height) links.push_back({n, n + width});
      if (i > 0 && j + 1 < height) links.push_back({n, n + width - 1});
    }
  }
  return links;
}

template <class T>
constexpr CellMechanics<T> model = {T(0.2), T(1), T(1), T(0.2)};

TEST(CellMechanics, DragSlowsAFreeCellByTheSameFactorEveryStep) {
  Cells<double> cells({{1, 2, 0.5, -3}}, {});
  double x = 1;
  for (int n = 1; n <= 200; ++n) {
    cells.step(model<double>);
    const double v = 0.5 * std::pow(1 - 0.2 * 0.2, n);
    x += 0.2 * v;
    // One rounding or two per step and operation.
    ASSERT_TRUE(tests::within(cells.cell[0].vx - v, 4 * n * 1e-16));
    ASSERT_TRUE(tests::within(cells.cell[0].x - x, 4 * n * 2e-16));
    ASSERT_TRUE(tests::within(cells.cell[0].vy + 6 * v, 24 * n * 1e-16));
  }
}

TEST(CellMechanics, APairAtRestMovesLikeAFreeCell) {
  Cells<float> pair({{0, 0, 0.25f, 0.5f}, {1, 0, 0.25f, 0.5f}}, {{0, 1}});
  Cells<float> free({{0, 0, 0.25f, 0.5f}}, {});
  pair.step(model<float>);
  free.step(model<float>);
  EXPECT_EQ(pair.cell[0].x, free.cell[0].x);
  EXPECT_EQ(pair.cell[0].y, free.cell[0].y);
  EXPECT_EQ(pair.cell[1].vx, free.cell[0].vx);
}

// Along its axis an undamped pair is the oscillator u'' = -2 k u, of which symplectic Euler
// keeps w^2 + 2 k u^2 - 2 k h u w (w = u') exactly.
TEST(CellMechanics, AnUndampedPairKeepsTheInvariantOfSymplecticEuler) {
  const CellMechanics<double> undamped = {0.2, 1, 0, 0};
  Cells<double> pair({{0, 0, 0, 0}, {0.6 * 1.3, 0.8 * 1.3, 0.06, 0.08}}, {{0, 1}});
  const auto invariant = [&] {
    const auto &a = pair.cell[0], &b = pair.cell[1];
    const double u = std::hypot(b.x - a.x, b.y - a.y) - 1;
    const double w = (b.vx - a.vx) * 0.6 + (b.vy - a.vy) * 0.8;
    return w * w + 2 * u * u - 2 * 0.2 * u * w;
  };
  const double first = invariant();
  for (int n = 1; n <= 1000; ++n) {
    pair.step(undamped);
    ASSERT_TRUE(tests::within(invariant() - first, 1e-15 * (10 + n)));
  }
}

template <class T>
void expect_no_net_force(double tolerance) {
  Cells<T> cells(patch<T>(9, 8), patch_links(9, 8));
  const auto forces = cells.forces(model<T>);
  double x = 0, y = 0, torque = 0, magnitude = 0;
  for (std::size_t i = 0; i < cells.cell.size(); ++i) {
    const double fx = forces.x[i], fy = forces.y[i];
    x += fx;
    y += fy;
    torque += cells.cell[i].x * fy - cells.cell[i].y * fx;
    magnitude += std::hypot(fx, fy) * (1 + std::hypot(cells.cell[i].x, cells.cell[i].y));
  }
  EXPECT_GT(magnitude, 1);
  EXPECT_TRUE(tests::within(x, tolerance * magnitude));
  EXPECT_TRUE(tests::within(y, tolerance * magnitude));
  EXPECT_TRUE(tests::within(torque, tolerance * magnitude));
}

// Both ends compute opposite bits; only the sums of six springs are rounded.
TEST(CellMechanics, InternalForcesAddUpToNothing) {
  expect_no_net_force<double>(1e-15);
  expect_no_net_force<float>(1e-6);
}

TEST(CellMechanics, BothEndsOfASpringFeelTheSameForceToTheBit) {
  for (int n = 0; n < 100; ++n) {
    const auto number = [n](int k) {
      return Lanes<float>(static_cast<float>(std::sin(7.0 * n + k)));
    };
    const Lanes<float> dx = number(1), dy = number(2), dvx = number(3), dvy = number(4);
    EXPECT_EQ(cell_spring_tension(model<float>, dx, dy, dvx, dvy)[0],
              cell_spring_tension(model<float>, -dx, -dy, -dvx, -dvy)[0]);
  }
}

TEST(CellMechanics, DampersOnlyTakeEnergy) {
  const CellMechanics<double> dampers = {0.2, 0, 1, 0};
  Cells<double> cells(patch<double>(9, 8), patch_links(9, 8));
  const auto forces = cells.forces(dampers);
  double power = 0;
  for (std::size_t i = 0; i < cells.cell.size(); ++i) {
    power += forces.x[i] * cells.cell[i].vx + forces.y[i] * cells.cell[i].vy;
  }
  EXPECT_LT(power, 0);
}

TEST(CellMechanics, CoincidentCentresExertNoForce) {
  Cells<float> cells({{1, 1, 2, 0}, {1, 1, -2, 0}, {1, 2, 0, 0}}, {{0, 1}, {0, 2}});
  const auto forces = cells.forces(model<float>);
  EXPECT_EQ(forces.x[0], 0);
  EXPECT_EQ(forces.y[0], 0);
  EXPECT_EQ(forces.x[1], 0);
  EXPECT_EQ(forces.y[1], 0);
}

template <class T>
double largest_deviation_from_reference(int steps) {
  const Links links = patch_links(9, 8);
  Cells<T> fast(patch<T>(9, 8), links);
  std::vector<double> x, y, vx, vy, fx(72), fy(72);
  for (const auto& c : patch<T>(9, 8)) {
    x.push_back(static_cast<double>(c.x));
    y.push_back(static_cast<double>(c.y));
    vx.push_back(static_cast<double>(c.vx));
    vy.push_back(static_cast<double>(c.vy));
  }
  double worst = 0;
  for (int n = 0; n < steps; ++n) {
    fast.step(model<T>);
    reference::step_cells(0.2, 1, 1, 0.2, 72, static_cast<int>(links.size()),
                          reinterpret_cast<const int(*)[2]>(links.data()), x.data(), y.data(),
                          vx.data(), vy.data(), fx.data(), fy.data());
    for (std::size_t i = 0; i < x.size(); ++i) {
      worst = std::max({worst, std::fabs(static_cast<double>(fast.cell[i].x) - x[i]),
                        std::fabs(static_cast<double>(fast.cell[i].y) - y[i])});
    }
  }
  return worst;
}

// The motion is damped towards rest: errors of a rounding each (coordinates up to 16, so 1e-6 or
// 2e-15) add up over the steps but do not grow.
TEST(CellMechanics, AgreesWithTheReference) {
  EXPECT_TRUE(tests::within(largest_deviation_from_reference<double>(300), 300 * 2e-15));
  EXPECT_TRUE(tests::within(largest_deviation_from_reference<float>(300), 300 * 1e-6));
}

TEST(CellMechanics, ANotANumberStaysWithTheCellsItIsLinkedTo) {
  auto records = patch<float>(4, 4);
  Cells<float> apart(records, {{0, 1}, {2, 3}});
  records[0].x = std::numeric_limits<float>::quiet_NaN();
  Cells<float> ill(records, {{0, 1}, {2, 3}});
  apart.step(model<float>);
  ill.step(model<float>);
  EXPECT_TRUE(std::isnan(ill.cell[1].x));
  for (std::size_t i = 2; i < 16; ++i) EXPECT_EQ(ill.cell[i].x, apart.cell[i].x);
}

}  // namespace
}  // namespace metamorph::kernels
