#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "evolve/experiment/experiment_file.h"
#include "evolve/experiment/keys.h"
#include "evolve/experiment/nearest_name.h"
#include "tests/evolve/experiment_text.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::faults_of;
using tests::good;

std::filesystem::path shipped(const std::string& name) {
  return std::filesystem::path(METAMORPH_EXPERIMENTS) / (name + ".toml");
}

/// What MODEL section 7 and the paper's section 3 say of an experiment.
struct Expected {
  std::string name;
  std::string kind;
  int generations, steps, max_cells;
  std::vector<std::pair<int, std::string>> trials;  // stage, scene
};

const std::vector<Expected> model_experiments = [] {
  std::vector<Expected> all;
  for (const std::string kind : {"simple", "progressive", "novelty"}) {
    all.push_back(
        {"water-to-land-" + kind, kind, 2000, 1200, 256, {{600, "water"}, {1200, "land"}}});
    all.push_back(
        {"land-to-water-" + kind, kind, 2000, 1200, 256, {{600, "land"}, {1200, "water"}}});
  }
  for (const auto& [name, kind] : {std::pair{"front", "nsga2"}, std::pair{"map", "map-elites"}}) {
    all.push_back({std::string("water-to-land-").append(name),
                   kind,
                   2000,
                   1200,
                   256,
                   {{600, "water"}, {1200, "land"}}});
  }
  for (const int steps : {600, 1200}) {
    all.push_back({"amphibious-" + std::to_string(steps),
                   "novelty",
                   2000,
                   steps,
                   256,
                   {{steps, "water"}, {steps, "land"}}});
  }
  all.push_back(
      {"slope-metamorphic", "progressive", 1000, 800, 128, {{400, "land-right"}, {800, "slope"}}});
  all.push_back(
      {"newt", "progressive", 2000, 1200, 256, {{400, "water"}, {800, "land"}, {1200, "water"}}});
  all.push_back(
      {"water-to-land-separated", "novelty", 2000, 1200, 256, {{600, "water"}, {1200, "land"}}});
  all.push_back({"slope-specialist-flat", "simple", 1000, 400, 128, {{400, "land-right"}}});
  all.push_back({"slope-specialist-slope", "simple", 1000, 800, 128, {{800, "slope"}}});
  return all;
}();

TEST(Experiment, ShippedFilesAreThoseOfTheModel) {
  for (const Expected& expected : model_experiments) {
    SCOPED_TRACE(expected.name);
    const Experiment e = read_experiment(shipped(expected.name));
    EXPECT_EQ(e.name, expected.name);
    EXPECT_EQ(e.search.kind, expected.kind);
    EXPECT_EQ(e.generations, expected.generations);
    EXPECT_EQ(e.development.steps, expected.steps);
    EXPECT_EQ(e.development.max_cells, expected.max_cells);
    EXPECT_EQ(e.neat.population, 300);
    ASSERT_EQ(e.trials.size(), expected.trials.size());
    for (std::size_t t = 0; t < e.trials.size(); ++t) {
      EXPECT_EQ(e.trials[t].stage, expected.trials[t].first);
      EXPECT_EQ(e.trials[t].scene, expected.trials[t].second);
      // On land selection would keep lucky throws; water forgets how a body started.
      EXPECT_EQ(e.trials[t].starts_renew, e.scene_of(e.trials[t]).ground);
    }
    const bool separated = expected.name == "water-to-land-separated";
    EXPECT_EQ(e.neat.separation, separated ? Separation::full : Separation::none);
  }
}

TEST(Experiment, EveryShippedFileLoadsAndSurvivesTheRoundTrip) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(METAMORPH_EXPERIMENTS)) {
    SCOPED_TRACE(entry.path().string());
    const Experiment e = read_experiment(entry.path());
    EXPECT_EQ(e.name, entry.path().stem().string());
    const std::string text = to_toml(e);
    EXPECT_EQ(to_toml(parse_experiment(text, "again")), text);
    ++files;
  }
  EXPECT_GE(files, model_experiments.size());
}

TEST(Experiment, DefaultsAreThoseOfTheTypes) {
  const Experiment e = parse_experiment(good, "x.toml");
  const Experiment untouched;
  Experiment parsed = e, fresh = untouched;
  fresh.name = parsed.name;
  const auto a = fixed_sections(parsed), b = fixed_sections(fresh);
  for (std::size_t s = 0; s < a.size(); ++s) {
    for (std::size_t k = 0; k < a[s].keys.size(); ++k) {
      EXPECT_EQ(value_text(a[s].keys[k]), value_text(b[s].keys[k])) << a[s].keys[k].name;
    }
  }
  EXPECT_EQ(e.scene_of(e.trials[0]).drag, true);
  EXPECT_EQ(e.scene_of(e.trials[1]).ground, true);
  EXPECT_EQ(e.scene_of(e.trials[1]).step, core::land_scene().step);
}

TEST(Experiment, KeysAreDistinctAndHaveDefaultsInRange) {
  Experiment e = parse_experiment(good, "x.toml");
  for (const Section& section : all_sections(e)) {
    std::set<std::string_view> names;
    for (const Key& key : section.keys) {
      EXPECT_TRUE(names.insert(key.name).second) << section.path << "." << key.name;
      EXPECT_FALSE(key.help.empty());
      if (const auto* number = std::get_if<double*>(&key.field)) {
        EXPECT_LE(key.low, **number) << key.name;
        EXPECT_GE(key.high, **number) << key.name;
      }
    }
  }
}

TEST(Experiment, NoTwoKeysShareAField) {
  Experiment e = parse_experiment(good, "x.toml");
  std::set<const void*> fields;
  for (const Section& section : all_sections(e)) {
    for (const Key& key : section.keys) {
      std::visit(
          [&](const auto& field) {
            if constexpr (std::is_pointer_v<std::decay_t<decltype(field)>>) {
              EXPECT_TRUE(fields.insert(field).second) << section.path << "." << key.name;
            } else if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Step>) {
              EXPECT_TRUE(fields.insert(field.value).second) << section.path << "." << key.name;
            }
          },
          key.field);
    }
  }
}

// Any numbers in range come back to the same bits through the text in the record.
RC_GTEST_PROP(Experiment, AnyNumbersSurviveTheRoundTrip, ()) {
  Experiment e = parse_experiment(good, "x.toml");
  for (const Section& section : all_sections(e)) {
    for (const Key& key : section.keys) {
      if (auto* const* number = std::get_if<double*>(&key.field)) {
        const double share = *rc::gen::inRange(0, 1 << 30) / static_cast<double>(1 << 30);
        **number = key.low + share * (std::min(key.high, 1e6) - key.low);
      } else if (auto* const* flag = std::get_if<bool*>(&key.field)) {
        **flag = *rc::gen::arbitrary<bool>();
      }
    }
  }
  // Put right what random numbers contradict.
  e.development.period_min = std::max(e.development.period_min, 1.0);
  e.development.period_max = std::max(e.development.period_min, e.development.period_max);
  e.neat.compatibility_threshold =
      std::max(e.neat.compatibility_floor, e.neat.compatibility_threshold);
  e.neat.weight_limit = 1000;
  e.neat.initial_weight = std::min(e.neat.initial_weight, 1000.0);
  e.neat.mutate_weights += 1;
  e.neat.mutate_weights = std::min(e.neat.mutate_weights, 1e6);
  for (Trial& trial : e.trials) {
    if (trial.start_displacement == 0) trial.starts_renew = false;
  }
  Experiment back = parse_experiment(to_toml(e), "again");
  const auto a = all_sections(e), b = all_sections(back);
  RC_ASSERT(a.size() == b.size());
  for (std::size_t s = 0; s < a.size(); ++s) {
    for (std::size_t k = 0; k < a[s].keys.size(); ++k) {
      RC_ASSERT(a[s].keys[k].name == b[s].keys[k].name);
      if (auto* const* number = std::get_if<double*>(&a[s].keys[k].field)) {
        RC_ASSERT(**number == *std::get<double*>(b[s].keys[k].field));
      } else {
        RC_ASSERT(value_text(a[s].keys[k]) == value_text(b[s].keys[k]));
      }
    }
  }
}

TEST(Experiment, StepsMayBeLeftToTheProgram) {
  const std::vector<Override> automatic = {{"--set", "scenes.*.step", "auto"},
                                           {"--set", "scenes.land.settle_step", "auto"}};
  const Experiment e = parse_experiment(good, "x.toml", automatic);
  for (const Trial& trial : e.trials) EXPECT_EQ(e.scene_of(trial).step, core::automatic_step);
  EXPECT_EQ(e.scene_of(e.trials[0]).settle_step, core::water_scene().settle_step);
  EXPECT_EQ(e.scene_of(e.trials[1]).settle_step, core::automatic_step);
  EXPECT_THAT(to_toml(e), HasSubstr("step = \"auto\""));
  EXPECT_EQ(to_toml(parse_experiment(to_toml(e), "again")), to_toml(e));
  for (const char* wrong : {"Auto", "0", "-1", "true", "11", "nan"}) {
    EXPECT_THAT(faults_of(good, {{"--set", "scenes.*.step", wrong}}),
                ElementsAre(HasSubstr("expected a number from 1e-06 to 10 or \"auto\"")))
        << wrong;
  }
}

TEST(Experiment, ChangedScenes) {
  const Experiment e = parse_experiment(
      "name = \"x\"\n[[trials]]\nname = \"a\"\nstage = 600\nscene = \"syrup\"\n"
      "[[trials]]\nname = \"b\"\nstage = 600\nscene = \"slope\"\n"
      "[scenes.syrup]\nbase = \"water\"\ndrag_normal = 7\n[scenes.slope]\nslope_degrees = 5.5\n",
      "x.toml");
  EXPECT_EQ(e.scene_of(e.trials[0]).drag_normal, 7);
  EXPECT_EQ(e.scene_of(e.trials[0]).drag_tangential, core::water_scene().drag_tangential);
  EXPECT_EQ(e.scene_of(e.trials[0]).name, "syrup");
  EXPECT_EQ(e.scene_of(e.trials[1]).slope_degrees, 5.5);
  EXPECT_EQ(e.scene_of(e.trials[1]).distance, core::DistanceRule::rightward);
  EXPECT_EQ(e.stages(), std::vector<int>{600});
}

TEST(Experiment, OverridesReachEveryKindOfKey) {
  const Experiment e = parse_experiment(good, "x.toml",
                                        {parse_override("neat.population=12"),
                                         parse_override("search.kind=novelty"),
                                         parse_override("trials.adult.scene=slope"),
                                         parse_override("scenes.slope.friction=0.5"),
                                         parse_override("scenes.*.run_steps=300"),
                                         parse_override("scenes.water.self_collision=false"),
                                         {"--seed", "seed", "99"}});
  EXPECT_EQ(e.neat.population, 12);
  EXPECT_EQ(e.search.kind, "novelty");
  EXPECT_EQ(e.scene_of(e.trials[1]).friction, 0.5);
  EXPECT_EQ(e.scene_of(e.trials[0]).run_steps, 300);
  EXPECT_EQ(e.scene_of(e.trials[1]).run_steps, 300);
  EXPECT_FALSE(e.scene_of(e.trials[0]).self_collision);
  EXPECT_EQ(e.seed, 99u);
}

TEST(Experiment, StartsOfTrials) {
  const Experiment one = parse_experiment(good, "x.toml");
  for (const Trial& trial : one.trials) {
    EXPECT_EQ(trial.starts, 1);
    EXPECT_FALSE(trial.starts_renew);
  }
  const Experiment e =
      parse_experiment(std::string(good) + "starts = 5\nstarts_renew = true\n", "x.toml",
                       {parse_override("trials.*.start_displacement=0.01"),
                        parse_override("trials.adult.starts_combine=least")});
  EXPECT_EQ(e.trials[0].starts, 1);
  EXPECT_EQ(e.trials[0].starts_combine, StartsCombine::mean);
  EXPECT_EQ(e.trials[1].starts, 5);
  EXPECT_EQ(e.trials[1].starts_combine, StartsCombine::least);
  EXPECT_TRUE(e.trials[1].starts_renew);
  for (const Trial& trial : e.trials) EXPECT_EQ(trial.start_displacement, 0.01);
  EXPECT_EQ(to_toml(parse_experiment(to_toml(e), "again")), to_toml(e));
}

TEST(NearestName, CountsEdits) {
  const std::vector<std::string> names = {"population", "generations", "seed"};
  EXPECT_EQ(nearest_name("populaton", names), "population");   // one missing
  EXPECT_EQ(nearest_name("popualtion", names), "population");  // swapped
  EXPECT_EQ(nearest_name("sede", names), "seed");
  EXPECT_EQ(nearest_name("temperature", names), "");
}

TEST(Experiment, HelpNamesEveryKey) {
  Experiment e = parse_experiment(good, "x.toml");
  const std::string help = describe_keys();
  for (const Section& section : fixed_sections(e)) {
    for (const Key& key : section.keys) EXPECT_THAT(help, HasSubstr(std::string(key.name) + " = "));
  }
}

}  // namespace
}  // namespace metamorph::evolve
