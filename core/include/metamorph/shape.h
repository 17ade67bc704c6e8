#pragma once

#include "metamorph/body.h"

namespace metamorph::core {

/// What a body at rest says of its form and of its oscillators: numbers by which bodies are told
/// apart (MODEL section 9). None depends on where the body lies or how it is turned, but for
/// rounding; elongation, compactness and limbs do not depend on its size either. The same bits on
/// every machine.
struct Shape {
  double elongation = 0;       ///< [0, 1) of the ellipse with the body's second moments of area:
                               ///< 1 - short axis / long axis
  double compactness = 0;      ///< (0, 1] 4 pi area / (length of the whole outline)^2
  double symmetry = 0;         ///< [0, 1] largest share of nodes that a mirror axis through their
                               ///< mean brings within 0.5 d of a node
  int limbs = 0;               ///< protrusions of the outer outline
  double mean_period = 0;      ///< of the nodes, time units
  double phase_coherence = 0;  ///< [0, 1] |mean of exp(i phase)| over the nodes
};

/// Precondition: the body is sound (check() in metamorph/body.h). Some 50 microseconds for 256
/// nodes.
Shape shape_of(const Body& body);

/// Share that two bodies have in common if they are laid upon each other, centroid on centroid,
/// neither turned: area of the intersection / area of the union, [0, 1]; of the same body
/// exactly 1. Measured along horizontal lines 1/8 d apart. Precondition: both are sound.
double overlap(const Body& a, const Body& b);

}  // namespace metamorph::core
