#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "evolve/run/reporter.h"
#include "evolve/view/draw.h"

namespace metamorph::evolve {

/// The stages of an individual, one for each trial. `trials` are its outcomes, as recorded.
std::vector<Stage> stages_of(const Experiment& experiment, const Genome& genome,
                             std::span<const core::Outcome> trials);

/// What becomes of a genome in all trials, as that generation has them. One thread.
std::vector<core::Outcome> outcomes_of(const Experiment& experiment, const Genome& genome,
                                       int generation);

/// The picture of one individual: the embryo and body of every trial with its distance (figure 5).
/// `trials` are its outcomes, as recorded.
Sheet individual_sheet(const Experiment& experiment, const Genome& genome,
                       std::span<const core::Outcome> trials, const std::string& heading);

/// Keeps best.svg and best.png in the run's directory showing the best individual so far. A picture
/// that cannot be written costs the run nothing; the reason is kept for the end. A run that goes on
/// draws them anew: its last session may have ended between a generation and its pictures.
class PictureReporter : public Reporter {
 public:
  void started(const RunStart& start) override;
  void generation_done(const GenerationReport& report) override;

  const std::string& failure() const { return failure_; }  ///< "" if the last pictures are there

 private:
  void draw(const Experiment& experiment, const BestEver& best,
            const std::function<std::vector<core::Outcome>()>& trials);

  std::filesystem::path directory_;
  std::string failure_;
};

}  // namespace metamorph::evolve
