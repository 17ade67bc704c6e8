#include "evolve/run/memory_check.h"

#include <fmt/format.h>

#include "evolve/experiment/memory_estimate.h"
#include "evolve/files/input_error.h"
#include "evolve/run/free_memory.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {

std::string memory_fault(const Experiment& experiment, int threads, double free) {
  const int population = experiment.neat.population;
  const double needed = memory_estimate(experiment, population, threads);
  if (needed <= free) return {};
  // The largest that fits is at least `fits` and less than `fails`.
  int fits = 0, fails = population;
  while (fails - fits > 1) {
    const int middle = fits + (fails - fits) / 2;
    (memory_estimate(experiment, middle, threads) <= free ? fits : fails) = middle;
  }
  const std::string expected = fits > 0 ? fmt::format("expected at most {}", fits)
                                        : "expected more memory, or fewer threads";
  return fmt::format(
      "neat.population = {}: needs about {:.2g} GB of memory, {:.2g} GB are free: {}", population,
      needed / 1e9, free / 1e9, expected);
}

void require_memory(const Experiment& experiment, int threads) {
  const std::string fault =
      memory_fault(experiment, core::thread_count(threads), free_memory("/", process_limits()));
  if (!fault.empty()) throw InputError(fault);
}

}  // namespace metamorph::evolve
