// How far pages show evolved animats from where they were.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "evolve/experiment/experiment_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/replay/track_code.h"

namespace metamorph::evolve {
namespace {

Experiment water_to_land() {
  return parse_experiment(
      "name = \"water-to-land\"\n"
      "[[trials]]\nname = \"larva\"\nstage = 600\nscene = \"water\"\n"
      "[[trials]]\nname = \"adult\"\nstage = 1200\nscene = \"land\"\n",
      "water-to-land", {});
}

TEST(PictureError, OfTenEvolvedAnimatsIsSmallAndSoAreTheirTracks) {
  const Experiment experiment = water_to_land();
  int tracks = 0;
  for (const std::string name : {"evolved-1", "evolved-4", "evolved-7", "solid-1", "solid-2",
                                 "solid-3", "solid-4", "solid-5", "solid-6", "solid-7"}) {
    const Genome genome = read_genome(METAMORPH_BENCH_GENOMES "/" + name + ".json");
    for (const Motion& motion : life_of(experiment, genome, 0, {}).motions) {
      if (motion.status != core::Status::ok) continue;
      ++tracks;
      const PackedTrack packed = pack(motion.track);
      const TrackError error = error_of(motion.track, packed);
      std::size_t bytes = 0;
      for (const std::string& chunk : packed.chunks) bytes += chunk.size();
      fmt::print(
          "{:9} {}: {:3} nodes, {} frames, one of {} kept, {:3} kB; {:.3f} % beyond 0.01 d, "
          "worst {:.4f} d\n",
          name, motion.name, motion.body.node_count(), packed.frames, packed.every, bytes / 1000,
          100 * error.far_share, error.worst);
      EXPECT_LE(error.far_share, 0.001) << name << " " << motion.name;
      EXPECT_LE(error.worst, 0.05) << name << " " << motion.name;
      // Larva and adult in base64, with copies of neither, stay below the 1.5 MB of a page.
      EXPECT_LT(bytes, 500000u) << name << " " << motion.name;
    }
  }
  EXPECT_GE(tracks, 18);
}

}  // namespace
}  // namespace metamorph::evolve
