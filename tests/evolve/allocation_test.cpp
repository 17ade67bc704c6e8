// No memory, at any allocation: it is told as std::bad_alloc, nothing is lost, and what comes
// afterwards is right. This program has operators new and delete of its own.

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "evolve/experiment/memory_estimate.h"
#include "tests/evolve/runs.h"
#include "tests/outcomes.h"

namespace {

constexpr long never = std::numeric_limits<long>::max();

std::atomic<long> allocations = 0;              ///< made since the last plan
std::atomic<long> first = never, last = never;  ///< those that fail
std::atomic<long> blocks = 0;                   ///< that exist
std::atomic<std::size_t> bytes = 0, peak = 0;

void* allocate(std::size_t size, std::size_t alignment) {
  const long number = ++allocations;
  void* const block = number >= first && number <= last
                          ? nullptr
                          : std::aligned_alloc(alignment, (size / alignment + 1) * alignment);
  if (block == nullptr) throw std::bad_alloc();
  ++blocks;
  const std::size_t now = bytes += malloc_usable_size(block);
  std::size_t highest = peak;
  while (now > highest && !peak.compare_exchange_weak(highest, now)) {
  }
  return block;
}

void release(void* block) noexcept {
  if (block == nullptr) return;
  --blocks;
  bytes -= malloc_usable_size(block);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }

namespace metamorph::evolve {
namespace {

using tests::tiny_experiment;

/// Calls work() while allocations number `from` to `to` fail. Whether std::bad_alloc came out of
/// it.
bool runs_out(long from, long to, const std::function<void()>& work) {
  allocations = 0;
  first = from;
  last = to;
  bool out = false;
  try {
    work();
  } catch (const std::bad_alloc&) {
    out = true;
  }
  first = last = never;
  return out;
}

/// Of so many allocations the first ones, each power of two, and some evenly between.
std::vector<long> chosen(long count) {
  std::vector<long> numbers;
  for (long n = 1; n <= count; n *= 2) numbers.push_back(n);
  for (long n = 1; n <= 40; ++n) numbers.push_back(std::max(1L, count * n / 40));
  return numbers;
}

std::string text_of(const std::vector<Evaluated>& all) {
  std::string text;
  for (const Evaluated& one : all) {
    text += fmt::format("{} {} {}:", one.created, one.died, one.penalty);
    for (std::size_t t = 0; t < one.trials.size(); ++t) {
      text += fmt::format(" {} {:a} {}", one.stages[t].cells, one.descriptors[t].height,
                          tests::text_of(one.trials[t]));
    }
    text += "\n";
  }
  return text;
}

Experiment six(const std::string& kind) {
  Experiment e = tiny_experiment(kind, 3);
  e.neat.population = 6;
  e.trials[1].starts = 2;
  e.trials[1].starts_renew = true;
  return e;
}

TEST(Allocation, AnEvaluatorThatRanOutOfMemoryGoesOn) {
  const Experiment e = six("simple");
  const std::vector<core::Network> networks =
      tests::networks_of(first_generation(e.neat, 5).genomes);
  const std::vector<std::uint8_t> both = {1, 1};
  Evaluator undisturbed(rules_of(e), 1);
  const std::string expected = text_of(undisturbed.evaluate(networks, both, 0));
  const std::string expected_next = text_of(undisturbed.evaluate(networks, both, 1));
  for (const int threads : {1, 2}) {
    Evaluator counted(rules_of(e), threads);
    runs_out(never, never, [&] { counted.evaluate(networks, both, 0); });
    const long count = allocations;
    ASSERT_GT(count, 1000);
    int failed = 0, tries = 0;
    for (const long n : chosen(count)) {
      for (const long to : {n, never - 1}) {  // this one, and all from it on
        const long before = blocks;
        {
          Evaluator evaluator(rules_of(e), threads);
          std::vector<Evaluated> result;
          const bool out = runs_out(n, to, [&] { result = evaluator.evaluate(networks, both, 0); });
          // A sort may do without the memory that it asks for.
          if (!out) {
            EXPECT_EQ(text_of(result), expected) << n;
          }
          failed += out ? 1 : 0;
          ++tries;
          EXPECT_EQ(text_of(evaluator.evaluate(networks, both, 0)), expected) << n;
          // From what is known of the generation before.
          runs_out(n / 4 + 1, to, [&] { evaluator.evaluate(networks, both, 1); });
          EXPECT_EQ(text_of(evaluator.evaluate(networks, both, 1)), expected_next) << n;
        }
        // CGAL loses what a triangulation has whose constructor runs out: here one block a thread
        // in each of the two.
        EXPECT_LE(blocks, before + 2 * threads) << n << ": lost";
      }
    }
    EXPECT_GT(failed, tries * 9 / 10);
  }
}

/// The scores of a generation and who comes next.
std::pair<std::vector<double>, std::vector<Genome>> bred(const SearchSetup& setup,
                                                         std::span<const Evaluation> evaluations) {
  const std::unique_ptr<Search> search = make_search(setup);
  std::vector<double> scores = search->tell(evaluations).scores;
  return {std::move(scores), search->ask().genomes};
}

TEST(Allocation, ASearchThatRunsOutOfMemorySaysSo) {
  // Not the ones whose rows are made of nlohmann's JSON, nor checkpoints: its destructor allocates,
  // and ends the program where it cannot. The program keeps a reserve for that.
  for (const std::string kind : {"simple", "progressive", "dns", "nsga2"}) {
    Experiment e = six(kind);
    if (kind == "dns") {
      e.search.values.find("axes")->second = std::vector<std::string>{"larva.x", "adult.x"};
    }
    std::vector<Evaluation> evaluations;
    for (const Evaluated& one :
         Evaluator(rules_of(e), 1)
             .evaluate(tests::networks_of(make_search(search_setup_of(e, 1))->ask().genomes),
                       {1, 1}, 0)) {
      evaluations.push_back(evaluation_of(one));
    }
    for (const int threads : {1, 2}) {
      const SearchSetup setup = search_setup_of(e, threads);
      const auto expected = bred(setup, evaluations);
      runs_out(never, never, [&] { bred(setup, evaluations); });
      int failed = 0, tries = 0;
      for (const long n : chosen(allocations)) {
        for (const long to : {n, never - 1}) {
          const long before = blocks;
          failed += runs_out(n, to, [&] { bred(setup, evaluations); }) ? 1 : 0;
          ++tries;
          EXPECT_EQ(blocks, before) << kind << ' ' << n << ": lost";
        }
      }
      EXPECT_GT(failed, tries * 9 / 10) << kind;
      EXPECT_EQ(bred(setup, evaluations), expected) << kind;
    }
  }
}

/// The most bytes that a generation and its checkpoint have taken at once.
double peak_of_generation(Experiment e, int population) {
  e.neat.population = population;
  const std::size_t before = bytes;
  peak = before;
  const std::unique_ptr<Search> search = make_search(search_setup_of(e, 1));
  Evaluator evaluator(rules_of(e), 1);
  const Asked asked = search->ask();
  const std::vector<Evaluated> evaluated =
      evaluator.evaluate(tests::networks_of(asked.genomes), {1, 1}, 0);
  std::vector<Evaluation> evaluations;
  for (const Evaluated& one : evaluated) evaluations.push_back(evaluation_of(one));
  search->tell(evaluations);
  search->save();
  return static_cast<double>(peak - before);
}

// The estimate is of bodies with as many cells as may live; few of a first generation have.
TEST(Allocation, AsMuchAsEstimatedAndNotMuchLess) {
  for (const std::string kind : {"simple", "nsga2"}) {
    for (const bool renews : {false, true}) {
      Experiment e = tiny_experiment(kind, 2);
      e.trials[1].starts_renew = renews;
      const double measured = peak_of_generation(e, 400) - peak_of_generation(e, 200);
      const double estimated = memory_estimate(e, 400, 1) - memory_estimate(e, 200, 1);
      EXPECT_LT(measured, estimated) << kind << ' ' << renews;
      EXPECT_GT(measured, estimated / 5) << kind << ' ' << renews;
      std::printf("%s %d: %.0f of %.0f bytes per individual\n", kind.c_str(), renews,
                  measured / 200, estimated / 200);
    }
  }
}

}  // namespace
}  // namespace metamorph::evolve
