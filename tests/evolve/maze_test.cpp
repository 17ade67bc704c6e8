#include "tests/evolve/problems/maze.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/evolve/problems/solve.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using testing::Point;
using testing::Robot;
using testing::Wall;

constexpr double degree = std::numbers::pi / 180;

// How far a ray goes until it meets a wall: two equations for the ways along both (Cramer's rule).
double ray(Point from, double angle) {
  double nearest = testing::sight;
  const double ux = std::cos(angle), uy = std::sin(angle);
  for (const Wall& wall : testing::maze_walls) {
    const double wx = wall.b.x - wall.a.x, wy = wall.b.y - wall.a.y;
    const double dx = wall.a.x - from.x, dy = wall.a.y - from.y;
    const double determinant = uy * wx - ux * wy;
    const double along_ray = (dy * wx - dx * wy) / determinant;
    const double along_wall = (ux * dy - uy * dx) / determinant;
    if (along_ray > 0 && along_wall >= 0 && along_wall <= 1) nearest = std::min(nearest, along_ray);
  }
  return nearest;
}

// Distance to the nearest of many points on all walls, and half their spacing.
double nearest_point(Point from) {
  double nearest = 1e9;
  for (const Wall& wall : testing::maze_walls) {
    for (int i = 0; i <= 4000; ++i) {
      const double t = i / 4000.0;
      nearest = std::min(nearest, std::hypot(wall.a.x + t * (wall.b.x - wall.a.x) - from.x,
                                             wall.a.y + t * (wall.b.y - wall.a.y) - from.y));
    }
  }
  return nearest;
}

Robot random_robot(evolve::RandomStream& stream) {
  Robot robot;
  robot.at = {200 * stream.uniform(), 200 * stream.uniform()};
  robot.heading = 720 * stream.triangular();
  return robot;
}

TEST(Maze, RangefindersSeeTheNearestWall) {
  evolve::RandomStream stream = testing::test_stream(41);
  const std::array<double, 6> angles = {-90, -45, 0, 45, 90, 180};
  int seen = 0;
  for (int i = 0; i < 2000; ++i) {
    const Robot robot = random_robot(stream);
    const auto senses = testing::sense(robot);
    for (std::size_t a = 0; a < angles.size(); ++a) {
      const double expected = ray(robot.at, (robot.heading + angles[a]) * degree) / testing::sight;
      EXPECT_NEAR(senses[a], expected, 1e-9) << i << " " << angles[a];
      seen += expected < 1 ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 6000);  // most look at a wall
}

TEST(Maze, RadarSaysInWhichQuarterTheGoalIs) {
  evolve::RandomStream stream = testing::test_stream(42);
  for (int i = 0; i < 2000; ++i) {
    const Robot robot = random_robot(stream);
    const double direction =
        std::atan2(testing::maze_goal.y - robot.at.y, testing::maze_goal.x - robot.at.x) / degree;
    double from_ahead = std::fmod(direction - robot.heading + 45, 360);
    if (from_ahead < 0) from_ahead += 360;
    const auto senses = testing::sense(robot);
    for (std::size_t quarter = 0; quarter < 4; ++quarter)
      EXPECT_EQ(senses[6 + quarter], quarter == static_cast<std::size_t>(from_ahead / 90) ? 1 : 0);
  }
}

TEST(Maze, ClearanceIsTheDistanceToTheNearestWall) {
  evolve::RandomStream stream = testing::test_stream(43);
  for (int i = 0; i < 200; ++i) {
    const Point point = random_robot(stream).at;
    const double sampled = nearest_point(point);
    EXPECT_LE(testing::clearance(point), sampled + 1e-9);
    // The spacing of the points is below 0.05; the worst case is a point on the wall.
    EXPECT_GE(testing::clearance(point), sampled - 0.025);
  }
}

TEST(Maze, RobotIsPushedAndHeldByLimits) {
  Robot robot;
  testing::advance(robot, -1, 1);
  EXPECT_EQ(robot.turn, -0.5);
  EXPECT_EQ(robot.speed, 0.5);
  EXPECT_EQ(robot.at.x, testing::maze_start.x + 0.5);
  EXPECT_EQ(robot.at.y, testing::maze_start.y);
  EXPECT_EQ(robot.heading, -0.5);
  for (int i = 0; i < 20; ++i) testing::advance(robot, 1, -1);
  EXPECT_EQ(robot.turn, 3);
  EXPECT_EQ(robot.speed, -3);
}

// Whatever drives it: it stays inside, and never nearer to a wall than its radius. Where it does
// not move, moving would have brought it there.
TEST(Maze, WallsAreNeverCrossed) {
  evolve::RandomStream stream = testing::test_stream(44);
  int blocked = 0;
  for (int run = 0; run < 200; ++run) {
    Robot robot;
    const double bias = stream.triangular();
    for (int step = 0; step < testing::maze_steps; ++step) {
      const Robot before = robot;
      testing::advance(robot, stream.triangular() + 0.2 * bias, 2 * stream.uniform() - 0.5);
      ASSERT_GE(testing::clearance(robot.at), testing::robot_radius);
      const Point next = {before.at.x + robot.speed * std::cos(before.heading * degree),
                          before.at.y + robot.speed * std::sin(before.heading * degree)};
      if (robot.at.x == before.at.x && robot.at.y == before.at.y && robot.speed != 0) {
        ++blocked;
        EXPECT_LT(testing::clearance(next), testing::robot_radius);
      } else {
        EXPECT_NEAR(std::hypot(robot.at.x - next.x, robot.at.y - next.y), 0, 1e-12);
      }
      ASSERT_TRUE(robot.at.x > 3 && robot.at.x < 195 && robot.at.y > 5 && robot.at.y < 202);
    }
  }
  EXPECT_GT(blocked, 1000);
}

// What deceives: whoever goes where it is nearer to the goal, as far as walls let it, gets stuck.
TEST(Maze, IsDeceptive) {
  const auto away = [](Point p) {
    return std::hypot(p.x - testing::maze_goal.x, p.y - testing::maze_goal.y);
  };
  Point at = testing::maze_start, best = at;
  do {
    at = best;
    for (int angle = 0; angle < 360; ++angle) {
      const Point next = {at.x + std::cos(angle * degree), at.y + std::sin(angle * degree)};
      if (testing::clearance(next) >= testing::robot_radius && away(next) < away(best)) best = next;
    }
  } while (away(best) < away(at));
  EXPECT_GT(away(at), 2 * testing::robot_radius);
  EXPECT_LT(away(at), away(testing::maze_start));
}

TEST(Maze, EvaluationTellsWhereTheRobotEnded) {
  // Outputs without links: the robot stays where it starts.
  core::Network network;
  network.inputs = 11;
  network.first_link = {0, 0, 0};
  network.output = {11, 12};
  Evaluation evaluation;
  EXPECT_FALSE(testing::evaluate_maze(network, 1, evaluation));
  EXPECT_EQ(evaluation.descriptors, (std::vector{36.0, 184.0}));
  EXPECT_DOUBLE_EQ(evaluation.objectives.at(0), 300 - std::hypot(5, 164));
}

}  // namespace
}  // namespace metamorph::evolve
