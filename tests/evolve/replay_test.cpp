// The command replay, run as a person would run it. What a browser makes of its pages:
// tests/replay/page_test.py.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "evolve/files/body_file.h"
#include "evolve/replay/page_parts.h"
#include "evolve/run/run_reader.h"
#include "tests/bodies.h"
#include "tests/evolve/program.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using tests::Json;
using tests::run_program;

class Replay : public ::testing::Test {
 protected:
  Replay() { write_body(here() / "strip.json", tests::strip_body(20), Overwrite::no); }
  std::filesystem::path here() const { return directory_.path(); }
  tests::ProgramResult replay(const std::string& arguments) const {
    return run_program(here(), "replay " + arguments);
  }
  std::string page(const std::string& name) const { return tests::text_of(here() / name); }
  /// What the page holds in one of its elements of data.
  static Json data(const std::string& page, const std::string& id) {
    const std::string start = "<script type=\"application/json\" id=\"" + id + "\">";
    const std::size_t begin = page.find(start);
    EXPECT_NE(begin, std::string::npos) << id;
    const std::size_t end = page.find("</script>", begin);
    return Json::parse(page.substr(begin + start.size(), end - begin - start.size()));
  }

 private:
  tests::TemporaryDirectory directory_;
};

TEST_F(Replay, OfABodyIsAPageByItself) {
  const auto result = replay("strip.json --scene land --copies 2 --reference --out a.html");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("a.html: 1 animat"));
  const std::string text = page("a.html");
  EXPECT_THAT(text, HasSubstr("Content-Security-Policy"));
  EXPECT_THAT(text, HasSubstr("</html>"));
  for (const char* outside :
       {"src=\"http", "href=\"http", "@import", "url(", "fetch(", "import("}) {
    EXPECT_THAT(text, Not(HasSubstr(outside)));
  }
  EXPECT_EQ(data(text, "page")["command"],
            "metamorph replay strip.json --out a.html --scene land --copies 2 --reference");
  const Json life = data(text, "life-0");
  EXPECT_EQ(life["heading"], "strip");
  EXPECT_TRUE(life["genome"].is_null());
  EXPECT_TRUE(life["development"].is_null());
  const Json& motion = life["motions"].at(0);
  EXPECT_EQ(motion["scene"], "land");
  EXPECT_EQ(motion["ground"], true);
  EXPECT_EQ(motion["copies"].size(), 2u);
  EXPECT_EQ(motion["reference"]["frames"], motion["track"]["frames"]);
}

TEST(ReplayPage, IsOfLessThanFortyKilobytesOfCode) {
  EXPECT_LT(page_js.size(), 40000u);
  EXPECT_GT(page_js.size(), 10000u);  // it is there
  EXPECT_LT(page_html.size() + page_css.size(), 8000u);
}

TEST_F(Replay, OfARunTellsOfItsFitnessAndTheAncestors) {
  tests::run_whole(here() / "run", tests::tiny_experiment("simple", 4));
  ASSERT_EQ(replay("run --every-generation 1 --out a.html").exit_code, 0);
  const std::string text = page("a.html");
  const RunReader run(here() / "run");
  const Json told = data(text, "page")["runs"].at(0);
  EXPECT_EQ(data(text, "page")["lives"], 4);
  ASSERT_EQ(told["fitness"].size(), 4u);
  std::map<std::int64_t, Json> ancestors;
  for (const Json& row : told["ancestors"]) ancestors[row.at(0)] = row;
  for (int g = 0; g < 4; ++g) {
    const Champion champion = run.champion(g);
    const Json life = data(text, "life-" + std::to_string(g));
    EXPECT_NEAR(told["fitness"].at(static_cast<std::size_t>(g)).at(0), champion.eq6, 6e-4);
    EXPECT_EQ(life["generation"], g);
    EXPECT_EQ(life["individual"], champion.individual);
    // From child to parent to the first generation.
    int generation = g;
    for (Json row = ancestors.at(champion.individual); row.at(3) >= 0; --generation) {
      EXPECT_EQ(row.at(1), generation);
      row = ancestors.at(row.at(3));
    }
    EXPECT_EQ(generation, 0);
  }
}

TEST_F(Replay, TellsWhatWasExpectedInOneLine) {
  tests::run_whole(here() / "run", tests::tiny_experiment("simple", 1));
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const auto result = replay(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err_lines(), ElementsAre(HasSubstr(words)));
  };
  refused("strip.json --out a.htm", "expected a name that ends in .html");
  refused("none.json --out a.html", "none.json");
  refused("strip.json --out no/a.html", "no/a.html");
  refused("run --generations 7 --out a.html", "expected a generation below 1");
  refused("strip.json --generations 0 --out a.html", "expected a run, not a body");
  refused("strip.json --copies -1 --out a.html", "--copies");
  EXPECT_FALSE(std::filesystem::exists(here() / "a.html"));
}

TEST_F(Replay, OverwritesNothingUnasked) {
  ASSERT_EQ(replay("strip.json --out a.html").exit_code, 0);
  const std::string before = page("a.html");
  EXPECT_EQ(replay("strip.json --scene land --out a.html").exit_code, 2);
  EXPECT_EQ(page("a.html"), before);
  EXPECT_EQ(replay("strip.json --scene land --out a.html --overwrite").exit_code, 0);
  EXPECT_NE(page("a.html"), before);
}

TEST_F(Replay, NamesCannotEndTheirPlaceInThePage) {
  write_body(here() / "<b>&.json", tests::strip_body(10), Overwrite::no);
  ASSERT_EQ(replay("'<b>&.json' --out a.html").exit_code, 0);
  const std::string text = page("a.html");
  EXPECT_THAT(text, Not(HasSubstr("<b>")));
  EXPECT_THAT(text, HasSubstr("<title>&lt;b&gt;&amp;.json</title>"));
  EXPECT_EQ(data(text, "life-0")["heading"], "<b>&");
}

}  // namespace
}  // namespace metamorph::evolve
