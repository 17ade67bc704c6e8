#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "bench/accuracy/specimens.h"
#include "metamorph/scene.h"

/// What is measured. Each writes one table (CSV, a row per measurement) and leaves statistics to
/// bench/plot_accuracy.py.
namespace metamorph::bench {

/// Every method over a ladder of steps, against a converged reference. A whole run on the ground is
/// at the edge of what is predictable; its first third is well within.
void work_precision_water(std::span<const Specimen> specimens, std::ostream& out);
void work_precision_land(std::span<const Specimen> specimens, std::ostream& out);
void work_precision_land_third(std::span<const Specimen> specimens, std::ostream& out);
void work_precision_slope(std::span<const Specimen> specimens, std::ostream& out);

/// Largest stable steps by bisection, with the theory beside them.
void stability_map(std::span<const Specimen> specimens, std::ostream& out);

/// Terms and numerical luxuries left out one at a time, on the fast kernels.
void ablation(std::span<const Specimen> specimens, std::ostream& out);

/// Settling before a run on flat land (on the slope most bodies never rest): its parameters, its
/// cost, the rest it reaches and what that decides.
void settling(std::span<const Specimen> specimens, std::ostream& out);

/// Every frame of a run: whether the outline crosses itself, how deep the ground is entered.
void solidity(std::span<const Specimen> specimens, std::ostream& out);

/// Growth of a small perturbation of the state at rest over the time of a run.
void predictability(std::span<const Specimen> specimens, std::ostream& out);

}  // namespace metamorph::bench
