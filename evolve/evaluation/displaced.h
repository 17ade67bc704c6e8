#pragma once

#include "metamorph/body.h"
#include "metamorph/random.h"

namespace metamorph::evolve {

/// The body with every node moved by uniform draws within +-displacement d in x and in y; its rest
/// values stay. Node i takes the draws 2 i and 2 i + 1 of the stream, so that its move depends on
/// the stream and its index alone, whatever the body.
core::Body displaced(core::Body body, double displacement, RandomStream random);

}  // namespace metamorph::evolve
