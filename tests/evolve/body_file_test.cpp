#include "evolve/files/body_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <nlohmann/json.hpp>

#include "evolve/files/input_error.h"
#include "tests/bodies.h"
#include "tests/evolve/files.h"

namespace metamorph::evolve {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::StartsWith;
using tests::Json;
using tests::lines_of;

std::vector<std::string> faults(const std::string& text) {
  return lines_of([&] { parse_body(text, "f"); });
}

/// Two triangles: nodes 0-3, springs [0,1] [0,2] [0,3] [1,2] [2,3].
Json square() {
  return {{"format", "metamorph-body/1"},
          {"nodes", {{0, 0}, {1, 0}, {1, 1}, {0, 1.5}}},
          {"triangles", {{0, 1, 2}, {0, 2, 3}}},
          {"period", {40, 41, 42, 43}},
          {"phase", {0, 0.5, -0.5, 3}}};
}

Json with(Json object, const std::string& pointer, const Json& value) {
  object[Json::json_pointer(pointer)] = value;
  return object;
}

void expect_same(const core::Body& a, const core::Body& b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.period, b.period);
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.springs, b.springs);
  EXPECT_EQ(a.rest_length, b.rest_length);
  EXPECT_EQ(a.rest_area, b.rest_area);
}

TEST(BodyFile, ReadsTheShortestForm) {
  const core::Body body = parse_body(square().dump(), "f");
  EXPECT_THAT(body.x, ElementsAre(0, 1, 1, 0));
  EXPECT_THAT(body.y, ElementsAre(0, 0, 1, 1.5));
  EXPECT_THAT(body.period, ElementsAre(40, 41, 42, 43));
  EXPECT_THAT(body.rest_length, ElementsAre(1, std::sqrt(2.0), 1.5, 1, std::sqrt(1.25)));
  EXPECT_THAT(body.rest_area, ElementsAre(0.5, 0.75));
}

TEST(BodyFile, SpringsMayComeInAnyOrderWithTheirLengths) {
  Json object = square();
  object["springs"] = {{3, 2}, {0, 1}, {2, 1}, {3, 0}, {0, 2}};
  object["rest_length"] = {5, 1, 4, 3, 2};
  object["rest_area"] = {0.25, 1};
  const core::Body body = parse_body(object.dump(), "f");
  EXPECT_EQ(body.springs, core::edges_of(body.triangles));
  EXPECT_THAT(body.rest_length, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(body.rest_area, ElementsAre(0.25, 1));
}

RC_GTEST_PROP(BodyFile, WriteReadWriteGivesTheSameBytes, ()) {
  core::Body body = tests::blob_body(*rc::gen::inRange(3, 60), *rc::gen::inRange<unsigned>(0, 999));
  if (*rc::gen::arbitrary<bool>()) body.rest_length[0] *= 1.0 + 1e-15;
  if (*rc::gen::arbitrary<bool>()) body.rest_area[0] = 1.0 / 3;
  body.x[0] = *rc::gen::element(body.x[0], -0.0, 0.0);
  body.phase[0] = *rc::gen::element(-0.0, 1e-300, 5e-324, 123456789012345678.0, -1e300);
  // Node 0 may have moved: keep only what is still sound.
  RC_PRE(core::check(body).empty());
  const std::string text = body_text(body);
  const core::Body again = parse_body(text, "f");
  expect_same(again, body);
  RC_ASSERT(std::signbit(again.x[0]) == std::signbit(body.x[0]));
  RC_ASSERT(body_text(again) == text);
}

struct BadBody {
  const char* name;
  Json json;
  std::vector<std::string> lines;
};

TEST(BodyFile, NamesEveryFault) {
  const Json good = square();
  const auto without = [&](const char* key) {
    Json object = good;
    object.erase(key);
    return object;
  };
  const std::string rows2 = "expected an array of [x, y]";
  const std::vector<BadBody> table = {
      {"no tag", without("format"), {"f: format: missing: expected \"metamorph-body/1\""}},
      {"other tag",
       with(good, "/format", "metamorph-genome/1"),
       {"f: format: \"metamorph-genome/1\": expected \"metamorph-body/1\""}},
      {"tag of a wrong type",
       with(good, "/format", 1),
       {"f: format: 1: expected \"metamorph-body/1\""}},
      {"unknown key",
       with(good, "/perod", 1),
       {"f: perod: unknown key: expected one of format, nodes, triangles, springs, period, phase, "
        "rest_length, rest_area"}},
      {"no nodes", without("nodes"), {"f: nodes: missing: " + rows2}},
      {"nodes mistyped", with(good, "/nodes", "four"), {"f: nodes: \"four\": " + rows2}},
      {"node short", with(good, "/nodes/1", {1}), {"f: nodes[1]: [1]: expected [x, y]"}},
      {"node long", with(good, "/nodes/1", {1, 2, 3}), {"f: nodes[1]: [1,2,3]: expected [x, y]"}},
      {"node mistyped", with(good, "/nodes/2/1", "a"), {"f: nodes[2]: [1,\"a\"]: expected [x, y]"}},
      {"node null", with(good, "/nodes/0", nullptr), {"f: nodes[0]: null: expected [x, y]"}},
      {"no triangles",
       without("triangles"),
       {"f: triangles: missing: expected an array of [i, j, k]"}},
      {"triangles empty",
       with(good, "/triangles", Json::array()),
       {"f: triangles: 0: expected at least 1"}},
      {"triangle of two",
       with(good, "/triangles/0", {0, 1}),
       {"f: triangles[0]: [0,1]: expected [i, j, k], three node numbers"}},
      {"triangle not integer",
       with(good, "/triangles/0/1", 1.5),
       {"f: triangles[0]: [0,1.5,2]: expected [i, j, k], three node numbers"}},
      {"triangle index huge",
       with(good, "/triangles/0/1", 1ull << 63),
       {"f: triangles[0]: [0,9223372036854775808,2]: expected [i, j, k], three node numbers"}},
      {"triangle index out of range",
       with(good, "/triangles/1/2", 4),
       {"f: triangles[1]: [0, 2, 4]: expected node numbers from 0 to 3"}},
      {"triangle index negative",
       with(good, "/triangles/1/2", -1),
       {"f: triangles[1]: [0, 2, -1]: expected node numbers from 0 to 3"}},
      {"clockwise",
       with(good, "/triangles", {{0, 2, 1}, {0, 3, 2}}),
       {"f: triangles[0]: [0, 2, 1] with area -0.5: expected counter-clockwise nodes, area > 0",
        "f: triangles[1]: [0, 3, 2] with area -0.75: expected counter-clockwise nodes, area > 0"}},
      {"isolated",
       with(with(with(good, "/nodes/4", {9, 9}), "/period/4", 40), "/phase/4", 0),
       {"f: nodes[4]: isolated: expected a triangle that has it"}},
      {"coincident",
       with(good, "/nodes/3", {1, 1.0001}),
       {"f: nodes[3]: [1, 1.0001]: expected at least 0.001 from node 2"}},
      {"springs mistyped",
       with(good, "/springs", {{"a", 1}}),
       {"f: springs: an object: expected an array of [i, j], two node numbers"}},
      {"a spring too many",
       with(good, "/springs", {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}, {3, 1}}),
       {"f: springs[5]: [1, 3]: expected the edge of a triangle, lower node first"}},
      {"a spring too few",
       with(good, "/springs", {{0, 1}, {0, 2}, {0, 3}, {1, 2}}),
       {"f: springs: no [2, 3]: expected every edge of a triangle"}},
      {"no period",
       without("period"),
       {"f: period: missing: expected an array of numbers, one per node"}},
      {"period mistyped",
       with(good, "/period", 40),
       {"f: period: 40: expected an array of numbers"}},
      {"a period too few",
       with(good, "/period", {1, 2, 3}),
       {"f: period: 3 values: expected 4, one per node"}},
      {"a period mistyped",
       with(good, "/period/1", "x"),
       {"f: period[1]: \"x\": expected a number"}},
      {"a period out of range",
       with(good, "/period/2", 0),
       {"f: period[2]: 0: expected a finite number >= 0.001"}},
      {"no phase",
       without("phase"),
       {"f: phase: missing: expected an array of numbers, one per node"}},
      {"a phase mistyped", with(good, "/phase/3", true), {"f: phase[3]: true: expected a number"}},
      {"rest lengths too few",
       with(good, "/rest_length", {1, 2}),
       {"f: rest_length: 2 values: expected 5, one per spring"}},
      {"rest length out of range",
       with(good, "/rest_length", {1, 1, -1, 1, 1}),
       {"f: rest_length[2]: -1: expected at least 0.001"}},
      {"rest length mistyped",
       with(good, "/rest_length", {1, 1, nullptr, 1, 1}),
       {"f: rest_length[2]: null: expected a number"}},
      {"rest area out of range",
       with(good, "/rest_area", {1e-4, 1}),
       {"f: rest_area[0]: 1e-04: expected at least 0.001"}},
      {"rest area mistyped",
       with(good, "/rest_area", "big"),
       {"f: rest_area: \"big\": expected an array of numbers"}},
      {"all at once",
       with(with(with(good, "/period/0", -2), "/phase/1", "p"), "/nodes/3", {1, 1}),
       {"f: phase[1]: \"p\": expected a number",
        "f: period[0]: -2: expected a finite number >= 0.001",
        "f: nodes[3]: [1, 1]: expected at least 0.001 from node 2",
        "f: triangles[1]: [0, 2, 3] with area 0: expected counter-clockwise nodes, area > 0"}},
  };
  for (const BadBody& bad : table) EXPECT_EQ(faults(bad.json.dump()), bad.lines) << bad.name;
}

TEST(BodyFile, NamesWhatIsNoJson) {
  EXPECT_THAT(faults(""), ElementsAre("f: line 1, column 1: the file ends: expected more JSON"));
  EXPECT_THAT(faults("[1, 2]"), ElementsAre("f: [1,2]: expected a JSON object"));
  EXPECT_THAT(faults("{\n  \"format\": NaN}"),
              ElementsAre("f: line 2, column 13: 'N': expected valid JSON"));
  EXPECT_THAT(faults("{} {}"), ElementsAre("f: line 1, column 4: '{': expected valid JSON"));
  EXPECT_THAT(faults("{\"phase\": [1e999]}"), ElementsAre("f: 1e999: expected a finite number"));
  EXPECT_THAT(faults("{\"phase\": [], \"phase\": []}"),
              ElementsAre("f: phase: given twice: expected it once"));
  EXPECT_THAT(faults("{\"a\": \"\xff\"}"), ElementsAre(StartsWith("f: line 1, column ")));
  EXPECT_THAT(faults("{\"a\": " + std::string(1000000, '[')),
              ElementsAre("f: deeply nested JSON: expected at most 16 levels"));
}

TEST(BodyFile, CutAnywhereItIsRefusedInOneLine) {
  const std::string text = body_text(tests::triangle_body());
  for (std::size_t size = 0; size + 2 < text.size(); ++size) {  // all but the last "}\n"
    const auto lines = faults(text.substr(0, size));
    ASSERT_EQ(lines.size(), 1u) << size;
    ASSERT_THAT(lines[0], StartsWith("f: line ")) << size;
  }
}

RC_GTEST_PROP(BodyFile, DamagedTextIsReadOrRefusedInLines, ()) {
  std::string text = body_text(tests::hexagon_body());
  const int damages = *rc::gen::inRange(1, 6);
  for (int i = 0; i < damages; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        text[at] = *rc::gen::arbitrary<char>();
        break;
      case 1:
        text.erase(at, *rc::gen::inRange<std::size_t>(1, 40));
        break;
      default:
        text.insert(at, *rc::gen::element<std::string>("-", "1e9", "[", "]", ",", "{}", "null",
                                                       "\"", "1e400", "0", ":"));
    }
    RC_PRE(!text.empty());
  }
  try {
    RC_ASSERT(core::check(parse_body(text, "f")).empty());
  } catch (const InputError& error) {
    RC_ASSERT(!error.lines().empty());
    for (const std::string& line : error.lines()) {
      RC_ASSERT(line.rfind("f: ", 0) == 0);
      RC_ASSERT(line.find("expected ") != std::string::npos);
      RC_ASSERT(line.find('\n') == std::string::npos);
    }
  }
}

TEST(BodyFile, FilesThatAreNone) {
  const tests::TemporaryDirectory directory;
  const auto missing = directory.path() / "missing.json";
  EXPECT_THAT(lines_of([&] { read_body(missing); }),
              ElementsAre(missing.string() + ": no such file: expected a file that can be read"));
  EXPECT_THAT(lines_of([&] { read_body(directory.path()); }),
              ElementsAre(directory.path().string() + ": a directory: expected a file"));
}

TEST(BodyFile, WritesWholeFilesAndOverwritesOnlyWhenTold) {
  const tests::TemporaryDirectory directory;
  const auto file = directory.path() / "body.json";
  const core::Body small = tests::triangle_body(), large = tests::hexagon_body();
  write_body(file, small, Overwrite::no);
  expect_same(read_body(file), small);
  EXPECT_THAT(lines_of([&] { write_body(file, large, Overwrite::no); }),
              ElementsAre(file.string() + ": exists already: expected a new file, or --overwrite"));
  expect_same(read_body(file), small);
  write_body(file, large, Overwrite::yes);
  expect_same(read_body(file), large);
  EXPECT_THAT(directory.names(), ElementsAre("body.json"));

  const auto nowhere = directory.path() / "no" / "body.json";
  EXPECT_THAT(lines_of([&] { write_body(nowhere, small, Overwrite::no); }),
              ElementsAre(nowhere.string() + ": no such directory: expected " +
                          nowhere.parent_path().string() + " to exist"));
  EXPECT_THAT(
      lines_of([&] { write_body(directory.path(), small, Overwrite::yes); }),
      ElementsAre(directory.path().string() + ": a directory: expected the name of a file"));
}

}  // namespace
}  // namespace metamorph::evolve
