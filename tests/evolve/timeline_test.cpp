#include "evolve/film/timeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "evolve/view/colour.h"

namespace metamorph::evolve {
namespace {

using Kind = Shot::Kind;

/// Two stages that move for 600 time units each, the second from `frames` frames.
Life life_with(int frames) {
  Life life;
  life.end = 1000;
  for (const int stage : {400, 1000}) {
    Motion motion;
    motion.name = stage == 400 ? "larva" : "adult";
    motion.stage = stage;
    motion.track.x.resize(static_cast<std::size_t>(stage == 400 ? 10 : frames));
    life.motions.push_back(motion);
  }
  return life;
}

std::vector<Kind> kinds_of(const std::vector<Shot>& shots) {
  std::vector<Kind> kinds;
  for (const Shot& shot : shots) kinds.push_back(shot.kind);
  return kinds;
}

TEST(Timeline, OfALifeGoesFromTheEggThroughEveryStage) {
  const std::vector<Shot> shots = shots_of(life_with(10), FilmKind::life, "");
  EXPECT_THAT(kinds_of(shots), testing::ElementsAre(Kind::development, Kind::cut, Kind::motion,
                                                    Kind::development, Kind::cut, Kind::motion));
  EXPECT_EQ(shots[0].to, 400);
  EXPECT_EQ(shots[3].from, 400);
  EXPECT_EQ(shots[3].to, 1000);
  EXPECT_EQ(shots[5].motion, 1);
  // 1000 steps of 0.2, and twice 3000.
  EXPECT_DOUBLE_EQ(length_of(shots), 1400);
  EXPECT_EQ(cuts_of(shots), 2);
}

TEST(Timeline, ShowsOneTrialAloneAndNoMotionWithoutABody) {
  EXPECT_THAT(kinds_of(shots_of(life_with(10), FilmKind::motion, "adult")),
              testing::ElementsAre(Kind::cut, Kind::motion));
  EXPECT_TRUE(shots_of(life_with(10), FilmKind::motion, "tadpole").empty());
  EXPECT_EQ(shots_of(life_with(0), FilmKind::life, "").back().kind, Kind::cut);
  EXPECT_THAT(kinds_of(shots_of(life_with(10), FilmKind::development, "")),
              testing::ElementsAre(Kind::development));
}

TEST(Timeline, EverySecondHasItsMoment) {
  std::vector<Shot> shots = shots_of(life_with(10), FilmKind::life, "");
  set_seconds(shots, 20, 0.5);
  EXPECT_DOUBLE_EQ(seconds_of(shots), 1400 / 20.0 + 2 * 0.5);
  // 80 time units of development last 4 seconds.
  EXPECT_EQ(moment_at(shots, 1).shot.kind, Kind::development);
  EXPECT_DOUBLE_EQ(moment_at(shots, 1).part, 0.25);
  EXPECT_EQ(moment_at(shots, 4.25).shot.kind, Kind::cut);
  EXPECT_DOUBLE_EQ(moment_at(shots, 4.25).part, 0.5);
  EXPECT_DOUBLE_EQ(moment_at(shots, 4.5 + 15).part, 0.5);
  EXPECT_EQ(moment_at(shots, 1e6).shot.motion, 1);
  EXPECT_EQ(moment_at(shots, 1e6).part, 1);
}

TEST(SequentialColour, GetsLighterAllTheWay) {
  // Relative luminance as sRGB has it, by 2.2 instead of its curve.
  const auto luminance = [](const Colour& c) {
    return 0.2126 * std::pow(c.red, 2.2) + 0.7152 * std::pow(c.green, 2.2) +
           0.0722 * std::pow(c.blue, 2.2);
  };
  for (int i = 1; i <= 100; ++i) {
    EXPECT_GT(luminance(sequential_colour(i / 100.0)),
              luminance(sequential_colour((i - 1) / 100.0)));
  }
  EXPECT_EQ(sequential_colour(-1), sequential_colour(0));
  EXPECT_EQ(sequential_colour(2), sequential_colour(1));
}

}  // namespace
}  // namespace metamorph::evolve
