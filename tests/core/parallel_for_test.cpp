// An exception leaves a parallel loop as it leaves any other.

#include "core/body/parallel_for.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace metamorph::core {
namespace {

constexpr std::size_t many = 3000;

template <Schedule schedule>
void every_item_comes_once() {
  for (const int threads : {1, 2, 7}) {
    std::vector<int> plain(1000), owned(1000);
    parallel_for<schedule>(plain.size(), threads, [&](std::size_t i) { ++plain[i]; });
    std::atomic<int> made = 0;
    parallel_for<schedule>(
        owned.size(), threads, [&] { return ++made; },
        [&](int& own, std::size_t i) { owned[i] += own > 0 ? 1 : 0; });
    EXPECT_EQ(plain, std::vector<int>(1000, 1)) << threads;
    EXPECT_EQ(owned, plain) << threads;
    EXPECT_EQ(made, threads);
  }
}

TEST(ParallelFor, EveryItemComesOnce) {
  every_item_comes_once<Schedule::equal>();
  every_item_comes_once<Schedule::dynamic>();
}

/// Items from `first` on throw their index. Returns what left the loop, counting what has run.
template <class Loop>
std::string thrown_by(const Loop& loop, std::size_t first, std::atomic<std::size_t>& ran) {
  try {
    loop([&](std::size_t i) {
      ++ran;
      if (i >= first) throw std::runtime_error(std::to_string(i));
    });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

template <Schedule schedule>
void the_first_exception_leaves() {
  for (const int threads : {1, 2, 7}) {
    for (const std::size_t first : {std::size_t{0}, std::size_t{17}, many / 2, many - 1, many}) {
      std::atomic<std::size_t> ran = 0, ran_owned = 0;
      const auto plain = [&](const auto& item) { parallel_for<schedule>(many, threads, item); };
      const auto owned = [&](const auto& item) {
        parallel_for<schedule>(
            many, threads, [] { return 0; }, [&](int&, std::size_t i) { item(i); });
      };
      const std::string expected = first == many ? "nothing" : std::to_string(first);
      EXPECT_EQ(thrown_by(plain, first, ran), expected) << threads;
      EXPECT_EQ(thrown_by(owned, first, ran_owned), expected) << threads;
      EXPECT_GE(ran, first == many ? many : first + 1);
      if (threads == 1 && first < many) {
        EXPECT_EQ(ran, first + 1);
        EXPECT_EQ(ran_owned, first + 1);
      }
    }
  }
}

TEST(ParallelFor, TheExceptionOfTheLowestIndexLeaves) {
  the_first_exception_leaves<Schedule::equal>();
  the_first_exception_leaves<Schedule::dynamic>();
}

TEST(ParallelFor, OthersStopSoon) {
  // The second thread has the later half for itself, of which no item throws: seconds of work.
  std::atomic<int> ran = 0;
  const auto item = [&](std::size_t i) {
    if (i == 0) throw std::bad_alloc();
    ++ran;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  EXPECT_THROW(parallel_for<Schedule::equal>(10000, 2, item), std::bad_alloc);
  EXPECT_LT(ran, 4000);
}

TEST(ParallelFor, WhatAThreadNeedsMayThrow) {
  for (const int threads : {1, 2, 7}) {
    for (int failing = 1; failing <= threads; ++failing) {
      std::atomic<int> made = 0;
      const auto make = [&] {
        if (++made == failing) throw std::bad_alloc();
        return 0;
      };
      const auto item = [](int&, std::size_t) {};
      EXPECT_THROW(parallel_for<Schedule::equal>(many, threads, make, item), std::bad_alloc);
      made = 0;
      EXPECT_THROW(parallel_for<Schedule::dynamic>(many, threads, make, item), std::bad_alloc);
    }
  }
}

}  // namespace
}  // namespace metamorph::core
