#pragma once

#include <array>

#include "metamorph/evaluation.h"
#include "tests/evolve/problems/controller.h"

namespace metamorph::evolve::testing {

struct Point {
  double x, y;
};

struct Wall {
  Point a, b;
};

/// The hard maze of Lehman and Stanley (2011), which deceives whoever walks towards the goal: their
/// map (hard_maze.txt of their novelty search code), sensors and robot.
inline constexpr std::array<Wall, 13> maze_walls = {{{{41, 5}, {3, 8}},
                                                     {{3, 8}, {4, 49}},
                                                     {{4, 49}, {57, 53}},
                                                     {{4, 49}, {7, 202}},
                                                     {{7, 202}, {195, 198}},
                                                     {{195, 198}, {186, 8}},
                                                     {{186, 8}, {39, 5}},
                                                     {{56, 54}, {56, 157}},
                                                     {{57, 106}, {158, 162}},
                                                     {{77, 201}, {108, 164}},
                                                     {{6, 80}, {33, 121}},
                                                     {{192, 146}, {87, 91}},
                                                     {{56, 55}, {133, 30}}}};
inline constexpr Point maze_start = {36, 184}, maze_goal = {31, 20};
inline constexpr double robot_radius = 8, goal_radius = 5, sight = 100;
inline constexpr int maze_steps = 400;

struct Robot {
  Point at = maze_start;
  double heading = 0;   ///< degrees; 0 looks along x, 90 along y
  double speed = 0;     ///< per step, within 3
  double turn = 0;      ///< degrees per step, within 3
  double free_way = 0;  ///< no wall is nearer
};

/// How far it is to a wall at -90, -45, 0, 45, 90 and 180 degrees of the heading, over `sight` and
/// at most 1; then 1 in the one of four quarters (ahead, 90, 180 and 270 degrees) where the goal
/// is, 0 in the others.
std::array<double, 10> sense(const Robot& robot);

/// Distance of a point to the nearest wall.
double clearance(Point point);

/// One step. The outputs, from -1 to 1, push turn and speed by up to 1/2. A robot that would come
/// nearer to a wall than its radius stays where it is, but turns.
void advance(Robot& robot, double turn_output, double speed_output);

double goal_distance(const Robot& robot);

/// Where a robot is after `maze_steps` or, if earlier, at the goal.
Robot walk(Controller& controller);

/// Objective 300 - distance to the goal, behaviour where it ended. Returns whether that is at the
/// goal.
bool evaluate_maze(const core::Network& network, double slope, Evaluation& evaluation);

}  // namespace metamorph::evolve::testing
