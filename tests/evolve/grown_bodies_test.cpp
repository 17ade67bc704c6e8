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

TEST(GrownBodies, OfOldGenomeFilesAreTheSameBitsUnderAWiderExperiment) {
  core::DevelopmentRules wide;
  wide.inputs.push_back(core::Input::neighbours);
  std::vector<core::Network> of_file, of_wide;
  for (const auto& entry : std::filesystem::directory_iterator(METAMORPH_BENCH_GENOMES)) {
    const Genome genome = read_genome(entry.path(), wide);
    of_file.push_back(compile(genome));
    of_wide.push_back(compile(genome, shape_of(wide)));
  }
  const std::vector<int> stages = {600, 1200};
  const auto some = core::develop(of_file, {}, stages, 0);
  const auto same = core::develop(of_wide, wide, stages, 0);
  for (std::size_t i = 0; i < some.size(); ++i) {
    for (std::size_t s = 0; s < stages.size(); ++s) {
      const core::Embryo &a = some[i][s], &b = same[i][s];
      EXPECT_GT(a.cell_count(), 1);
      EXPECT_EQ(a.id, b.id);
      EXPECT_EQ(a.x, b.x);
      EXPECT_EQ(a.y, b.y);
      EXPECT_EQ(a.period, b.period);
      EXPECT_EQ(a.phase, b.phase);
      EXPECT_EQ(a.links, b.links);
    }
  }
}

}  // namespace
}  // namespace metamorph::evolve
