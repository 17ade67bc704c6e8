#pragma once

#include <vector>

#include "evolve/life/life.h"
#include "evolve/view/colour.h"

namespace metamorph::evolve {

/// d above the ground up to which a node touches it: what rests there sways a little.
constexpr double ground_reach = 0.02;

/// Parts of the outline touch where they are nearer to each other than the scene's
/// collision_gap, and than this share of their distance in the body at rest (cells that are
/// neighbours by a corner are near for ever).
constexpr double squeezed = 0.98;

/// [nodes] What each touches at a frame of a motion.
std::vector<Contact> contacts_of(const Motion& motion, int frame);

}  // namespace metamorph::evolve
