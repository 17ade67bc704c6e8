#include "evolve/run/integrity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>

#include "tests/evolve/damage.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::lines_of;
using tests::run_whole;
using tests::TemporaryDirectory;
using tests::tiny_experiment;

template <class... Cells>
TableDigest digest_of_row(Cells... cells) {
  RowHash hash;
  TableDigest digest;
  (hash.add(cells), ...);
  hash.end_row(digest);
  return digest;
}

TEST(TableDigest, TellsRowsApart) {
  const std::string_view empty, a = "a", b = "b", ab = "ab";
  const std::int64_t one = 1, two = 2;
  RowHash hash;
  TableDigest null;
  hash.add_null();
  hash.end_row(null);
  std::set<std::uint64_t> sums = {null.sum};
  const TableDigest rows[] = {digest_of_row(one),
                              digest_of_row(two),
                              digest_of_row(1.5),
                              digest_of_row(-1.5),
                              digest_of_row(one, two),
                              digest_of_row(two, one),
                              digest_of_row(a, b),
                              digest_of_row(ab, empty),
                              digest_of_row(empty, ab),
                              digest_of_row(empty),
                              digest_of_row(a),
                              digest_of_row(0.1 + 0.2),
                              digest_of_row(0.3),
                              digest_of_row(1e300),
                              digest_of_row(std::int64_t{1} << 62),
                              digest_of_row(-1e300),
                              digest_of_row(std::int64_t{0})};
  for (const TableDigest& row : rows) sums.insert(row.sum);
  EXPECT_EQ(sums.size(), std::size(rows) + 1);
}

// SQLite gives a whole number in a column of reals back as a real, and a zero without its sign.
TEST(TableDigest, IsOfTheValueNotOfItsType) {
  EXPECT_EQ(digest_of_row(3.0), digest_of_row(std::int64_t{3}));
  EXPECT_EQ(digest_of_row(-0.0), digest_of_row(0.0));
  RowHash hash;
  TableDigest null;
  hash.add_null();
  hash.end_row(null);
  EXPECT_EQ(digest_of_row(std::numeric_limits<double>::quiet_NaN()), null);
}

RC_GTEST_PROP(TableDigest, IsOfRowsInAnyOrder, (std::vector<std::pair<int, std::string>> rows)) {
  const auto digest_of_all = [&] {
    RowHash hash;
    TableDigest digest;
    for (const auto& [number, text] : rows) {
      hash.add(std::int64_t{number});
      hash.add(std::string_view(text));
      hash.end_row(digest);
    }
    return digest;
  };
  const TableDigest before = digest_of_all();
  std::reverse(rows.begin(), rows.end());
  RC_ASSERT(digest_of_all() == before);
  rows.emplace_back(1, "more");
  RC_ASSERT(digest_of_all() != before);
}

class DamagedRecord : public testing::Test {
 protected:
  DamagedRecord() { run_whole(path(), tiny_experiment("novelty", 3)); }
  std::filesystem::path path() const { return directory_.path() / "run"; }
  std::filesystem::path copy() const {
    const std::filesystem::path to = directory_.path() / "copy";
    std::filesystem::remove_all(to);
    std::filesystem::copy(path(), to);
    return to;
  }
  /// The lines that resume has for a copy that was changed.
  std::vector<std::string> resumed_after(const std::string& sql) const {
    Database(copy() / "run.db", Database::Mode::write).run(sql);
    return lines_of([&] { Record::resume(directory_.path() / "copy", 1); });
  }

  TemporaryDirectory directory_;
};

TEST_F(DamagedRecord, EveryChangeOfARowIsTold) {
  // Table and generation where they are known: what still can be trusted is everything else.
  const std::vector<std::pair<std::string, std::string>> damages = {
      {"DELETE FROM archive WHERE number > 3", "table archive"},
      {"UPDATE archive SET behaviour = substr(behaviour, 1, 20) || ']' WHERE number = 0",
       "table archive"},
      {"UPDATE archive SET novelty = novelty * (1 + 1e-15) + 1e-300 WHERE number = 1",
       "table archive"},
      {"UPDATE individuals SET score = score + 1e-9 WHERE generation = 1 AND position = 2",
       "table individuals, generation 1"},
      {"DELETE FROM outcomes WHERE generation = 2 AND position = 0",
       "table outcomes, generation 2"},
      {"UPDATE descriptors SET growth = NULL WHERE generation = 0",
       "table descriptors, generation 0"},
      {"INSERT INTO generations SELECT 7, champion, best_eq6, mean_eq6, best_score, mean_score "
       "FROM generations WHERE generation = 1",
       "table generations, generation 7"},
      {"UPDATE champions SET genome = replace(genome, '1', '2') WHERE generation = 2",
       "table champions, generation 2"},
      {"UPDATE status_counts SET count = count + 1 WHERE generation = 1",
       "table status_counts, generation 1"},
      {"DELETE FROM trials", "table trials"},
      {"UPDATE trials SET scene = 'land'", "table trials"},
      {"UPDATE run SET value = replace(value, 'population = 12', 'population = 13') WHERE key = "
       "'configuration'",
       "table run"},
      {"DELETE FROM species", "table species"},
      {"UPDATE timings SET seconds = 1 WHERE generation = 1", "table timings, generation 1"},
      {"UPDATE work SET developed = 1 WHERE generation = 1", "table work, generation 1"},
      {"UPDATE sessions SET value = 'x' WHERE key = 'compiler'", "table sessions, session 1"},
      {"DELETE FROM digests WHERE number = 1", "table digests, generation 1: is missing"},
      {"DELETE FROM digests", "table digests: is empty"},
      {"UPDATE digests SET sum = sum + 1 WHERE number = 2 AND \"table\" = 'species'",
       "table digests"},
      {"DELETE FROM session_digests WHERE \"table\" = 'work' AND number = 0",
       "table work: digests of 2 generations: expected 3"},
      {"UPDATE checkpoint SET generation = 2", "checkpoint of generation 2: expected 3"},
      {"CREATE TABLE more (a)", "table sqlite_master"},
      {"DROP VIEW metamorphosis", "table sqlite_master"}};
  for (const auto& [sql, where] : damages) {
    EXPECT_THAT(resumed_after(sql), ElementsAre(HasSubstr("run.db: damaged: " + where))) << sql;
  }
  EXPECT_TRUE(resumed_after("SELECT 1").empty());
}

TEST_F(DamagedRecord, WhatIsNotDamagedCanStillBeRead) {
  Database(path() / "run.db", Database::Mode::write)
      .run("UPDATE individuals SET score = 1 WHERE generation = 1");
  const RunReader run(path());
  const auto csv = [&](const std::string& table) {
    std::string text;
    const auto lines =
        lines_of([&] { run.write_csv(table, [&](std::string_view part) { text += part; }); });
    return lines.empty() ? text : lines[0] + (text.empty() ? "" : " after all");
  };
  EXPECT_THAT(csv("individuals"), HasSubstr("table individuals, generation 1"));
  EXPECT_THAT(csv("individuals"), testing::Not(HasSubstr("after all")));  // not half a table
  EXPECT_THAT(csv("outcomes"), HasSubstr("\n2,"));
  EXPECT_EQ(run.best().statuses.size(), 2u);
  EXPECT_THAT(lines_of([&] { run.verify(); }), ElementsAre(HasSubstr("table individuals")));
  EXPECT_THAT(lines_of([&] { audit(run, {}); }), ElementsAre(HasSubstr("table individuals")));
}

TEST_F(DamagedRecord, FalsifiedIsNotDamaged) {
  tests::falsify(path(), "UPDATE archive SET novelty = 7 WHERE number = 1");
  RunReader(path()).verify();
  EXPECT_TRUE(lines_of([&] { Record::resume(path(), 1); }).empty());
}

TEST_F(DamagedRecord, MoreGenerationsAreNoDamage) {
  Record::resume(path(), 1)->change_generations(5);
  RunReader(path()).verify();
  EXPECT_EQ(RunReader(path()).experiment().generations, 5);
}

// Every flipped bit that changes what is said must be told; of bytes that hold nothing it need not.
TEST_F(DamagedRecord, NoFlippedBitIsSilent) {
  const std::string whole = tests::text_of(path() / "run.db");
  const std::vector<std::string> truth = tests::readings_of(path());
  const std::filesystem::path damaged = copy();
  for (std::size_t n = 0; n < 60; ++n) {
    std::string bytes = whole;
    const std::size_t place = (n * 2654435761u) % whole.size();
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << (n % 8)));
    std::ofstream(damaged / "run.db", std::ios::binary) << bytes;
    const std::vector<std::string> found = tests::readings_of(damaged);
    for (std::size_t r = 0; r < truth.size(); ++r) {
      EXPECT_TRUE(found[r] == truth[r] || found[r] == "refused")
          << "bit " << n % 8 << " of byte " << place << ", reading " << r << ":\n"
          << found[r] << "\ninstead of\n"
          << truth[r];
    }
  }
}

}  // namespace
}  // namespace metamorph::evolve
