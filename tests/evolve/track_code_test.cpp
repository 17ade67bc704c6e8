#include "evolve/replay/track_code.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "evolve/replay/base64.h"

namespace metamorph::evolve {
namespace {

/// A point that comes at some frame, moves, jumps and goes.
Course any_course() {
  Course course;
  course.first = *rc::gen::inRange(0, 600);
  const int frames = *rc::gen::inRange(0, 600);
  // Far beyond what 32 bits hold, as a body that slid away.
  double x = *rc::gen::inRange(-1000000000, 1000000000), y = 0.1;
  const double speed = *rc::gen::inRange(-100, 100) / 77.0;
  for (int k = 0; k < frames; ++k) {
    course.x.push_back(x += speed);
    course.y.push_back(y *= -1.01);
  }
  return course;
}

RC_GTEST_PROP(TrackCode, GivesEveryCoordinateBackWithinHalfAStep, ()) {
  std::vector<Course> courses;
  for (int n = *rc::gen::inRange(0, 6); n > 0; --n) courses.push_back(any_course());
  std::vector<Course> read = courses;
  for (Course& course : read) {
    std::fill(course.x.begin(), course.x.end(), 1e30);
    std::fill(course.y.begin(), course.y.end(), 1e30);
  }
  unpack(pack(courses), read);
  for (std::size_t i = 0; i < courses.size(); ++i) {
    for (std::size_t k = 0; k < courses[i].x.size(); ++k) {
      RC_ASSERT(std::abs(read[i].x[k] - courses[i].x[k]) <= coordinate_step / 2);
      RC_ASSERT(std::abs(read[i].y[k] - courses[i].y[k]) <= coordinate_step / 2);
    }
  }
}

/// The frames kept of f(frame).
template <class F>
std::vector<double> kept_of(F f, int every, int frames) {
  std::vector<double> kept;
  for (int k = 0; k * every < frames - 1; ++k) kept.push_back(f(k * every));
  kept.push_back(f(frames - 1));
  return kept;
}

TEST(ShownAt, IsExactForStraightLinesToTheLastFrame) {
  const auto line = [](double frame) { return 3 - 0.25 * frame; };
  for (const int frames : {2, 3, 10, 11, 12, 13}) {
    for (const int every : {1, 2, 3, 5}) {
      const std::vector<double> kept = kept_of(line, every, frames);
      for (double frame = 0; frame <= frames - 1; frame += 0.25) {
        EXPECT_NEAR(shown_at(kept, every, frames, frame), line(frame), 1e-12)
            << frames << " " << every << " " << frame;
      }
    }
  }
}

TEST(ShownAt, IsExactForParabolasBetweenInnerFrames) {
  const auto parabola = [](double frame) { return frame * frame; };
  const std::vector<double> kept = kept_of(parabola, 5, 31);
  for (double frame = 5; frame <= 25; frame += 0.5) {
    EXPECT_NEAR(shown_at(kept, 5, 31, frame), parabola(frame), 1e-9);
  }
}

TEST(ShownAt, OfASingleFrameIsThatFrame) { EXPECT_EQ(shown_at(std::vector{4.5}, 8, 1, 0), 4.5); }

Track waves(int frames, double frequency) {
  Track track;
  track.interval = 0.2;
  for (int f = 0; f < frames; ++f) {
    track.x.push_back({std::sin(frequency * f), 2 + 0.001 * f});
    track.y.push_back({std::cos(frequency * f), 0});
  }
  return track;
}

TEST(PackedTrack, KeepsTheFramesThatAMotionNeeds) {
  const PackedTrack slow = pack(waves(700, 0.01)), fast = pack(waves(700, 1.5));
  EXPECT_EQ(slow.every, 8);
  EXPECT_EQ(fast.every, 1);
  EXPECT_EQ(fast.chunks.size(), 3u);
  for (const double frequency : {0.01, 0.2, 1.5}) {
    const Track track = waves(701, frequency);
    const TrackError error = error_of(track, pack(track));
    EXPECT_LE(error.far_share, picture_far_share);
    EXPECT_LE(error.worst, picture_worst);
    EXPECT_GT(error.worst, 0);
  }
}

TEST(PackedTrack, OfAnotherMotionIsFarOff) {
  const TrackError error = error_of(waves(700, 0.02), pack(waves(700, 0.01)));
  EXPECT_GT(error.worst, 1);
  EXPECT_GT(error.far_share, 0.4);  // one node of two, nearly always
}

TEST(PackedTrack, OfNoFrameAndOfOne) {
  EXPECT_TRUE(pack(Track{0.2, {}, {}}).chunks.empty());
  const Track one{0.2, {{1.5}}, {{-2}}};
  const PackedTrack packed = pack(one);
  EXPECT_EQ(packed.chunks.size(), 1u);
  EXPECT_EQ(error_of(one, packed).worst, 0);
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("\xff\xef\xbe"), "/+++");
}

}  // namespace
}  // namespace metamorph::evolve
