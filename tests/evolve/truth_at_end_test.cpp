// What a run says at its end, when its directory was not left alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/evolve/damage.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::lines_of;
using tests::TemporaryDirectory;
using tests::tiny_experiment;

class TruthAtEnd : public testing::Test {
 protected:
  std::filesystem::path path() const { return directory_.path() / "run"; }
  /// The lines of a run whose directory is changed after its second generation.
  std::vector<std::string> lines_after(const std::function<void()>& change) {
    return lines_of([&] {
      Record record(path(), tiny_experiment("simple", 4), 1);
      int generations = 0;
      run(record, {1,
                   [&] {
                     if (++generations == 3) change();
                     return false;
                   },
                   {}});
      record.close();
    });
  }

  TemporaryDirectory directory_;
};

TEST_F(TruthAtEnd, AWholeRunSaysNothing) {
  EXPECT_TRUE(lines_after([] {}).empty());
  EXPECT_THAT(directory_.names(), ElementsAre("run"));
  EXPECT_FALSE(std::filesystem::exists(path() / "run.db-wal"));
  RunReader(path()).verify();
}

TEST_F(TruthAtEnd, ADeletedDirectoryIsTold) {
  EXPECT_THAT(lines_after([&] { std::filesystem::remove_all(path()); }),
              ElementsAre(HasSubstr("run.db: was deleted, moved or replaced")));
}

TEST_F(TruthAtEnd, ADeletedRecordIsTold) {
  EXPECT_THAT(lines_after([&] { std::filesystem::remove(path() / "run.db"); }),
              ElementsAre(HasSubstr("run.db: was deleted, moved or replaced")));
}

TEST_F(TruthAtEnd, AReplacedRecordIsToldAndLeftAlone) {
  EXPECT_THAT(lines_after([&] {
                std::filesystem::copy(path() / "run.db", path() / "other");
                std::filesystem::rename(path() / "other", path() / "run.db");
              }),
              ElementsAre(HasSubstr("run.db: was deleted, moved or replaced")));
}

TEST_F(TruthAtEnd, AMovedDirectoryIsToldAndWhole) {
  EXPECT_THAT(
      lines_after([&] { std::filesystem::rename(path(), directory_.path() / "elsewhere"); }),
      ElementsAre(HasSubstr("run.db: was deleted, moved or replaced")));
  EXPECT_EQ(RunReader(directory_.path() / "elsewhere").generations_done(), 2);
}

TEST_F(TruthAtEnd, ALockThatIsGoneIsTold) {
  EXPECT_THAT(lines_after([&] { std::filesystem::remove(path() / "run.lock"); }),
              ElementsAre(HasSubstr("run.lock was deleted or replaced")));
  std::vector<std::string> lines = lines_of([&] { Record::resume(path(), 1); });
  EXPECT_TRUE(lines.empty());
}

// What was half done for a generation is undone, and the record is closed as if it had not begun.
TEST_F(TruthAtEnd, AGenerationThatCannotBeWrittenLeavesTheOnesBeforeWhole) {
  Record record(path(), tiny_experiment("simple", 4), 1);
  const auto change = [&](const char* sql) {
    Database(path() / "run.db", Database::Mode::write).run(sql);
  };
  int generations = 0;
  const auto refuse_third = [&] {
    if (++generations == 3) {
      change(
          "CREATE TRIGGER refuse BEFORE INSERT ON session_digests BEGIN SELECT RAISE(ABORT, "
          "'refused'); END");
    }
    return false;
  };
  EXPECT_THAT(lines_of([&] { run(record, {1, refuse_third, {}}); }),
              ElementsAre(HasSubstr("refused")));
  change("DROP TRIGGER refuse");
  record.close();
  const RunReader reader(path());
  reader.verify();
  EXPECT_EQ(reader.generations_done(), 2);
}

// Copied while it is written, without the log that stands beside it: an earlier state of the run,
// with its experiment, and no word of deleting anything.
TEST_F(TruthAtEnd, ACopyWithoutItsLogIsAnEarlierState) {
  const std::filesystem::path copy = directory_.path() / "copy";
  std::filesystem::create_directory(copy);
  EXPECT_TRUE(
      lines_after([&] { std::filesystem::copy(path() / "run.db", copy / "run.db"); }).empty());
  const RunReader reader(copy);
  EXPECT_EQ(reader.experiment().generations, 4);
  EXPECT_LE(reader.generations_done(), 2);
  const auto resumed = Record::resume(copy, 1);
  run(*resumed, {1, {}, {}});
  resumed->close();
  EXPECT_EQ(tests::contents(copy), tests::contents(path()));
}

}  // namespace
}  // namespace metamorph::evolve
