#include "evolve/study/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "evolve/experiment/keys.h"
#include "evolve/files/csv_text.h"
#include "evolve/files/input_error.h"
#include "evolve/files/printable.h"
#include "metamorph/searches.h"

namespace metamorph::evolve {
namespace {

constexpr std::size_t most_settings = 3;  ///< that a label names
constexpr double most = 1e100;            ///< no sound record has such a value
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// [path of a key] Its value: what makes runs one experiment.
using Settings = std::map<std::string, std::string>;

struct Run {
  std::unique_ptr<RunReader> reader;
  Experiment experiment;
  Settings settings;
  int generations = 0;
  std::vector<Measure> measures;
};

struct Group {
  std::string label;
  std::vector<const Run*> runs;  ///< by seed
};

Settings settings_of(const Experiment& experiment) {
  Experiment copy = experiment;
  Settings settings;
  for (const Section& section : all_sections(copy)) {
    for (const Key& key : section.keys) {
      const std::string path = section.path.empty() ? std::string(key.name)
                                                    : fmt::format("{}.{}", section.path, key.name);
      settings[path] = value_text(key);
    }
  }
  settings.erase("seed");
  const bool is_paced = make_search(search_setup_of(experiment, 1))->is_paced();
  if (!is_paced) settings.erase("generations");
  return settings;
}

Run open_run(const std::filesystem::path& path) {
  Run run;
  run.reader = std::make_unique<RunReader>(path);
  run.generations = run.reader->generations_done();
  if (run.generations == 0) throw InputError(path.string() + ": no generation is done yet");
  run.experiment = run.reader->experiment();
  run.settings = settings_of(run.experiment);
  return run;
}

std::vector<Run> open_runs(std::span<const std::filesystem::path> paths) {
  std::vector<Run> runs;
  for (const std::filesystem::path& path : paths) runs.push_back(open_run(path));
  const auto key = [](const Run& run) {
    return std::tie(run.experiment.name, run.settings, run.experiment.seed);
  };
  std::sort(runs.begin(), runs.end(), [&](const Run& a, const Run& b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (key(runs[i - 1]) == key(runs[i])) {
      throw InputError(fmt::format(
          "{}: the same experiment and seed ({}) as {}: expected runs that are independent",
          runs[i].reader->file().string(), runs[i].experiment.seed,
          runs[i - 1].reader->file().string()));
    }
  }
  return runs;
}

/// The settings in which an experiment differs from others of its name: "a.b=1, c=true".
std::string difference_of(const Group& group, std::span<const Group* const> others) {
  const Settings& own = group.runs.front()->settings;
  std::vector<std::string> told;
  for (const auto& [path, value] : own) {
    const bool differs = std::any_of(others.begin(), others.end(), [&](const Group* other) {
      const Settings& settings = other->runs.front()->settings;
      const auto found = settings.find(path);
      return found == settings.end() || found->second != value;
    });
    if (differs) told.push_back(fmt::format("{}={}", path, value));
  }
  return told.size() > most_settings ? "" : fmt::format("{}", fmt::join(told, ", "));
}

/// Gives every experiment a label of its own.
void label(std::vector<Group>& groups) {
  std::map<std::string, std::vector<Group*>> of_name;
  for (Group& group : groups) of_name[group.runs.front()->experiment.name].push_back(&group);
  for (auto& [name, alike] : of_name) {
    for (std::size_t i = 0; i < alike.size(); ++i) {
      alike[i]->label = name;
      if (alike.size() == 1) continue;
      const std::string difference =
          difference_of(*alike[i], std::vector<const Group*>(alike.begin(), alike.end()));
      // Without a short one they are counted.
      alike[i]->label += difference.empty() ? fmt::format(" (setting {})", i + 1)
                                            : fmt::format(" ({})", difference);
    }
  }
}

std::vector<Group> groups_of(const std::vector<Run>& runs) {
  std::vector<Group> groups;
  for (const Run& run : runs) {
    if (groups.empty() || groups.back().runs.front()->settings != run.settings) {
      groups.emplace_back();
    }
    groups.back().runs.push_back(&run);
  }
  label(groups);
  return groups;
}

/// Trials are matched by name where all experiments have the same names, else by scene: a larva
/// that swims with a specialist that does.
MatchedBy matched_by(const std::vector<Run>& runs) {
  const auto names = [](const Run& run) {
    std::vector<std::string> result;
    for (const Trial& trial : run.experiment.trials) result.push_back(trial.name);
    return result;
  };
  const bool same = std::all_of(runs.begin(), runs.end(),
                                [&](const Run& run) { return names(run) == names(runs.front()); });
  return same ? MatchedBy::trial : MatchedBy::scene;
}

const Measure* same_measure(const std::vector<Measure>& measures, const Measure& wanted) {
  const auto found = std::find_if(measures.begin(), measures.end(), [&](const Measure& m) {
    return m.what == wanted.what && m.where == wanted.where;
  });
  return found == measures.end() ? nullptr : &*found;
}

Curve curve_of(const Group& group, const Measure& measure, std::size_t generations,
               const Bootstrap& bootstrap, Centre centre) {
  Curve curve;
  curve.measure = measure;
  curve.measure.values.assign(generations, unknown);
  if (group.runs.size() > 1) curve.low = curve.high = curve.measure.values;
  std::vector<double> sample(group.runs.size());
  for (std::size_t g = 0; g < generations; ++g) {
    for (std::size_t r = 0; r < group.runs.size(); ++r) {
      sample[r] = same_measure(group.runs[r]->measures, measure)->values[g];
    }
    if (!std::all_of(sample.begin(), sample.end(), [](double v) { return std::abs(v) < most; })) {
      continue;
    }
    curve.measure.values[g] = centre_of(sample, centre);
    if (curve.low.empty()) continue;
    const auto [low, high] = bootstrap.interval(sample, centre);
    curve.low[g] = low;
    curve.high[g] = high;
  }
  return curve;
}

/// How far all runs of an experiment go; a note where some go on.
std::size_t common_generations(const Group& group, std::vector<std::string>& notes) {
  const auto [shortest, longest] = std::minmax_element(
      group.runs.begin(), group.runs.end(),
      [](const Run* a, const Run* b) { return a->generations < b->generations; });
  if ((*shortest)->generations < (*longest)->generations) {
    notes.push_back(fmt::format("{}: up to generation {}, where its shortest run ends (seed {})",
                                group.label, (*shortest)->generations - 1,
                                (*shortest)->experiment.seed));
  }
  return static_cast<std::size_t>((*shortest)->generations);
}

/// All measures of the runs, each once, in the order in which a kind gives them.
std::vector<Measure> measures_of(const std::vector<Group>& groups) {
  std::vector<Measure> all;
  for (const Group& group : groups) {
    for (const Measure& measure : group.runs.front()->measures) {
      if (same_measure(all, measure) == nullptr) all.push_back(measure);
    }
  }
  return all;
}

void keep_wanted(std::vector<Measure>& measures, std::span<const std::string> wanted) {
  if (wanted.empty()) return;
  std::vector<std::string> known;
  for (const Measure& measure : measures) {
    if (std::find(known.begin(), known.end(), measure.what) == known.end()) {
      known.push_back(measure.what);
    }
  }
  for (const std::string& what : wanted) {
    if (std::find(known.begin(), known.end(), what) == known.end()) {
      throw InputError(
          fmt::format("--curves: {}: expected some of {}", what, fmt::join(known, ", ")));
    }
  }
  std::erase_if(measures, [&](const Measure& measure) {
    return std::find(wanted.begin(), wanted.end(), measure.what) == wanted.end();
  });
}

}  // namespace

Study study_of(std::span<const std::filesystem::path> paths, const PlotKind& kind, Centre centre,
               std::span<const std::string> wanted) {
  std::vector<Run> runs = open_runs(paths);
  const MatchedBy by = matched_by(runs);
  for (Run& run : runs) {
    run.measures = kind.read({*run.reader, run.experiment, run.generations, by});
  }
  const std::vector<Group> groups = groups_of(runs);
  std::vector<Measure> measures = measures_of(groups);
  keep_wanted(measures, wanted);

  Study study;
  std::vector<std::size_t> generations;
  std::vector<Bootstrap> bootstraps;
  for (const Group& group : groups) {
    StudiedExperiment& experiment = study.experiments.emplace_back();
    experiment.label = printable(group.label);
    for (const Run* run : group.runs) experiment.seeds.push_back(run->experiment.seed);
    generations.push_back(common_generations(group, study.notes));
    bootstraps.emplace_back(experiment.seeds);
  }
  for (const Measure& measure : measures) {
    for (std::size_t e = 0; e < groups.size(); ++e) {
      if (same_measure(groups[e].runs.front()->measures, measure) == nullptr) continue;
      study.curves.push_back(curve_of(groups[e], measure, generations[e], bootstraps[e], centre));
      study.curves.back().experiment = e;
    }
  }
  return study;
}

std::string csv_of(const Study& study) {
  std::string text = "experiment,curve,generation,centre,low,high,runs\n";
  for (const Curve& curve : study.curves) {
    const StudiedExperiment& experiment = study.experiments[curve.experiment];
    const Measure& measure = curve.measure;
    const std::string name =
        measure.where.empty() ? measure.what : measure.what + " " + measure.where;
    for (std::size_t g = 0; g < measure.values.size(); ++g) {
      if (std::isnan(measure.values[g])) continue;
      text += fmt::format("{},{},{},{},", csv_field(experiment.label), csv_field(name), g,
                          measure.values[g]);
      if (!curve.low.empty()) text += fmt::format("{},{}", curve.low[g], curve.high[g]);
      text += fmt::format("{},{}\n", curve.low.empty() ? "," : "", experiment.seeds.size());
    }
  }
  return text;
}

}  // namespace metamorph::evolve
