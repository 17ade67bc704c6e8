#include "evolve/files/embryo_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "evolve/files/body_file.h"
#include "tests/bodies.h"
#include "tests/embryos.h"
#include "tests/evolve/files.h"

namespace metamorph::evolve {
namespace {

using tests::Json;

TEST(EmbryoFile, HoldsEveryCellLinkAndTheBody) {
  const core::Body strip = tests::strip_body(10);
  std::vector<tests::Point> points;
  for (std::size_t i = 0; i < strip.x.size(); ++i) points.emplace_back(strip.x[i], strip.y[i]);
  core::Embryo embryo = tests::embryo_at(tests::jittered(points));
  embryo.step = 600;
  embryo.created = 12;
  embryo.died = 2;
  embryo.orientation[3] = -std::numbers::pi / 3;
  const core::Extraction extraction = core::extract_body(embryo);
  ASSERT_EQ(extraction.status, core::Status::ok);

  const Json json = Json::parse(embryo_text(embryo, extraction));
  EXPECT_EQ(json.size(), 7u);
  EXPECT_EQ(json["format"], "metamorph-embryo/1");
  EXPECT_EQ(json["step"], 600);
  EXPECT_EQ(json["created"], 12);
  EXPECT_EQ(json["died"], 2);
  ASSERT_EQ(json["cells"].size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    const Json expected = {{"id", embryo.id[i]},
                           {"x", embryo.x[i]},
                           {"y", embryo.y[i]},
                           {"orientation", embryo.orientation[i]},
                           {"birth_step", embryo.birth_step[i]},
                           {"mother", embryo.mother[i]},
                           {"period", embryo.period[i]},
                           {"phase", embryo.phase[i]}};
    EXPECT_EQ(json["cells"][i], expected);
  }
  EXPECT_EQ(json["links"], Json(embryo.links));
  EXPECT_EQ(body_text(parse_body(json["body"].dump(), "f")), body_text(extraction.body));
}

TEST(EmbryoFile, WithoutABodySaysNull) {
  const core::Embryo embryo;
  const Json json = Json::parse(embryo_text(embryo, core::extract_body(embryo)));
  EXPECT_TRUE(json["body"].is_null());
  EXPECT_EQ(json["cells"], Json::array());
  EXPECT_EQ(json["links"], Json::array());
}

}  // namespace
}  // namespace metamorph::evolve
