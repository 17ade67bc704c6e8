#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/locomotion/solid_pairs.h"
#include "kernels/reference/actuation.h"
#include "kernels/reference/pressure.h"
#include "kernels/reference/self_collision.h"
#include "kernels/reference/spring.h"
#include "metamorph/body.h"
#include "metamorph/scene.h"
#include "tests/bodies.h"
#include "tests/kernels/points.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

/// A random body in a random state: displaced by up to 0.1 d, speeds up to 1.
struct Tangle {
  explicit Tangle(std::uint64_t seed) : body(blob_body(40, seed)), points(body.x.size()) {
    evolve::RandomStream random(evolve::Purpose::test, seed, 1, 0);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      points.x[i] = body.x[i] + 0.1 * (2 * random.uniform() - 1);
      points.y[i] = body.y[i] + 0.1 * (2 * random.uniform() - 1);
      points.vx[i] = 2 * random.uniform() - 1;
      points.vy[i] = 2 * random.uniform() - 1;
    }
    // A wide gap, so that many pairs repel.
    core::Scene crowded;
    crowded.collision_gap = 2.0;
    for (const core::SolidPair& pair : core::solid_pairs(body, crowded))
      pairs.push_back({pair.node, pair.edge, pair.threshold});
  }

  ref::PressureCells cells() const { return {body.triangles, body.rest_area, 0.15}; }

  core::Body body;
  Points points;
  std::vector<ref::CollisionPair> pairs;
};

struct InternalForce {
  std::string name;
  std::function<void(const Tangle&, const ref::Nodes&, const ref::Forces&)> add;
  std::function<double(const Tangle&, const ref::Nodes&)> energy;  ///< null: not a gradient
};

std::ostream& operator<<(std::ostream& out, const InternalForce& force) {
  return out << force.name;
}

std::vector<InternalForce> internal_forces() {
  return {
      {"Springs",
       [](const Tangle& t, const ref::Nodes& n, const ref::Forces& f) {
         ref::add_spring_forces(t.body.springs, t.body.rest_length, 1.5, 0, n, f);
       },
       [](const Tangle& t, const ref::Nodes& n) {
         return ref::spring_energy(t.body.springs, t.body.rest_length, 1.5, n);
       }},
      {"Dampers",
       [](const Tangle& t, const ref::Nodes& n, const ref::Forces& f) {
         ref::add_spring_forces(t.body.springs, t.body.rest_length, 0, 0.7, n, f);
       },
       {}},
      {"Pressure",
       [](const Tangle& t, const ref::Nodes& n, const ref::Forces& f) {
         ref::add_pressure_forces(t.cells(), 1.25, n, f);
       },
       [](const Tangle& t, const ref::Nodes& n) {
         return ref::pressure_energy(t.cells(), 1.25, n);
       }},
      {"SelfCollision",
       [](const Tangle& t, const ref::Nodes& n, const ref::Forces& f) {
         ref::add_collision_forces(t.pairs, 2.0, n, f);
       },
       [](const Tangle& t, const ref::Nodes& n) { return ref::collision_energy(t.pairs, 2.0, n); }},
  };
}

class InternalForces : public testing::TestWithParam<InternalForce> {};

INSTANTIATE_TEST_SUITE_P(Reference, InternalForces, testing::ValuesIn(internal_forces()),
                         testing::PrintToStringParamName());

TEST_P(InternalForces, HaveNoNetForceAndNoNetTorque) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Tangle tangle(seed);
    const std::size_t n = tangle.points.x.size();
    std::vector<double> fx(n), fy(n);
    GetParam().add(tangle, tangle.points.nodes(), {fx, fy});
    double net_x = 0, net_y = 0, torque = 0, force_size = 0, torque_size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = tangle.points.x[i], y = tangle.points.y[i];
      net_x += fx[i];
      net_y += fy[i];
      torque += x * fy[i] - y * fx[i];
      force_size += std::fabs(fx[i]) + std::fabs(fy[i]);
      torque_size += std::fabs(x * fy[i]) + std::fabs(y * fx[i]);
    }
    ASSERT_GT(force_size, 0.1);
    // A node sums up to six springs and six triangles, then come 40 additions: 64 roundings. Forces
    // partly cancel in the sums of a node, so that each may round at several times its size.
    EXPECT_TRUE(within(net_x, tolerance::sum(round_off_64, 64) * force_size));
    EXPECT_TRUE(within(net_y, tolerance::sum(round_off_64, 64) * force_size));
    EXPECT_TRUE(within(torque, tolerance::sum(round_off_64, 64) * torque_size));
  }
}

std::vector<InternalForce> conservative_forces() {
  std::vector<InternalForce> forces = internal_forces();
  std::erase_if(forces, [](const InternalForce& force) { return !force.energy; });
  return forces;
}

class ConservativeForces : public testing::TestWithParam<InternalForce> {};

INSTANTIATE_TEST_SUITE_P(Reference, ConservativeForces, testing::ValuesIn(conservative_forces()),
                         testing::PrintToStringParamName());

TEST_P(ConservativeForces, AreMinusTheGradientOfTheirEnergy) {
  constexpr double delta = 1e-5;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Tangle tangle(seed);
    const std::size_t n = tangle.points.x.size();
    std::vector<double> fx(n), fy(n);
    GetParam().add(tangle, tangle.points.nodes(), {fx, fy});
    const double energy = GetParam().energy(tangle, tangle.points.nodes());
    // The third derivative: springs k/l^2, pressure c_p S0/S^3 (dS/dx)^3, both below 30 times six
    // elements in these states. Gaps are below 2 d and their second derivative jumps where the
    // closest point changes from an edge to its end: a first-order error delta k_s.
    const double error = tolerance::central_difference(delta, energy, 180) +
                         (GetParam().name == "SelfCollision" ? 2 * delta : 0);
    const auto slope = [&](double& coordinate) {
      const double at = coordinate;
      coordinate = at + delta;
      const double more = GetParam().energy(tangle, tangle.points.nodes());
      coordinate = at - delta;
      const double less = GetParam().energy(tangle, tangle.points.nodes());
      coordinate = at;
      return (more - less) / (2 * delta);
    };
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_TRUE(within(fx[i] + slope(tangle.points.x[i]), error)) << "node " << i;
      EXPECT_TRUE(within(fy[i] + slope(tangle.points.y[i]), error)) << "node " << i;
    }
  }
}

TEST(Dampers, NeverDoWork) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Tangle tangle(seed);
    const std::size_t n = tangle.points.x.size();
    std::vector<double> fx(n), fy(n);
    ref::add_spring_forces(tangle.body.springs, tangle.body.rest_length, 0, 0.4,
                           tangle.points.nodes(), {fx, fy});
    double power = 0;
    for (std::size_t i = 0; i < n; ++i)
      power += fx[i] * tangle.points.vx[i] + fy[i] * tangle.points.vy[i];
    EXPECT_LT(power, 0);
  }
}

TEST(Dampers, DoNotFeelRigidMotion) {
  Tangle tangle(7);
  const std::size_t n = tangle.points.x.size();
  for (std::size_t i = 0; i < n; ++i) {
    tangle.points.vx[i] = 0.3 - 0.5 * tangle.points.y[i];
    tangle.points.vy[i] = -0.7 + 0.5 * tangle.points.x[i];
  }
  std::vector<double> fx(n), fy(n);
  ref::add_spring_forces(tangle.body.springs, tangle.body.rest_length, 0, 0.4,
                         tangle.points.nodes(), {fx, fy});
  // Speeds of up to 4, rounded in each of six springs.
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_TRUE(within(std::hypot(fx[i], fy[i]), tolerance::sum(round_off_64, 6 * 8) * 4));
}

TEST(Spring, OfLengthZeroExertsNoForce) {
  Points points(2);
  points.vx[1] = 1;
  std::vector<double> fx(2), fy(2);
  ref::add_spring_forces(std::vector<ref::Edge>{{0, 1}}, std::vector<double>{1.0}, 1, 1,
                         points.nodes(), {fx, fy});
  EXPECT_EQ(fx, (std::vector<double>{0, 0}));
  EXPECT_EQ(fy, (std::vector<double>{0, 0}));
}

TEST(Pressure, SkipsTrianglesBelowTheSmallestArea) {
  Points points(3);
  points.x[1] = 1;
  points.y[2] = 0.25;
  std::vector<double> fx(3), fy(3);
  const std::vector<ref::Triangle> triangle = {{0, 1, 2}};
  const std::vector<double> rest = {0.1499};
  ref::add_pressure_forces({triangle, rest, 0.15}, 1, points.nodes(), {fx, fy});
  EXPECT_EQ(fy, (std::vector<double>{0, 0, 0}));
  ref::add_pressure_forces({triangle, rest, 0.1499}, 1, points.nodes(), {fx, fy});
  EXPECT_GT(fy[2], 0);  // S = 0.125 < S0: pushes outward
}

TEST(Pressure, IsTheForceOfEquationOneOnEveryEdge) {
  // On an edge c_p L (S0/S - 1) along the outward normal, half to each end: a right triangle with
  // legs 2 and 1, S = 1, S0 = 3, c_p = 1.
  Points points(3);
  points.x[1] = 2;
  points.y[2] = 1;
  std::vector<double> fx(3), fy(3);
  ref::add_pressure_forces({std::vector<ref::Triangle>{{0, 1, 2}}, std::vector<double>{3.0}, 0}, 1,
                           points.nodes(), {fx, fy});
  // Bottom: 2 * 2 down; left: 1 * 2 leftward; the slanted edge: sqrt(5) * 2 along (1, 2)/sqrt(5).
  EXPECT_EQ(fx, (std::vector<double>{-1, 1, 1 - 1}));
  EXPECT_EQ(fy, (std::vector<double>{-2, -2 + 2, 2}));
}

}  // namespace
}  // namespace metamorph::tests
