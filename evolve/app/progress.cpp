#include "evolve/app/progress.h"

#include <fmt/format.h>

#include "evolve/app/streams.h"
#include "evolve/app/text.h"
#include "evolve/files/printable.h"

namespace metamorph::evolve {
namespace {

constexpr double log_interval = 60;  ///< seconds between lines of a log, unless something happens

}  // namespace

Progress::Progress(bool terminal) : terminal_(terminal) {}

double Progress::seconds_since_start() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::started(const RunStart& start) {
  start_ = std::chrono::steady_clock::now();
  first_generation_ = start.first_generation;
  const Experiment& e = start.experiment;
  tell("{}: seed {}, {} individuals, generations {} to {}, in {}\n", e.name, e.seed,
       e.neat.population, start.first_generation, e.generations,
       printable(start.directory.string()));
}

void Progress::generation_done(const GenerationReport& report) {
  evaluations_ += report.evaluations;
  const double elapsed = seconds_since_start();
  const int generation = report.result.generation, total = report.experiment.generations;
  const int done = generation + 1 - first_generation_;
  const double rate = static_cast<double>(evaluations_) / std::max(elapsed, 1e-9);
  const double left = elapsed / done * (total - generation - 1);
  int failures = 0;
  const auto counts = count_statuses(report.result);
  for (const core::Status status : core::all_statuses) {
    if (core::is_failure(status)) failures += counts[static_cast<std::size_t>(status)];
  }
  std::string distances;
  for (std::size_t t = 0; t < report.best.distances.size(); ++t) {
    distances += fmt::format("{}{} {:.2f}", t == 0 ? "" : ", ", report.experiment.trials[t].name,
                             report.best.distances[t]);
  }
  if (const int near = count_near_step_limit(report.result); near > 0 && !warned_of_steps_) {
    warned_of_steps_ = true;
    if (line_open_) tell("\n");
    tell(
        "warning: evaluations {}: {} in generation {} (told once); step = \"auto\" chooses it for "
        "each body\n",
        near_limit_text(), near, generation + 1);
  }
  const std::string line =
      fmt::format("generation {}/{}  best so far {:.3f} d ({})  {:.0f} evaluations/s  {}{}",
                  generation + 1, total, report.best.eq6, distances, rate,
                  generation + 1 == total ? "done" : duration_text(left) + " left",
                  failures > 0 ? fmt::format("  {} failed", failures) : "");
  if (terminal_) {
    // Back to the start of the line, and clear it.
    tell("\r\033[K{}", line);
    line_open_ = true;
    return;
  }
  const bool better = report.best.eq6 > 1.1 * last_best_;
  if (better || done <= 3 || elapsed - last_log_ >= log_interval || generation + 1 == total) {
    tell("{}\n", line);
    last_log_ = elapsed;
    last_best_ = report.best.eq6;
  }
}

void Progress::finished(const RunSummary& summary) {
  if (line_open_) tell("\n");
  const double total = summary.seconds.total();
  if (total <= 0) return;
  std::string phases;
  const auto values = summary.seconds.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    phases += fmt::format("{}{} {:.1f} %", i == 0 ? "" : ", ", PhaseSeconds::names[i],
                          100 * values[i] / total);
  }
  tell("{} of computing: {}\n", duration_text(total), phases);
  if (const std::string saved = saved_text(summary.work); !saved.empty()) {
    tell("known already: {}\n", saved);
  }
  std::string statuses;
  for (const core::Status status : core::all_statuses) {
    const int count = summary.statuses[static_cast<std::size_t>(status)];
    if (count > 0) {
      statuses += fmt::format("{}{} {}", statuses.empty() ? "" : ", ", core::name(status), count);
    }
  }
  tell("evaluations by status: {}\n", statuses);
  if (summary.near_step_limit > 0) {
    tell("evaluations {}: {}\n", near_limit_text(), summary.near_step_limit);
  }
}

}  // namespace metamorph::evolve
