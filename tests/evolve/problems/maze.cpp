#include "tests/evolve/problems/maze.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace metamorph::evolve::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Walls as arrays: loops over them vectorise.
constexpr std::size_t walls = 16;  // the last three are far away
struct WallArrays {
  std::array<double, walls> ax, ay, bx, by;
};
constexpr WallArrays wall_arrays = [] {
  WallArrays arrays{};
  for (std::size_t w = 0; w < walls; ++w) {
    const bool real = w < maze_walls.size();
    arrays.ax[w] = real ? maze_walls[w].a.x : 1e6;
    arrays.ay[w] = real ? maze_walls[w].a.y : 1e6;
    arrays.bx[w] = real ? maze_walls[w].b.x : 1e6 + 1;
    arrays.by[w] = real ? maze_walls[w].b.y : 1e6 + 1;
  }
  return arrays;
}();

// Along a line through the robot, the nearest walls in its direction and against it. The walls'
// ends are given along that direction and across it.
struct Sights {
  double ahead, behind;
};
Sights look(const std::array<double, walls>& along_a, const std::array<double, walls>& across_a,
            const std::array<double, walls>& along_b, const std::array<double, walls>& across_b) {
  std::array<double, walls> ahead, behind;
  for (std::size_t w = 0; w < walls; ++w) {
    const bool crosses = (across_a[w] < 0) != (across_b[w] < 0);
    const double at = (along_a[w] * across_b[w] - along_b[w] * across_a[w]) /
                      (crosses ? across_b[w] - across_a[w] : 1.0);
    ahead[w] = crosses && at > 0 ? at : sight;
    behind[w] = crosses && at < 0 ? -at : sight;
  }
  for (std::size_t half = walls / 2; half > 0; half /= 2) {
    for (std::size_t w = 0; w < half; ++w) {
      ahead[w] = std::min(ahead[w], ahead[w + half]);
      behind[w] = std::min(behind[w], behind[w + half]);
    }
  }
  return {ahead[0], behind[0]};
}

}  // namespace

std::array<double, 10> sense(const Robot& robot) {
  // The walls as the robot sees them: x ahead, y at 90 degrees; then the same along the diagonals,
  // where lengths are root 2 too long.
  const double c = std::cos(robot.heading * degree), s = std::sin(robot.heading * degree);
  std::array<double, walls> ax, ay, bx, by, a_sum, a_difference, b_sum, b_difference;
  for (std::size_t w = 0; w < walls; ++w) {
    const double dax = wall_arrays.ax[w] - robot.at.x, day = wall_arrays.ay[w] - robot.at.y;
    const double dbx = wall_arrays.bx[w] - robot.at.x, dby = wall_arrays.by[w] - robot.at.y;
    ax[w] = c * dax + s * day;
    ay[w] = c * day - s * dax;
    bx[w] = c * dbx + s * dby;
    by[w] = c * dby - s * dbx;
    constexpr double r = 1 / std::numbers::sqrt2;
    a_sum[w] = r * (ax[w] + ay[w]);
    a_difference[w] = r * (ay[w] - ax[w]);
    b_sum[w] = r * (bx[w] + by[w]);
    b_difference[w] = r * (by[w] - bx[w]);
  }
  const Sights length = look(ax, ay, bx, by), breadth = look(ay, ax, by, bx);
  const Sights right = look(a_sum, a_difference, b_sum, b_difference);
  const Sights left = look(a_difference, a_sum, b_difference, b_sum);
  std::array<double, 10> senses = {breadth.behind / sight, left.behind / sight,
                                   length.ahead / sight,   right.ahead / sight,
                                   breadth.ahead / sight,  length.behind / sight};
  const double dx = maze_goal.x - robot.at.x, dy = maze_goal.y - robot.at.y;
  const double x = c * dx + s * dy, y = c * dy - s * dx;
  // Quarters begin at -45, 45, 135 and 225 degrees.
  const std::size_t quarter = y >= -x && y < x   ? 0
                              : y >= x && y > -x ? 1
                              : y <= -x && y > x ? 2
                                                 : 3;
  senses[6 + quarter] = 1;
  return senses;
}

double clearance(Point point) {
  std::array<double, walls> squared;
  for (std::size_t w = 0; w < walls; ++w) {
    const double ux = wall_arrays.bx[w] - wall_arrays.ax[w];
    const double uy = wall_arrays.by[w] - wall_arrays.ay[w];
    const double px = point.x - wall_arrays.ax[w], py = point.y - wall_arrays.ay[w];
    double t = (px * ux + py * uy) / (ux * ux + uy * uy);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    const double dx = px - t * ux, dy = py - t * uy;
    squared[w] = dx * dx + dy * dy;
  }
  return std::sqrt(*std::min_element(squared.begin(), squared.end()));
}

void advance(Robot& robot, double turn_output, double speed_output) {
  robot.turn = std::clamp(robot.turn + turn_output / 2, -3.0, 3.0);
  robot.speed = std::clamp(robot.speed + speed_output / 2, -3.0, 3.0);
  const Point next = {robot.at.x + std::cos(robot.heading * degree) * robot.speed,
                      robot.at.y + std::sin(robot.heading * degree) * robot.speed};
  robot.heading += robot.turn;
  // The way to the walls shrinks by no more than the robot goes.
  robot.free_way -= std::abs(robot.speed);
  if (robot.free_way < robot_radius) robot.free_way = clearance(next);
  if (robot.free_way >= robot_radius) robot.at = next;
}

double goal_distance(const Robot& robot) {
  const double dx = robot.at.x - maze_goal.x, dy = robot.at.y - maze_goal.y;
  return std::sqrt(dx * dx + dy * dy);
}

Robot walk(Controller& controller) {
  Robot robot;
  for (int step = 0; step < maze_steps && goal_distance(robot) >= goal_radius; ++step) {
    const auto outputs = controller(sense(robot));
    advance(robot, outputs[0], outputs[1]);
  }
  return robot;
}

bool evaluate_maze(const core::Network& network, double slope, Evaluation& evaluation) {
  Controller controller(network, slope);
  const Robot robot = walk(controller);
  evaluation.objectives = {300 - goal_distance(robot)};
  evaluation.descriptors = {robot.at.x, robot.at.y};
  return goal_distance(robot) < goal_radius;
}

}  // namespace metamorph::evolve::testing
