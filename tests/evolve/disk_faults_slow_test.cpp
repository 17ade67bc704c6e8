// A disk that fails: every call of a run, each in a run of its own.

#include <cerrno>

#include "tests/evolve/disk_fault_sweep.h"

namespace metamorph::evolve {
namespace {

using tests::DiskFault;
using tests::DiskFaultSweep;
using Kind = DiskFault::Kind;
using Calls = DiskFault::Calls;

class EveryCall : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    if (!sweep_.is_supported()) GTEST_SKIP() << "the kernel cannot be asked to tell of calls";
  }
  DiskFault fault(Kind kind, Calls calls, int error = 0) const {
    return {kind, calls, error, 0, 0, GetParam()};
  }
  DiskFaultSweep sweep_;
};

TEST_P(EveryCall, FailsOnce) { sweep_.meet(fault(Kind::error, Calls::all, EIO), false, 1); }
TEST_P(EveryCall, AndAllAfterItFail) { sweep_.meet(fault(Kind::error, Calls::all, EIO), true, 1); }
TEST_P(EveryCall, FindsNoRoomOnce) {
  sweep_.meet(fault(Kind::error, Calls::growing, ENOSPC), false, 1);
}
TEST_P(EveryCall, AndAllAfterItFindNoRoom) {
  sweep_.meet(fault(Kind::error, Calls::growing, ENOSPC), true, 1);
}
TEST_P(EveryCall, WritesHalf) { sweep_.meet(fault(Kind::short_half, Calls::writes), false, 1); }
TEST_P(EveryCall, AndAllAfterItWriteHalf) {
  sweep_.meet(fault(Kind::short_half, Calls::writes), true, 40);
}
TEST_P(EveryCall, IsTheLast) { sweep_.meet(fault(Kind::kill, Calls::all), false, 1); }

INSTANTIATE_TEST_SUITE_P(OnLocalDiskAndNfs, EveryCall, testing::Bool());

}  // namespace
}  // namespace metamorph::evolve
