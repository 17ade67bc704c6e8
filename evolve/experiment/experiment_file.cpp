#include "evolve/experiment/experiment_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "evolve/experiment/assign.h"
#include "evolve/experiment/contradictions.h"
#include "evolve/experiment/keys.h"
#include "evolve/experiment/nearest_name.h"
#include "evolve/experiment/toml.h"
#include "evolve/files/input_error.h"
#include "evolve/files/input_file.h"

namespace metamorph::evolve {
namespace {

/// Tables within tables are left one call deep each, and a key of two bytes makes one: what is
/// longer could overflow the stack. An experiment needs a twentieth.
constexpr std::size_t longest_text = std::size_t{128} << 10;

constexpr std::size_t most_faults = 100;    ///< told of one file; nobody reads more
constexpr std::size_t longest_shown = 120;  ///< bytes of a name or a value
constexpr std::size_t longest_expected =
    600;  ///< of what was expected: some lists grow with trials

/// The text, or its beginning if it is long.
std::string shortened(std::string_view text, std::size_t longest = longest_shown) {
  if (text.size() <= longest) return std::string(text);
  return std::string(text.substr(0, longest)).append("...");
}

std::string join_path(std::string_view section, std::string_view key) {
  return section.empty() ? std::string(key) : fmt::format("{}.{}", section, key);
}

/// Builds an experiment from a file and overrides, and collects what is wrong with them.
class Reader {
 public:
  Reader(std::string source, const std::vector<Override>& overrides)
      : source_(std::move(source)), overrides_(overrides) {}

  Experiment read(std::string_view text) {
    if (text.size() > longest_text) {
      throw InputError(
          fmt::format("{}: too long: expected at most {} KiB", source_, longest_text >> 10));
    }
    toml::table file;
    try {
      file = toml::parse(text, source_);
    } catch (const toml::parse_error& error) {
      throw InputError(fmt::format("{}:{}: not valid TOML: {}", source_, error.source().begin.line,
                                   shortened(error.description())));
    }
    if (!file.contains("name")) {
      add_fault(fmt::format("{}: name is missing: expected {}", source_,
                            expectation(fixed_sections(experiment_)[0].keys[0])));
    }
    read_preset(file);
    read_fixed_sections(file);
    read_trials(file);
    apply_overrides(false);
    read_scenes(file);
    apply_overrides(true);
    for (const Contradiction& c : contradictions(experiment_)) {
      const bool of_trials = c.key == "trials" || c.key.starts_with("scenes.");
      if (of_trials && !trials_known_) continue;  // told already
      if (skip_fault()) continue;
      add_fault(
          fmt::format("{}: expected {}", placed(c.key), shortened(c.expected, longest_expected)));
    }
    if (untold_ > 0) faults_.push_back(fmt::format("{}: and {} more", source_, untold_));
    if (!faults_.empty()) throw InputError(faults_);
    return std::move(experiment_);
  }

 private:
  /// Counts a fault and returns true if so many are told already that it is not. What tells of a
  /// fault may take long: it looks through all keys.
  bool skip_fault() {
    if (faults_.size() < most_faults) return false;
    ++untold_;
    return true;
  }
  void add_fault(std::string line) {
    if (!skip_fault()) faults_.push_back(std::move(line));
  }

  std::string at(const toml::node& node) const {
    return fmt::format("{}:{}", source_, node.source().begin.line);
  }

  /// "file:line: key = value" of a key that was given, "file: key" with its default otherwise.
  std::string placed(const std::string& key) {
    const auto given = origin_.find(key);
    std::string value;
    for (const Section& section : all_sections(experiment_)) {
      for (const Key& k : section.keys) {
        if (join_path(section.path, k.name) == key) value = " = " + value_text(k);
      }
    }
    return fmt::format("{}: {}{}", given == origin_.end() ? source_ : given->second, shortened(key),
                       shortened(value));
  }

  void unknown(const std::string& where, const std::string& full_path, const std::string& value,
               const Section* own = nullptr) {
    if (skip_fault()) return;
    const std::string path = shortened(full_path);
    // The right key in the wrong table, and keys that were.
    const auto last = [](const std::string& p) { return p.substr(p.rfind('.') + 1); };
    if (last(path) == "ground_stiffness" || last(path) == "ground_damping") {
      add_fault(
          fmt::format("{}: {} = {}: the ground is solid since version 0.2: expected no such key",
                      where, path, value));
      return;
    }
    std::vector<std::string> paths = {"trials", "scenes"};
    std::vector<Section> sections = all_sections(experiment_);
    if (own != nullptr) sections.insert(sections.begin(), *own);  // not in the experiment yet
    for (const Section& section : sections) {
      if (!section.path.empty()) paths.push_back(section.path);
      for (const Key& key : section.keys) paths.push_back(join_path(section.path, key.name));
    }
    std::string nearest = nearest_name(path, paths);
    for (const std::string& candidate : paths) {
      if (nearest.empty() && last(candidate) == last(path)) nearest = candidate;
    }
    add_fault(fmt::format("{}: {} = {}: unknown key{}", where, path, value,
                          nearest.empty() ? "" : "; did you mean " + nearest + "?"));
  }

  void set(const Section& section, std::string_view name, const toml::node& node,
           const std::string& where) {
    const std::string path = join_path(section.path, name);
    const auto key = std::find_if(section.keys.begin(), section.keys.end(),
                                  [&](const Key& k) { return k.name == name; });
    if (key == section.keys.end()) {
      unknown(where, path, shown(node), &section);
    } else if (std::string fault; !assign(*key, node, fault)) {
      add_fault(fmt::format("{}: {} = {}: {}expected {}", where, shortened(path), shown(node),
                            fault.empty() ? "" : fault + ": ", expectation(*key)));
    } else {
      origin_[path] = where;
    }
  }

  void set_all(const Section& section, const toml::table& table) {
    for (const auto& [name, node] : table) set(section, name.str(), node, at(node));
  }

  /// The preset comes first: what else is given changes it. What is wrong with it is told later.
  void read_preset(const toml::table& file) {
    std::string given = file["preset"].value_or("");
    for (const Override& change : overrides_) {
      if (change.key != "preset") continue;
      given = change.value;
      std::erase(given, '"');
    }
    for (const auto& entry : preset_names) {
      if (entry.name == given) apply(entry.value, experiment_);
    }
  }

  void read_fixed_sections(const toml::table& file) {
    const std::vector<Section> sections = fixed_sections(experiment_);
    for (const auto& [name, node] : file) {
      if (name == "trials" || name == "scenes") continue;
      const auto section = std::find_if(sections.begin(), sections.end(),
                                        [&](const Section& s) { return s.path == name.str(); });
      if (section == sections.end()) {
        set(sections[0], name.str(), node, at(node));
      } else if (const toml::table* table = node.as_table()) {
        set_all(*section, *table);
      } else {
        add_fault(fmt::format("{}: {} = {}: expected a table [{}]", at(node), name.str(),
                              shown(node), name.str()));
      }
    }
  }

  void read_trials(const toml::table& file) {
    const toml::node* node = file.get("trials");
    if (node == nullptr) return;
    const toml::array* list = node->as_array();
    if (list == nullptr || !std::all_of(list->begin(), list->end(),
                                        [](const toml::node& entry) { return entry.is_table(); })) {
      add_fault(fmt::format("{}: trials = {}: expected a list of tables [[trials]]", at(*node),
                            shown(*node)));
      trials_known_ = false;
      return;
    }
    experiment_.trials.reserve(list->size());
    for (const toml::node& entry : *list) {
      const toml::table& table = *entry.as_table();
      Trial& trial = experiment_.trials.emplace_back();
      trial.name = table["name"].value_or(fmt::format("{}", experiment_.trials.size()));
      for (const char* needed : {"name", "stage", "scene"}) {
        if (!table.contains(needed)) {
          add_fault(fmt::format("{}: trials.{}: {} is missing", at(entry), shortened(trial.name),
                                needed));
        }
      }
      set_all(trial_section(trial), table);
    }
  }

  /// Scenes of the file, and the presets that trials name without changing them.
  void read_scenes(const toml::table& file) {
    const toml::node* node = file.get("scenes");
    const toml::table* tables = node == nullptr ? nullptr : node->as_table();
    if (node != nullptr && tables == nullptr) {
      add_fault(
          fmt::format("{}: scenes = {}: expected tables [scenes.NAME]", at(*node), shown(*node)));
    }
    if (tables != nullptr) {
      for (const auto& [name, entry] : *tables) read_scene(std::string(name.str()), entry);
    }
    for (const Trial& trial : experiment_.trials) {
      const auto& scenes = experiment_.scenes;
      if (trial.scene.empty() ||
          std::any_of(scenes.begin(), scenes.end(),
                      [&](const NamedScene& s) { return s.scene.name == trial.scene; })) {
        continue;
      }
      if (std::find(std::begin(scene_bases), std::end(scene_bases), trial.scene) ==
          std::end(scene_bases)) {
        if (skip_fault()) continue;
        add_fault(fmt::format(
            "{}: expected water, land, land-right, slope or the name of a [scenes.NAME] table",
            placed("trials." + trial.name + ".scene")));
        continue;
      }
      experiment_.scenes.push_back({trial.scene, base_scene(trial.scene)});
    }
    std::sort(experiment_.scenes.begin(), experiment_.scenes.end(),
              [](const NamedScene& a, const NamedScene& b) { return a.scene.name < b.scene.name; });
  }

  void read_scene(const std::string& name, const toml::node& entry) {
    const toml::table* table = entry.as_table();
    if (table == nullptr || !is_name(name)) {
      add_fault(
          fmt::format("{}: scenes.{} = {}: expected a table with a name of letters, "
                      "digits, '-' and '_'",
                      at(entry), shortened(name), shown(entry)));
      return;
    }
    const bool preset =
        std::find(std::begin(scene_bases), std::end(scene_bases), name) != std::end(scene_bases);
    NamedScene named{preset ? name : "water", {}};
    named.scene.name = name;
    if (const toml::node* base = table->get("base")) {
      set(scene_section(named), "base", *base, at(*base));
    } else if (!preset) {
      add_fault(fmt::format("{}: scenes.{}: base is missing: expected {}", at(entry), name,
                            expectation(scene_section(named).keys[0])));
    }
    named.scene = base_scene(named.base);
    named.scene.name = name;
    origin_["scenes." + name] = at(entry);
    for (const auto& [key, node] : *table) {
      if (key != "base") set(scene_section(named), key.str(), node, at(node));
    }
    experiment_.scenes.push_back(std::move(named));
  }

  /// Scenes are known only after the trials that name them: two rounds.
  void apply_overrides(bool to_scenes) {
    for (const Override& change : overrides_) {
      if (change.key.starts_with("scenes.") != to_scenes) continue;
      toml::table holder;
      try {
        holder = toml::parse("value = " + change.value);
      } catch (const toml::parse_error&) {
        holder.insert("value", change.value);
      }
      const toml::node& node = *holder.get("value");
      const std::size_t dot = change.key.rfind('.');
      const std::string prefix = dot == std::string::npos ? "" : change.key.substr(0, dot);
      const std::string name = dot == std::string::npos ? change.key : change.key.substr(dot + 1);
      bool found = false;
      for (const Section& section : all_sections(experiment_)) {
        const bool every = (prefix == "scenes.*" && section.path.starts_with("scenes.")) ||
                           (prefix == "trials.*" && section.path.starts_with("trials."));
        if (section.path != prefix && !every) continue;
        const std::size_t before = faults_.size() + untold_;
        set(section, name, node, change.origin);
        found = true;
        if (faults_.size() + untold_ != before) break;  // one fault per override, not one per scene
      }
      if (!found) unknown(change.origin, change.key, shown(node));
    }
  }

  std::string source_;
  const std::vector<Override>& overrides_;
  Experiment experiment_;
  std::map<std::string, std::string> origin_;  ///< where each given key was given
  bool trials_known_ = true;                   ///< false: `trials` is not what it should be
  std::vector<std::string> faults_;
  std::size_t untold_ = 0;  ///< faults beyond those
};

}  // namespace

Override parse_override(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos || equals + 1 == text.size()) {
    throw InputError(
        fmt::format("--set {}: expected key=value, as in neat.population=100", shortened(text)));
  }
  return {"--set", std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

Experiment parse_experiment(std::string_view text, const std::string& source,
                            const std::vector<Override>& overrides) {
  return Reader(source, overrides).read(text);
}

Experiment read_experiment(const std::filesystem::path& file,
                           const std::vector<Override>& overrides) {
  return parse_experiment(read_text(file), file.string(), overrides);
}

std::string to_toml(const Experiment& experiment) {
  Experiment copy = experiment;  // sections point to fields that may be written
  std::string text;
  for (const Section& section : all_sections(copy)) {
    if (section.path.starts_with("trials.")) {
      text += "\n[[trials]]\n";
    } else if (!section.path.empty()) {
      text += fmt::format("\n[{}]\n", section.path);
    }
    for (const Key& key : section.keys) {
      text += fmt::format("{} = {}\n", key.name, value_text(key));
    }
  }
  return text;
}

std::string describe_keys() {
  Experiment defaults;
  defaults.name = "NAME";
  defaults.trials = {{"NAME", 600, "water"}};
  defaults.scenes = {{"water", core::water_scene()}};
  defaults.scenes[0].scene.name = "NAME";
  std::string text;
  for (const Section& section : all_sections(defaults)) {
    text += section.path.empty() ? fmt::format("{}\n", section.help)
                                 : fmt::format("\n{}: {}\n", section.path, section.help);
    for (const Key& key : section.keys) {
      text += fmt::format("  {} = {}  ({}; {})\n", join_path(section.path, key.name),
                          value_text(key), key.help, expectation(key));
      const NameList* list = std::get_if<NameList>(&key.field);
      for (std::size_t i = 0; list != nullptr && i < list->names.size(); ++i) {
        text += fmt::format("    {}: {}\n", list->names[i], list->meanings[i]);
      }
    }
  }
  return text;
}

}  // namespace metamorph::evolve
