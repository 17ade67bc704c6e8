#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstring>

#if defined(__linux__)
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace metamorph::bench {

/// Counts the instructions and cycles that this thread spends in user code from construction to
/// report(). Where the system forbids that, nothing is counted and nothing reported.
class HardwareCounters {
 public:
#if defined(__linux__)
  HardwareCounters()
      : instructions_(open(PERF_COUNT_HW_INSTRUCTIONS)), cycles_(open(PERF_COUNT_HW_CPU_CYCLES)) {}
  ~HardwareCounters() {
    if (instructions_ >= 0) close(instructions_);
    if (cycles_ >= 0) close(cycles_);
  }
#else
  HardwareCounters() = default;
#endif
  HardwareCounters(const HardwareCounters&) = delete;
  HardwareCounters& operator=(const HardwareCounters&) = delete;

  /// Instructions and cycles per unit; `units`: of one iteration.
  void report(benchmark::State& state, double units) const {
    const double all = units * static_cast<double>(state.iterations());
    const auto add = [&](const char* name, int counter) {
      if (const double value = read_value(counter); value > 0) state.counters[name] = value / all;
    };
    add("instructions", instructions_);
    add("cycles", cycles_);
  }

 private:
#if defined(__linux__)
  static int open(std::uint64_t event) {
    perf_event_attr attributes;
    std::memset(&attributes, 0, sizeof attributes);
    attributes.type = PERF_TYPE_HARDWARE;
    attributes.size = sizeof attributes;
    attributes.config = event;
    attributes.exclude_kernel = 1;
    attributes.exclude_hv = 1;
    return static_cast<int>(syscall(SYS_perf_event_open, &attributes, 0, -1, -1, 0));
  }
  static double read_value(int counter) {
    std::uint64_t value = 0;
    if (counter < 0 || read(counter, &value, sizeof value) != sizeof value) return 0;
    return static_cast<double>(value);
  }
#else
  static double read_value(int) { return 0; }
#endif

  int instructions_ = -1, cycles_ = -1;
};

}  // namespace metamorph::bench
