#include <gtest/gtest.h>

#include "evolve/run/audit.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using tests::run_whole;
using tests::TemporaryDirectory;
using tests::tiny_experiment;

TEST(AuditByThreads, IsTheSameForAnyNumber) {
  const TemporaryDirectory directory;
  run_whole(directory.path() / "run", tiny_experiment(SearchKind::simple, 6));
  const RunReader run(directory.path() / "run");
  AuditOptions one, two;
  one.threads = 1;
  two.threads = 2;
  const RunAudit a = audit(run, one), b = audit(run, two);
  ASSERT_EQ(a.champions.size(), b.champions.size());
  for (std::size_t c = 0; c < a.champions.size(); ++c) {
    EXPECT_EQ(a.champions[c].reference_eq6, b.champions[c].reference_eq6);
    EXPECT_EQ(a.champions[c].trials[1].nearby.spread, b.champions[c].trials[1].nearby.spread);
  }
  EXPECT_EQ(a.recorded.worst, b.recorded.worst);
}

}  // namespace
}  // namespace metamorph::evolve
