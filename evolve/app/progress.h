#pragma once

#include <chrono>

#include "evolve/run/reporter.h"

namespace metamorph::evolve {

/// Shows how a run goes on stderr: one line that renews itself on a terminal, plain lines in a log
/// (the first ones all, then about one per minute and one per improvement by a tenth).
class Progress : public Reporter {
 public:
  explicit Progress(bool terminal);

  void started(const RunStart& start) override;
  void generation_done(const GenerationReport& report) override;
  void finished(const RunSummary& summary) override;

 private:
  double seconds_since_start() const;

  bool terminal_;
  bool line_open_ = false;
  bool warned_of_steps_ = false;
  int first_generation_ = 0;
  std::int64_t evaluations_ = 0;
  double last_log_ = 0;
  double last_best_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace metamorph::evolve
