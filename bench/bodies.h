#pragma once

#include <vector>

#include "metamorph/body.h"
#include "metamorph/development.h"
#include "metamorph/genome.h"
#include "metamorph/scene.h"

namespace metamorph::bench {

/// A disc cut from the hexagonal lattice: the `cells` points nearest to the origin, a wave of phase
/// running over it, all periods 40. Nothing of it touches itself.
core::Body lattice_disc(int cells);

/// Evolved genomes of bodies that are solid, shipped as
/// bench/genomes/solid-*.json: the best of runs water to land, simple (1 to 5) and novelty search.
std::vector<evolve::Genome> evolved_genomes();

/// Bodies of the evolved genomes at a step of development; those that have none are left out.
std::vector<core::Body> grown_bodies(int stage);

/// A scene for timing steps: no settling, no self-collision, the model's 3000 steps.
core::Scene plain(core::Scene scene);

/// Floating-point operations of one step of a body in water as the library's kernel does them (a
/// fused multiply-add counts two, a root or a division one; minima, maxima and idle lanes are not
/// counted), all oscillators of one period: 27 per spring and end, 15 per triangle and corner, 29
/// per outline edge and end, 19 per node.
double water_step_flop(const core::Body& body);

}  // namespace metamorph::bench
