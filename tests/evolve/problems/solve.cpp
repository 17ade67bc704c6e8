#include "tests/evolve/problems/solve.h"

#include <algorithm>
#include <memory>

#include "metamorph/genome.h"

namespace metamorph::evolve::testing {

SearchSetup minimal_setup(int inputs, int outputs, int population, std::uint64_t seed) {
  SearchSetup setup;
  setup.neat.population = population;
  setup.neat.hidden_nodes = 0;
  setup.problem.objectives = {{"fitness"}};
  setup.problem.seed = seed;
  setup.shape = free_shape(inputs, outputs);
  setup.threads = 1;
  return setup;
}

Attempt attempt(const SearchSetup& setup, int cap, const Generation& generation) {
  const std::unique_ptr<Search> search = make_search(setup);
  Attempt result;
  for (;;) {
    const Asked asked = search->ask();
    const int more = static_cast<int>(asked.genomes.size());
    if (result.evaluations + more > cap) return result;
    std::vector<core::Network> networks;
    for (const Genome& genome : asked.genomes) networks.push_back(compile(genome, setup.shape));
    std::vector<Evaluation> evaluations(networks.size());
    result.solved = generation(networks, evaluations);
    result.evaluations += more;
    for (const Evaluation& evaluation : evaluations)
      result.best = std::max(result.best, evaluation.objectives.front());
    if (result.solved) return result;
    search->tell(evaluations);
  }
}

Attempt attempt(const SearchSetup& setup, int cap,
                const std::function<bool(const core::Network&, Evaluation&)>& evaluate) {
  return attempt(setup, cap,
                 [&](const std::vector<core::Network>& networks, std::vector<Evaluation>& told) {
                   bool solved = false;
                   for (std::size_t i = 0; i < networks.size(); ++i)
                     solved |= evaluate(networks[i], told[i]);
                   return solved;
                 });
}

}  // namespace metamorph::evolve::testing
