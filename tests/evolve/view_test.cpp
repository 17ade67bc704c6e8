#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "evolve/view/draw.h"
#include "tests/bodies.h"
#include "tests/embryos.h"
#include "tests/evolve/files.h"
#include "tests/evolve/svg.h"

namespace metamorph::evolve {
namespace {

constexpr int larva_steps = 600;
constexpr std::array starts = {larva_steps};

// The embryo whose body is `body`: cells at its nodes, the last `red` of them born late.
core::Embryo embryo_like(const core::Body& body, int red) {
  std::vector<tests::Point> points;
  for (std::size_t i = 0; i < body.x.size(); ++i) points.emplace_back(body.x[i], body.y[i]);
  core::Embryo embryo = tests::embryo_of(points, body.triangles, body.springs);
  for (int i = 0; i < embryo.cell_count(); ++i) {
    embryo.birth_step[static_cast<std::size_t>(i)] =
        i < embryo.cell_count() - red ? 0 : larva_steps;
  }
  embryo.step = red > 0 ? 1200 : larva_steps;
  return embryo;
}

Stage stage_like(core::Body body, int red, bool ground) {
  Stage stage;
  stage.title = ground ? "adult" : "larva";
  stage.scene = ground ? "land" : "water";
  stage.ground = ground;
  stage.embryo = embryo_like(body, red);
  body.cell.clear();
  for (core::Index i = 0; i < body.node_count(); ++i) body.cell.push_back(i);
  stage.body = std::move(body);
  stage.outcome = core::Outcome{};
  stage.outcome->distance = 12.5;
  stage.outcome->mean_position = {-10, 7.5};
  return stage;
}

Sheet sample_sheet() {
  const std::vector<Stage> stages = {stage_like(tests::blob_body(40, 1), 0, false),
                                     stage_like(tests::blob_body(90, 2), 50, true)};
  Sheet sheet = champion_sheet(stages, starts);
  sheet.heading = "Champion <1> & \"friends\"";
  return sheet;
}

class Pictures : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.path() / name; }

 private:
  tests::TemporaryDirectory folder_;
};

bool is_well_formed(const std::string& svg) { return tests::read_svg(svg).fault.empty(); }

TEST_F(Pictures, SvgIsWellFormed) {
  write_sheet(sample_sheet(), file("a.svg"), Overwrite::yes);
  EXPECT_TRUE(is_well_formed(tests::text_of(file("a.svg"))));
}

TEST_F(Pictures, TheSameSheetGivesTheSameBytesOfSvg) {
  write_sheet(sample_sheet(), file("a.svg"), Overwrite::yes);
  write_sheet(sample_sheet(), file("b.svg"), Overwrite::yes);
  EXPECT_GT(tests::text_of(file("a.svg")).size(), 1000u);
  EXPECT_EQ(tests::text_of(file("a.svg")), tests::text_of(file("b.svg")));
}

TEST_F(Pictures, PngHasTwoPixelsPerUnitOfTheSvg) {
  write_sheet(sample_sheet(), file("a.svg"), Overwrite::yes);
  write_sheet(sample_sheet(), file("a.png"), Overwrite::yes);
  const std::string svg = tests::text_of(file("a.svg")), png = tests::text_of(file("a.png"));
  std::smatch size;
  ASSERT_TRUE(
      std::regex_search(svg, size, std::regex(R"r(width="([0-9.]+)pt" height="([0-9.]+))r")));
  ASSERT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto big_endian = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i)
      value = 256 * value + static_cast<unsigned char>(png[at + i]);
    return value;
  };
  // Cairo writes the SVG's size to six digits; half a pixel of rounding on top.
  EXPECT_NEAR(big_endian(16), 2 * std::stod(size[1]), 0.51);
  EXPECT_NEAR(big_endian(20), 2 * std::stod(size[2]), 0.51);
}

TEST_F(Pictures, PdfIsWritten) {
  write_sheet(sample_sheet(), file("a.pdf"), Overwrite::yes);
  EXPECT_EQ(tests::text_of(file("a.pdf")).substr(0, 5), "%PDF-");
}

TEST_F(Pictures, OtherEndingsAndUnwritablePlacesAreRefused) {
  EXPECT_TRUE(is_picture_file("x.svg"));
  EXPECT_FALSE(is_picture_file("x.jpg"));
  EXPECT_THROW(write_sheet(sample_sheet(), file("a.jpg"), Overwrite::yes), std::runtime_error);
  EXPECT_THROW(write_sheet(sample_sheet(), file("none/a.svg"), Overwrite::yes), std::runtime_error);
  EXPECT_THROW(write_sheet(sample_sheet(), file("none/a.png"), Overwrite::yes), std::runtime_error);
}

TEST_F(Pictures, StagesWithoutCellsOrBodyAreDrawn) {
  Stage nothing;
  nothing.title = "larva";
  const std::vector<Stage> stages = {nothing, stage_like(tests::hexagon_body(), 0, true)};
  write_sheet(champion_sheet(stages, starts), file("a.svg"), Overwrite::yes);
  write_sheet(phase_sheet(stages), file("b.svg"), Overwrite::yes);
  write_sheet(Sheet{}, file("c.svg"), Overwrite::yes);
  for (const char* name : {"a.svg", "b.svg", "c.svg"}) {
    EXPECT_TRUE(is_well_formed(tests::text_of(file(name)))) << name;
  }
}

TEST(Colours, StrainIsWhiteAtRestBlueContractedRedExpanded) {
  EXPECT_EQ(strain_colour(1), colours::paper);
  EXPECT_EQ(strain_colour(0), colours::contracted);
  EXPECT_EQ(strain_colour(2), colours::expanded);
  const Colour less = strain_colour(0.8), more = strain_colour(1.2);
  EXPECT_GT(less.blue, less.red);
  EXPECT_GT(more.red, more.blue);
}

TEST(Colours, PhaseIsCyclicAndEveryPhaseDiffersFromItsOpposite) {
  for (double phase = -3; phase < 3; phase += 0.25) {
    const Colour here = phase_colour(phase), round = phase_colour(phase + 2 * std::numbers::pi),
                 opposite = phase_colour(phase + std::numbers::pi);
    EXPECT_NEAR(here.red, round.red, 1e-9);
    EXPECT_NEAR(here.green, round.green, 1e-9);
    EXPECT_NEAR(here.blue, round.blue, 1e-9);
    EXPECT_GT(std::abs(here.red - opposite.red) + std::abs(here.green - opposite.green) +
                  std::abs(here.blue - opposite.blue),
              0.3);
  }
}

TEST(Panels, NodesOfCellsBornAtTheStageEndOrLaterAreNew) {
  core::Body body = tests::hexagon_body();
  core::Embryo embryo = embryo_like(body, 0);
  embryo.birth_step = {0, 599, 600, 601, 30, 1199, 570};
  body.cell = {6, 5, 4, 3, 2, 1, 0};
  EXPECT_EQ(birth_stages(body, embryo, starts), (BirthStages{0, 1, 0, 1, 1, 0, 0}));
  EXPECT_EQ(birth_stages(body, embryo, std::array{30, 600, 1199}),
            (BirthStages{1, 3, 1, 2, 2, 1, 0}));
  EXPECT_EQ(birth_stages(body, embryo, {}), BirthStages(7, 0));
}

TEST(Colours, OfBirthsInNeighbouringStagesDiffer) {
  for (int stage = 0; stage < 9; ++stage) {
    const Colour a = birth_colour(stage), b = birth_colour(stage + 1);
    EXPECT_GT(std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue),
              0.3);
  }
}

TEST(Panels, BoxesHoldWhatIsDrawn) {
  const core::Body body = tests::blob_body(60, 3);
  const auto [left, right] = std::minmax_element(body.x.begin(), body.x.end());
  const auto [bottom, top] = std::minmax_element(body.y.begin(), body.y.end());
  const Box embryo = embryo_panel(embryo_like(body, 0), starts).box;
  EXPECT_LE(embryo.left, *left - 0.5);
  EXPECT_GE(embryo.right, *right + 0.5);
  EXPECT_LE(embryo.bottom, *bottom - 0.5);
  EXPECT_GE(embryo.top, *top + 0.5);
  const Box plain = body_panel(body, {}).box;
  EXPECT_LE(plain.left, *left);
  EXPECT_GE(plain.top, *top);
  // An arrow three cells long, on the side to which it points.
  const Box arrow = body_panel(body, {}, Point{5, 0}).box;
  EXPECT_GT(arrow.right, plain.right);
  EXPECT_EQ(arrow.left, plain.left);
}

TEST(Sheets, DevelopmentIsDividedBehindTheLastLarvalStep) {
  const core::Body body = tests::hexagon_body();
  std::vector<core::Embryo> embryos(4, embryo_like(body, 0));
  const std::vector<core::Body> bodies(4, body);
  const int steps[] = {300, 600, 900, 1200};
  for (std::size_t i = 0; i < 4; ++i) embryos[i].step = steps[i];
  const auto lines = [&](const std::vector<int>& begin) {
    return development_sheet(embryos, bodies, begin).lines_after;
  };
  EXPECT_EQ(lines({600}), std::vector<int>{1});
  EXPECT_EQ(lines({1200}), std::vector<int>{});
  EXPECT_EQ(lines({200, 300, 1000}), (std::vector<int>{0, 2}));
}

TEST(Sheets, MotionFillsRowsOfColumns) {
  const core::Body body = tests::hexagon_body();
  const std::vector<Snapshot> snapshots(5, Snapshot{10.0, body.x, body.y});
  const Sheet sheet = motion_sheet(body, snapshots, true, 3);
  ASSERT_EQ(sheet.rows.size(), 2u);
  EXPECT_EQ(sheet.rows[0].size(), 3u);
  EXPECT_EQ(sheet.rows[1].size(), 2u);
  EXPECT_EQ(sheet.rows[1][1].caption, "t = 50");  // paper steps of 0.2 time units
}

}  // namespace
}  // namespace metamorph::evolve
