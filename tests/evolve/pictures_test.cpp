// The pictures of the best that a run keeps.

#include "evolve/run/pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "evolve/run/run.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::HasSubstr;
using tests::TemporaryDirectory;
using tests::tiny_experiment;

// What was drawn may be of a session that was killed before its last picture, or not be there.
TEST(Pictures, AreDrawnAnewWhereARunGoesOn) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  PictureReporter pictures;
  {
    Record record(path, tiny_experiment("simple", 3), 1);
    run(record, {1, {}, {&pictures}});
  }
  EXPECT_EQ(pictures.failure(), "");
  const std::string svg = tests::text_of(path / "best.svg"),
                    png = tests::text_of(path / "best.png");
  std::filesystem::remove(path / "best.svg");
  std::ofstream(path / "best.png") << "an older best";
  {
    const std::unique_ptr<Record> record = Record::resume(path, 1);
    run(*record, {1, {}, {&pictures}});
  }
  EXPECT_TRUE(tests::text_of(path / "best.svg") == svg);
  EXPECT_TRUE(tests::text_of(path / "best.png") == png);
}

// A picture that fails is told only if no later one takes its place.
TEST(Pictures, OnlyTheLastFailureCounts) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  PictureReporter pictures;
  Record record(path, tiny_experiment("simple", 3), 1);
  std::filesystem::create_directory(path / "best.svg");
  run(record, {1, [&] { return record.generations_done() == 1; }, {&pictures}});
  EXPECT_THAT(pictures.failure(), HasSubstr("best.svg: a directory"));
  std::filesystem::remove(path / "best.svg");
  run(record, {1, {}, {&pictures}});
  EXPECT_EQ(pictures.failure(), "");
}

}  // namespace
}  // namespace metamorph::evolve
