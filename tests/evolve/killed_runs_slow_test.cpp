// Every kind of search, killed at random moments two hundred times, is the one that never was.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "evolve/run/run_reader.h"
#include "metamorph/searches.h"
#include "tests/evolve/files.h"
#include "tests/evolve/killed_runs.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using tests::TemporaryDirectory;

TEST(KilledRuns, OfEverySearchAreTheSame) {
  const TemporaryDirectory directory;
  std::mt19937 random(2016);
  const int kinds = static_cast<int>(search_kinds().size()), kills_of_kind = 200 / kinds + 1;
  int all = 0;
  for (const SearchKind& search : search_kinds()) {
    const std::string kind(search.name);
    SCOPED_TRACE(kind);
    Experiment e = tests::tiny_experiment(kind, 8);
    const bool has_axes =
        std::any_of(search.settings.begin(), search.settings.end(),
                    [](const Setting& setting) { return setting.name == "axes"; });
    if (has_axes) {  // on which the bodies of so short runs differ
      e.search.values["axes"] = std::vector<std::string>{"larva.x", "adult.x"};
      e.search.values["axis_low"] = std::vector<double>{-1, -1};
      e.search.values["axis_high"] = std::vector<double>{1, 1};
    }
    const auto path = [&](const std::string& name) { return directory.path() / (kind + name); };
    std::ofstream(path(".toml")) << to_toml(e);
    const std::vector<std::string> arguments = {
        "evolve", path(".toml").string(), "--out", path("").string(), "--threads", "1"};
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(tests::Program(arguments).wait().exit_code, 0);
    const std::chrono::duration<double> length = std::chrono::steady_clock::now() - begin;
    const auto expected = tests::contents(path(""));
    const std::string picture = tests::text_of(path("") / "best.svg");
    ASSERT_FALSE(picture.empty());
    int kills = 0;
    for (int round = 0; kills < kills_of_kind; ++round) {
      ASSERT_LT(round, 10 * kills_of_kind);
      const auto out = path(fmt::format("-{}", round));
      kills += tests::run_and_kill(path(".toml").string(), out.string(), 5, length, random);
      RunReader(out).verify();
      EXPECT_EQ(tests::contents(out), expected) << round;
      EXPECT_TRUE(tests::text_of(out / "best.svg") == picture) << round;
      std::filesystem::remove_all(out);
    }
    all += kills;
  }
  std::printf("%d kills of %d searches\n", all, kinds);
}

}  // namespace
}  // namespace metamorph::evolve
