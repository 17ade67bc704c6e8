// A disk that fails: some of a run's calls, each in a run of its own. All of them in the slow tier.

#include <cerrno>

#include "tests/evolve/disk_fault_sweep.h"

namespace metamorph::evolve {
namespace {

using tests::DiskFault;
using tests::DiskFaultSweep;

TEST(DiskFaults, SomeCallsOfARun) {
  DiskFaultSweep sweep;
  if (!sweep.is_supported()) GTEST_SKIP() << "the kernel cannot be asked to tell of calls";
  using Kind = DiskFault::Kind;
  using Calls = DiskFault::Calls;
  long offset = 0;
  for (const bool on_nfs : {false, true}) {
    for (const bool lasting : {false, true}) {
      sweep.meet({Kind::error, Calls::all, EIO, 0, 0, on_nfs}, lasting, 500, offset += 17);
      sweep.meet({Kind::error, Calls::growing, ENOSPC, 0, 0, on_nfs}, lasting, 500, offset += 17);
    }
    sweep.meet({Kind::short_half, Calls::writes, 0, 0, 0, on_nfs}, false, 500, offset += 17);
    sweep.meet({Kind::kill, Calls::all, 0, 0, 0, on_nfs}, false, 500, offset -= 80);
  }
}

}  // namespace
}  // namespace metamorph::evolve
