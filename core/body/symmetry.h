#pragma once

#include "metamorph/body.h"

namespace metamorph::core {

/// The largest share of nodes that have a node within 0.5 d of their mirror image, over the four
/// axes through the mean of the nodes that suit the harmonics 1 to 6 of the nodes about it best. Of
/// a symmetric body 1: its axis is among them.
double symmetry_of(const Body& body);

}  // namespace metamorph::core
