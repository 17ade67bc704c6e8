#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "evolve/experiment/experiment.h"

namespace metamorph::evolve {

/// A key that takes one of a few names, stored as an enum or a string.
struct Choice {
  std::vector<std::string_view> names;
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};

/// A step: a number, or "auto" for core::automatic_step.
struct Step {
  double* value;
};

/// Some of a few names, each once, as a list.
struct NameList {
  std::vector<std::string_view> names, meanings;  ///< [names]
  std::size_t needed;                             ///< that none may lack; names.size(): none
  std::function<std::vector<std::size_t>()> get;
  std::function<void(const std::vector<std::size_t>&)> set;
};

/// One key of an experiment file: what it is called, where its value lives and what is allowed.
/// Reading, --set, the configuration in the record and the help are all driven by these.
struct Key {
  std::string_view name;
  std::variant<int*, std::uint64_t*, double*, bool*, std::string*, std::vector<double>*,
               std::vector<std::string>*, Choice, Step, NameList>
      field;
  double low = 0, high = 0;  ///< range of a number, both ends included
  std::string_view help;     ///< what it is, with its unit
};

/// A table of an experiment file. Paths: "" (top level), "neat", "scenes.water", "trials.larva".
struct Section {
  std::string path;
  std::string_view help;
  std::vector<Key> keys;
};

/// The keys, bound to the fields of the given object, which must outlive them.
std::vector<Section> fixed_sections(Experiment& experiment);  ///< all but scenes and trials
Section scene_section(NamedScene& scene);
Section trial_section(Trial& trial);
/// All sections in the order in which they are written: fixed, trials, scenes.
std::vector<Section> all_sections(Experiment& experiment);

inline constexpr std::string_view scene_bases[] = {"water", "land", "land-right", "slope"};
/// The environment of that name. Precondition: it is one of scene_bases.
core::Scene base_scene(std::string_view base);

/// What the key accepts, as in "expected ...": "a whole number from 1 to 10".
std::string expectation(const Key& key);
/// The present value as TOML: 300, 0.25, true, "novelty". Numbers read back to the same bits.
std::string value_text(const Key& key);

}  // namespace metamorph::evolve
