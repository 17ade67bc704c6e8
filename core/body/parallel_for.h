#pragma once

// Loops over threads that an exception may leave. OpenMP ends the program where one leaves a
// parallel region, so it is caught in there and thrown again behind the loop.

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>

namespace metamorph::core {

/// How the items of a loop are shared out among threads.
enum class Schedule {
  equal,   ///< each thread one piece of the same length: for items of the same cost
  dynamic  ///< to whichever thread is free, one by one, in ascending order
};

/// Of the exceptions of a parallel loop the one of the lowest index, whichever came first.
class FirstException {
 public:
  /// Calls run() as item `index`, unless an item before it has thrown: what its end depends on is
  /// thus done for any order and number of threads.
  template <class Run>
  void guard(std::ptrdiff_t index, const Run& run) noexcept {
    if (index > lowest_.load(std::memory_order_relaxed)) return;
    try {
      run();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (index >= lowest_.load(std::memory_order_relaxed)) return;
      lowest_.store(index, std::memory_order_relaxed);
      exception_ = std::current_exception();
    }
  }

  /// Behind the loop.
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic<std::ptrdiff_t> lowest_ = std::numeric_limits<std::ptrdiff_t>::max();
  std::mutex mutex_;
  std::exception_ptr exception_;
};

/// item(i) for all i < count, on `threads` threads (above 0). Throws what the item of the lowest
/// index throws of those that do; items behind it may then be left out.
template <Schedule schedule, class Item>
void parallel_for(std::size_t count, int threads, const Item& item) {
  FirstException exception;
  const auto end = static_cast<std::ptrdiff_t>(count);
  const auto run = [&](std::ptrdiff_t i) {
    exception.guard(i, [&] { item(static_cast<std::size_t>(i)); });
  };
  if constexpr (schedule == Schedule::dynamic) {
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (std::ptrdiff_t i = 0; i < end; ++i) run(i);
  } else {
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::ptrdiff_t i = 0; i < end; ++i) run(i);
  }
  exception.rethrow();
}

/// item(own, i) for all i < count, where each thread has an `own` = make() for itself. What make()
/// throws comes before what items throw.
template <Schedule schedule, class Make, class Item>
void parallel_for(std::size_t count, int threads, const Make& make, const Item& item) {
  using Own = decltype(make());
  FirstException exception;
  const auto end = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel num_threads(threads)
  {
    std::unique_ptr<Own> own;
    exception.guard(-1, [&] { own.reset(new Own(make())); });
    // A thread without one goes on too: all threads of a team have to come to its loop. No item
    // runs, as all are behind -1.
    const auto run = [&](std::ptrdiff_t i) {
      exception.guard(i, [&] { item(*own, static_cast<std::size_t>(i)); });
    };
    if constexpr (schedule == Schedule::dynamic) {
#pragma omp for schedule(dynamic)
      for (std::ptrdiff_t i = 0; i < end; ++i) run(i);
    } else {
#pragma omp for schedule(static)
      for (std::ptrdiff_t i = 0; i < end; ++i) run(i);
    }
  }
  exception.rethrow();
}

}  // namespace metamorph::core
