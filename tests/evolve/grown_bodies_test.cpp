// Bodies as development gives them are sound.

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "evolve/files/genome_file.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"

namespace metamorph::evolve {
namespace {

TEST(GrownBodies, OfEvolvedGenomesAreSoundAtEveryStage) {
  std::vector<core::Network> networks;
  for (const auto& entry : std::filesystem::directory_iterator(METAMORPH_BENCH_GENOMES)) {
    networks.push_back(compile(read_genome(entry.path())));
  }
  const core::DevelopmentRules rules;
  std::vector<int> stages;
  for (int step = 0; step <= rules.steps; step += 10) stages.push_back(step);
  int bodies = 0;
  for (const auto& embryos : core::develop(networks, rules, stages, 0)) {
    for (const core::Embryo& embryo : embryos) {
      const core::Extraction extraction = core::extract_body(embryo);
      if (extraction.status != core::Status::ok) continue;
      ++bodies;
      const auto faults = core::check(extraction.body);
      EXPECT_TRUE(faults.empty()) << embryo.step << ": " << faults.front().what;
    }
  }
  EXPECT_GT(bodies, 400);
}

}  // namespace
}  // namespace metamorph::evolve
