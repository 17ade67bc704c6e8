#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "bench/accuracy/specimens.h"
#include "core/scene.h"

/// What is measured. Each writes one table (CSV, a row per measurement) and leaves statistics to
/// bench/plot_accuracy.py.
namespace metamorph::bench {

/// Every method over a ladder of steps, against a converged reference.
void work_precision(std::span<const Specimen> specimens, std::ostream& out);

/// Largest stable steps by bisection, with the theory beside them.
void stability_map(std::span<const Specimen> specimens, std::ostream& out);

/// Terms and numerical luxuries left out one at a time, on the fast kernels.
void ablation(std::span<const Specimen> specimens, std::ostream& out);

/// Settling before the run: its parameters, its cost, the rest it reaches and what that decides.
void settling(std::span<const Specimen> specimens, std::ostream& out);

/// Growth of a small perturbation of the state at rest over the time of a run.
void predictability(std::span<const Specimen> specimens, std::ostream& out);

}  // namespace metamorph::bench
