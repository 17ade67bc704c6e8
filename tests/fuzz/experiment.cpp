// Experiment files: what is read comes back when it was written.

#include "evolve/experiment/experiment_file.h"
#include "tests/fuzz/contract.h"

using namespace metamorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  evolve::Experiment experiment;
  if (!fuzz::is_taken("toml", [&] {
        experiment = evolve::parse_experiment(fuzz::text_of(data, size), "toml");
      }))
    return 0;
  const std::string text = evolve::to_toml(experiment);
  fuzz::require(evolve::to_toml(evolve::parse_experiment(text, "written")) == text,
                "an experiment comes back", text);
  return 0;
}
