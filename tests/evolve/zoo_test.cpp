#include "evolve/view/zoo.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "tests/bodies.h"
#include "tests/evolve/files.h"

namespace metamorph::evolve {
namespace {

Stage stage_of(const std::string& title, core::Body body, bool ground, Point went) {
  Stage stage;
  stage.title = title;
  stage.scene = ground ? "land" : "water";
  stage.ground = ground;
  stage.body = std::move(body);
  stage.outcome = core::Outcome{};
  stage.outcome->mean_position = {went.x, went.y};
  stage.outcome->distance = std::hypot(went.x, went.y);
  return stage;
}

/// Larvae of different sizes and their adults.
std::vector<Exhibit> exhibits(int count) {
  std::vector<Exhibit> all;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<unsigned>(i + 1);
    all.push_back({fmt::format("seed {}", i),
                   {stage_of("larva", tests::blob_body(20 + i, seed), false, {3, 4}),
                    stage_of("adult", tests::blob_body(50 + 5 * i, seed), true, {-7, 2})},
                   {600}});
  }
  return all;
}

Sheet zoo(int count, int columns) {
  ZooStyle style;
  style.columns = columns;
  return zoo_sheet(exhibits(count), style);
}

std::vector<std::size_t> lengths(const Sheet& sheet) {
  std::vector<std::size_t> lengths;
  for (const auto& row : sheet.rows) lengths.push_back(row.size());
  return lengths;
}

TEST(Zoo, FillsBlocksOfRowsEvenly) {
  EXPECT_EQ(lengths(zoo(0, 8)), (std::vector<std::size_t>{}));
  EXPECT_EQ(lengths(zoo(8, 8)), (std::vector<std::size_t>{8, 8}));
  EXPECT_EQ(lengths(zoo(9, 8)), (std::vector<std::size_t>{5, 5, 4, 4}));
  EXPECT_EQ(lengths(zoo(5, 2)), (std::vector<std::size_t>{2, 2, 2, 2, 1, 1}));
}

TEST(Zoo, TellsOfEachHowFarItMovedAndOfAllWhere) {
  const Sheet sheet = zoo(3, 2);
  EXPECT_EQ(sheet.rows[0][1].title, "seed 1");
  EXPECT_EQ(sheet.rows[0][1].caption, "5.0 d");
  EXPECT_EQ(sheet.rows[1][1].title, "");
  EXPECT_EQ(sheet.remark, "from above: larva in water, adult on land");
  std::vector<Exhibit> mixed = exhibits(2);
  std::swap(mixed[1].stages[0], mixed[1].stages[1]);
  const Sheet told = zoo_sheet(mixed, {});
  EXPECT_EQ(told.remark, "");
  EXPECT_EQ(told.rows[0][0].caption, "5.0 d in water");
  EXPECT_EQ(told.rows[0][1].caption, "7.3 d on land");
}

TEST(Zoo, WhatWalksStandsOnOneLine) {
  const Sheet sheet = zoo(3, 3);
  for (const Panel& panel : sheet.rows[1]) {
    EXPECT_DOUBLE_EQ(panel.box.height(), sheet.rows[1][0].box.height());
  }
}

TEST(Zoo, AStageWithoutABodyIsAnEmptyPlaceThatSaysWhy) {
  std::vector<Exhibit> all = exhibits(4);
  const core::Status why[] = {core::Status::empty, core::Status::no_body,
                              core::Status::bad_development};
  for (std::size_t i = 0; i < 3; ++i) {
    all[i].stages[0].body = {};
    all[i].stages[0].outcome = core::Outcome{.status = why[i]};
  }
  all[3].stages[0].outcome = core::Outcome{.status = core::Status::inverted};
  all[3].stages.pop_back();
  const Sheet sheet = zoo_sheet(all, {});
  ASSERT_EQ(lengths(sheet), (std::vector<std::size_t>{4, 4}));
  const std::string words[] = {"no cell alive", "no body", "no body (bad_development)"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(sheet.rows[0][i].box.empty);
    EXPECT_EQ(sheet.rows[0][i].caption, words[i]);
    EXPECT_FALSE(sheet.rows[1][i].box.empty);
  }
  EXPECT_FALSE(sheet.rows[0][3].box.empty);
  EXPECT_EQ(sheet.rows[0][3].caption, "0.0 d in water (inverted)");
  EXPECT_TRUE(sheet.rows[1][3].box.empty);  // it has no such stage
  const tests::TemporaryDirectory folder;
  write_sheet(sheet, folder.path() / "a.svg", Overwrite::no);
}

TEST(Zoo, HistoryTellsPhasesAndNoMovement) {
  const Sheet sheet = zoo_sheet(exhibits(2), {CellColours::phase, false, 8});
  EXPECT_EQ(sheet.legend, Legend::phase);
  EXPECT_EQ(sheet.rows[1][0].caption, "");
  EXPECT_LT(sheet.rows[0][0].box.width(), zoo(2, 8).rows[0][0].box.width());  // no arrow
  EXPECT_EQ(zoo(2, 8).legend, Legend::birth);
  EXPECT_EQ(zoo(2, 8).stages, 2);
}

/// From the middle of its tail to its tip: the arrow of a picture with one, in layout pixels, y
/// down.
Point arrow_in(const std::string& svg) {
  const std::string number = R"( (-?[0-9.]+) (-?[0-9.]+) )";
  std::string polygon = R"(fill:rgb\(13%,15%,19%\);fill-opacity:1;" d="M)" + number;  // ink
  for (int i = 0; i < 6; ++i) polygon += "L" + number;
  std::smatch arrow;
  if (!std::regex_search(svg, arrow, std::regex(polygon + "Z? ?(?:M [-0-9. ]+)?\""))) return {};
  const auto value = [&](std::size_t i) { return std::stod(arrow[i]); };
  return {value(7) - (value(1) + value(13)) / 2, value(8) - (value(2) + value(14)) / 2};
}

TEST(Zoo, ArrowsPointWhereItMoved) {
  const tests::TemporaryDirectory folder;
  const auto drawn = [&](bool ground, Point went) {
    const std::vector<Exhibit> one = {
        {"", {stage_of("larva", tests::blob_body(30, 4), ground, went)}, {}}};
    write_sheet(zoo_sheet(one, {}), folder.path() / "a.svg", Overwrite::yes);
    const Point arrow = arrow_in(tests::text_of(folder.path() / "a.svg"));
    const double length = std::hypot(arrow.x, arrow.y);
    return Point{arrow.x / length, -arrow.y / length};
  };
  for (double angle = -3; angle <= 3; angle += 0.75) {
    const Point went{6 * std::cos(angle), 6 * std::sin(angle)};
    const Point swam = drawn(false, went), walked = drawn(true, went);
    EXPECT_NEAR(swam.x, std::cos(angle), 1e-3);
    EXPECT_NEAR(swam.y, std::sin(angle), 1e-3);
    EXPECT_NEAR(walked.x, went.x > 0 ? 1 : -1, 1e-3);  // along the ground
    EXPECT_NEAR(walked.y, 0, 1e-3);
  }
}

TEST(Zoo, TheSameAnimatsGiveTheSameBytes) {
  const tests::TemporaryDirectory folder;
  for (const std::string ending : {".svg", ".png"}) {
    for (const std::string name : {"a", "b"}) {
      Sheet sheet = zoo(3, 2);
      sheet.density = 0.5;
      write_sheet(sheet, folder.path() / (name + ending), Overwrite::no);
    }
    const std::string once = tests::text_of(folder.path() / ("a" + ending));
    EXPECT_GT(once.size(), 1000u);
    EXPECT_EQ(once, tests::text_of(folder.path() / ("b" + ending)));
  }
}

}  // namespace
}  // namespace metamorph::evolve
