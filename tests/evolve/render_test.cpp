// The command render, run as a person would run it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/view/motion.h"
#include "tests/bodies.h"
#include "tests/evolve/program.h"
#include "tests/evolve/runs.h"
#include "tests/evolve/svg.h"

namespace metamorph::evolve {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;
using tests::run_program;

/// Cells turn by where they are, and fill the plane.
Genome blob_genome() {
  Genome genome;
  for (int id = 0; id < 13; ++id) {
    genome.nodes.push_back({id, id < 6 ? NodeKind::input : NodeKind::output});
  }
  genome.links = {{1, 0, 7, 6.0}, {2, 1, 7, 5.0}, {3, 2, 7, -4.0}, {4, 5, 7, 1.0}};
  return genome;
}

class Render : public ::testing::Test {
 protected:
  Render() {
    write_genome(here() / "blob.json", blob_genome(), Overwrite::no);
    write_body(here() / "strip.json", tests::strip_body(20), Overwrite::no);
  }
  std::filesystem::path here() const { return directory_.path(); }
  tests::ProgramResult render(const std::string& arguments) const {
    return run_program(here(), "render " + arguments);
  }
  tests::Svg svg(const std::string& name) const {
    return tests::read_svg(tests::text_of(here() / name));
  }

 private:
  tests::TemporaryDirectory directory_;
};

TEST_F(Render, DrawsEveryKindOfAGenome) {
  for (const std::string kind : {"animat", "development", "motion", "phase"}) {
    const auto result = render("blob.json --kind " + kind + " --out " + kind + ".svg");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(svg(kind + ".svg").fault, "") << kind;
    EXPECT_GT(svg(kind + ".svg").drawn_paths, 8) << kind;  // a body has eight nodes at least
  }
}

TEST_F(Render, DrawsABody) {
  EXPECT_EQ(render("strip.json --out a.svg").exit_code, 0);
  EXPECT_EQ(render("strip.json --kind motion --scene land --out b.svg").exit_code, 0);
  for (const std::string name : {"a.svg", "b.svg"}) {
    EXPECT_EQ(svg(name).fault, "") << name;
    EXPECT_GT(svg(name).drawn_paths, 18) << name;  // 18 triangles
  }
}

TEST_F(Render, DrawsManyGenomesAndBodies) {
  EXPECT_EQ(render("blob.json strip.json --kind zoo --scene land --out a.svg").exit_code, 2);
  EXPECT_EQ(render("blob.json blob.json --kind zoo --out a.svg").exit_code, 0);
  EXPECT_EQ(render("blob.json strip.json --kind zoo --colours phase --out b.svg").exit_code, 0);
  for (const std::string name : {"a.svg", "b.svg"}) EXPECT_EQ(svg(name).fault, "") << name;
  EXPECT_EQ(render("strip.json --kind zoo --scene land --out c.png --density 0.5").exit_code, 0);
}

TEST_F(Render, DrawsManyChampionsOfRuns) {
  for (const int seed : {1, 2}) {
    tests::run_whole(here() / fmt::format("run{}", seed),
                     tests::tiny_experiment("simple", 4, static_cast<std::uint64_t>(seed)));
  }
  const auto drawn = [&](const std::string& arguments) {
    const auto result = render(arguments + " --overwrite --out drawn.svg");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(svg("drawn.svg").fault, "");
    return tests::text_of(here() / "drawn.svg");
  };
  const auto letters = [&](const std::string& arguments) {
    const std::string text = drawn(arguments);
    int count = 0;
    for (std::size_t at = text.find("<use "); at != text.npos; at = text.find("<use ", at + 1)) {
      ++count;
    }
    return count;
  };
  // Every animat has its title, "generation 3" or "seed 1", perhaps "no cell alive" twice.
  const auto adds = [](int animats) { return AllOf(Ge(12 * animats), Le(38 * animats)); };
  const int one = letters("run1 --kind history --generations 3");
  const int two = letters("run1 --kind history --generations 0,3");
  EXPECT_THAT(two - one, adds(1));
  EXPECT_EQ(letters("run1 --kind history --generations 3,0,3"), two);
  EXPECT_THAT(letters("run1 --kind history --count 3") - one, adds(2));
  EXPECT_THAT(letters("run1 --kind history") - one, adds(3));  // of four generations
  EXPECT_GT(letters("run1 run2 run1 --kind zoo"), letters("run1 run2 --kind zoo") + 5);
  EXPECT_EQ(drawn("run1 run2 --kind zoo"), drawn("run1 run2 --kind zoo"));

  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const auto result = render(arguments + " --out none.svg");
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err_lines(), ElementsAre(HasSubstr(why)));
    EXPECT_FALSE(std::filesystem::exists(here() / "none.svg"));
  };
  refused("run1 --kind history --generations 1,4",
          "--generations: 4: expected generations from 0 to 3, those of run1/run.db");
  refused("run1 run2 --kind history", "expected one run");
  refused("blob.json --kind history", "expected one run");
  refused("run1 run2 --kind zoo --generations 1", "--generations: expected one run");
  refused("run1 run2 --kind zoo --count 2", "--count: expected one run");
  refused("run1 run2 --kind animat", "2 of them: expected one for --kind animat");
  refused("run1 --kind motion --count 3", "--count: not of --kind motion");
  refused("run1 --kind zoo --at 100", "--at: not of --kind zoo: expected development");
  refused("run1 --kind phase --snapshots 3", "--snapshots: not of --kind phase: expected motion");
  refused("run1 --kind map", "expected a run of map-elites");
  refused("run1 --kind front", "expected a run of nsga2");
  refused("run1 run2 --kind map", "2 of them: expected one for --kind map");
  refused("blob.json --kind front", "expected a run for --kind front");
  refused("run1 --kind map --generation 1", "--generation: not of --kind map");
  refused("run1 --kind history --generation 1", "expected --generations");
  refused("run1 blob.json --kind zoo --generation 1", "expected a run, not a genome");
  refused("run1 blob.json --kind zoo --set development.max_cells=30", "not together with a run");
  refused("run1 run2 --kind zoo --generation 9", "expected a generation below 4");
}

TEST(Svg, IsReadOrItsFaultTold) {
  const auto read = [](const std::string& body) {
    return tests::read_svg("<?xml version=\"1.0\"?>\n" + body);
  };
  const tests::Svg sound = read(
      "<svg a=\"1\" b=\"x &lt; y\">\n<defs><path d=\"M 0 0 L 1 1\"/></defs><!-- < -->\n"
      "<g><path d=\"M 0 0 L 1 1 Z\"/><path d=\"M 0 0\"/><path d=\"M 0 0 C 1 1\" /></g></svg>\n");
  EXPECT_EQ(sound.fault, "");
  EXPECT_EQ(sound.drawn_paths, 2);
  for (const std::string broken :
       {"<svg><g></svg>", "<svg></g></svg>", "<svg>", "<svg/><svg/>", "<html></html>", "",
        "<svg a=1/>", "<svg a=\"1/>", "<svg a=\"1\"b=\"2\"/>", "<svg a=\"1\" a=\"2\"/>",
        "<svg>a & b</svg>", "<svg>< g/></svg>", "<svg/>more", "<svg><!-- </svg>"}) {
    EXPECT_NE(read(broken).fault, "") << broken;
  }
  EXPECT_NE(tests::read_svg("<svg/>").fault, "");
}

TEST_F(Render, TellsWhatWasExpectedInOneLine) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const auto result = render(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err_lines(), ElementsAre(HasSubstr(words)));
  };
  refused("blob.json --out a.jpg", "expected a name that ends in .svg, .png or .pdf");
  refused("none.json --out a.svg", "none.json");
  refused("blob.json --out a.svg --kind motion --trial tadpole", "expected larva or adult");
  refused("blob.json --out a.svg --kind development --at 9999", "expected steps from 0 to 1200");
  refused("strip.json --out a.svg --kind development", "expected animat, motion or phase");
}

TEST_F(Render, OverwritesNothingUnasked) {
  ASSERT_EQ(render("strip.json --out a.svg").exit_code, 0);
  EXPECT_EQ(render("strip.json --out a.svg").exit_code, 2);
  EXPECT_EQ(render("strip.json --out a.svg --overwrite").exit_code, 0);
}

TEST(LastCycle, SnapshotsAreEvenlySpreadUpToTheEndOfTheRun) {
  const core::Body body = tests::strip_body(20);  // every period is 40
  core::Scene scene = core::water_scene();
  scene.run_steps = 1000;  // 200 time units
  const auto snapshots = last_cycle(body, scene, {}, 4);
  ASSERT_EQ(snapshots.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    // Integrator steps of 0.2: the nearest one is at most half a step away.
    EXPECT_NEAR(snapshots[k].time, 170 + 10.0 * static_cast<double>(k), 0.1 + 1e-9);
    EXPECT_EQ(snapshots[k].x.size(), body.x.size());
  }
}

}  // namespace
}  // namespace metamorph::evolve
