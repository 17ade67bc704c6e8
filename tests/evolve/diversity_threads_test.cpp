// Searches of maps and fronts: the same bits for any number of threads, and from what was saved.

#include <gtest/gtest.h>

#include "evolve/search/niches.h"
#include "tests/evolve/told_search.h"

namespace metamorph::evolve {
namespace {

using tests::invented;
using tests::two_axes;

TEST(DiversitySearches, ThreadsAndSavingChangeNoBit) {
  for (const std::string kind : {"map-elites", "nslc", "dns", "nsga2"}) {
    SCOPED_TRACE(kind);
    SearchSetup setup = two_axes(kind, 40);
    setup.settings.values["niches"] = 25;
    const auto whole = make_search(setup);
    const std::vector<Table> tables = whole->tables();
    std::vector<std::vector<Row>> rows(tables.size());
    const auto rows_of = [&](const Table& table) {
      std::size_t t = 0;
      while (tables[t].name != table.name) ++t;
      return rows[t];
    };
    setup.threads = 2;
    auto pieces = make_search(setup);
    for (int g = 0; g < 12; ++g) {
      EXPECT_EQ(whole->save(), pieces->save());
      const Asked a = whole->ask(), b = pieces->ask();
      ASSERT_EQ(a.genomes, b.genomes);
      EXPECT_EQ(a.lineage, b.lineage);
      const Told of_whole = whole->tell(invented(a)), of_pieces = pieces->tell(invented(b));
      EXPECT_EQ(of_whole.scores, of_pieces.scores);
      ASSERT_EQ(of_whole.rows, of_pieces.rows);
      ASSERT_EQ(of_whole.rows.size(), rows.size());
      for (std::size_t t = 0; t < rows.size(); ++t) {
        for (const Row& row : of_whole.rows[t]) {
          EXPECT_EQ(row.size(), tables[t].columns.size());
          rows[t].push_back(row);
        }
      }
      setup.threads = 1 + g % 3;
      auto loaded = make_search(setup);
      loaded->load(pieces->save(), rows_of);
      pieces = std::move(loaded);
    }
  }
}

TEST(Niches, AreTheSameForAnyNumberOfThreads) {
  const Niches one = Niches::centroidal(40, 3, 1);
  EXPECT_EQ(one.centres(), Niches::centroidal(40, 3, 2).centres());
  EXPECT_EQ(one.centres(), Niches::centroidal(40, 3, 5).centres());
}

}  // namespace
}  // namespace metamorph::evolve
