#include "evolve/app/zoo.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "evolve/app/subject.h"
#include "evolve/files/body_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/printable.h"
#include "evolve/run/pictures.h"
#include "metamorph/locomotion.h"

namespace metamorph::evolve {
namespace {

/// `count` of the generations below `done`, the first and the last among them.
std::vector<int> evenly_spread(int done, int count) {
  if (count == 1) return {done - 1};
  std::vector<int> generations;
  for (int k = 0; k < std::min(count, done); ++k) {
    const double share = static_cast<double>(k) / (std::min(count, done) - 1);
    generations.push_back(done == 1 ? 0 : static_cast<int>(share * (done - 1) + 0.5));
  }
  return generations;
}

std::vector<int> generations_of(const RunReader& run, const ZooOptions& options) {
  const int done = run.generations_done();
  if (done == 0) throw InputError(run.file().string() + ": no generation is done yet");
  if (options.generations.empty())
    return evenly_spread(done, options.count > 0 ? options.count : 8);
  std::vector<int> generations = options.generations;
  std::sort(generations.begin(), generations.end());
  generations.erase(std::unique(generations.begin(), generations.end()), generations.end());
  for (const int generation : generations) {
    if (generation >= 0 && generation < done) continue;
    throw InputError(
        fmt::format("--generations: {}: expected generations from 0 to {}, those of {}", generation,
                    done - 1, printable(run.file().string())));
  }
  return generations;
}

Exhibit exhibit_of(const Subject& subject, std::string title) {
  return {std::move(title), stages_of(subject.experiment, subject.genome, outcomes_of(subject)),
          subject.experiment.metamorphoses()};
}

Exhibit exhibit_of_body(const std::filesystem::path& file, const RulesOptions& rules) {
  const Experiment experiment = experiment_of(rules);
  const core::Scene scene = scene_of(experiment, rules);
  Stage stage;
  stage.body = read_body(file);
  stage.title = "body";
  const std::vector<core::LocomotionTask> tasks = {{&stage.body, &scene}};
  stage.outcome = core::simulate(tasks, locomotion_of(experiment, 1)).front();
  stage.scene = scene.name;
  stage.ground = core::shows_ground(scene);
  return {stem_of(file), {std::move(stage)}, {}};
}

/// What names have in common up to the last "-" of that.
std::string common_part(const std::vector<std::string>& names) {
  std::string common = names.empty() ? "" : names.front();
  for (const std::string& name : names) {
    const auto [end, other] = std::mismatch(common.begin(), common.end(), name.begin(), name.end());
    common.erase(end, common.end());
  }
  const bool all_same = std::all_of(names.begin(), names.end(),
                                    [&](const std::string& name) { return name == common; });
  if (all_same) return common;
  const std::size_t dash = common.rfind('-');
  return dash == common.npos ? "" : common.substr(0, dash);
}

/// Names as titles, without what they have in common: "novelty, seed 3", "seed 3".
std::string title_of(const Experiment& experiment, const std::string& common) {
  const std::string seed = fmt::format("seed {}", experiment.seed);
  if (experiment.name == common) return seed;
  const std::string own =
      common.empty() ? experiment.name : experiment.name.substr(common.size() + 1);
  return own + ", " + seed;
}

Sheet generations_sheet(const ZooOptions& options, const std::string& what) {
  const RunReader run(options.sources.front());
  std::vector<Exhibit> exhibits;
  const std::vector<int> generations = generations_of(run, options);
  if (generations.size() > most_animats) {
    throw InputError(fmt::format("--generations: {} of them: expected at most {}",
                                 generations.size(), most_animats));
  }
  std::string heading;
  for (const int generation : generations) {
    const Subject subject = subject_of_run(run, generation);
    exhibits.push_back(exhibit_of(subject, fmt::format("generation {}", generation)));
    heading =
        fmt::format("{}, seed {}: {}", subject.experiment.name, subject.experiment.seed, what);
  }
  Sheet sheet = zoo_sheet(exhibits, options.style);
  sheet.heading = heading;
  return sheet;
}

}  // namespace

Sheet zoo_of(const ZooOptions& options) {
  if (options.sources.size() > most_animats) {
    throw InputError(fmt::format("SOURCE: {} of them: expected at most {}", options.sources.size(),
                                 most_animats));
  }
  std::vector<SourceKind> kinds;
  for (const std::string& source : options.sources) {
    kinds.push_back(kind_of(source));
    check_options(kinds.back(), options.rules, options.generation >= 0 ? "--generation" : "");
  }
  if (kinds.size() == 1 && kinds.front() == SourceKind::run && options.generation < 0) {
    return generations_sheet(options, "the best of their generations");
  }
  if (!options.generations.empty() || options.count > 0) {
    throw InputError(fmt::format("{}: expected one run, and no --generation",
                                 options.count > 0 ? "--count" : "--generations"));
  }

  std::vector<Exhibit> exhibits;
  std::vector<std::pair<std::size_t, Experiment>> of_runs;  // exhibit, its experiment
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const std::string& source = options.sources[i];
    if (kinds[i] == SourceKind::body) {
      exhibits.push_back(exhibit_of_body(source, options.rules));
    } else if (kinds[i] == SourceKind::genome) {
      const Subject subject = subject_of_genome(source, options.rules);
      exhibits.push_back(exhibit_of(subject, subject.heading));
    } else {
      Subject subject = subject_of_run(RunReader(source), options.generation);
      exhibits.push_back(exhibit_of(subject, ""));
      of_runs.emplace_back(i, std::move(subject.experiment));
    }
  }
  std::vector<std::string> names;
  for (const auto& [i, experiment] : of_runs) names.push_back(experiment.name);
  const std::string common = common_part(names);
  for (const auto& [i, experiment] : of_runs) exhibits[i].title = title_of(experiment, common);
  Sheet sheet = zoo_sheet(exhibits, options.style);
  if (of_runs.size() == exhibits.size()) sheet.heading = common;
  return sheet;
}

Sheet history_of(const ZooOptions& options) {
  if (options.sources.size() != 1 || kind_of(options.sources.front()) != SourceKind::run) {
    throw InputError("SOURCE: expected one run for --kind history");
  }
  check_options(SourceKind::run, options.rules, "");
  return generations_sheet(options, "phase shifts of the best of their generations");
}

}  // namespace metamorph::evolve
