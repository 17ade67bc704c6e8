#include "evolve/experiment/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <type_traits>
#include <utility>

#include "metamorph/scene_fields.h"

namespace metamorph::evolve {
namespace {

/// The names of a catalogue of signals; the field holds those chosen, in the catalogue's order, so
/// that the order in which they are written decides nothing.
template <class Signal, std::size_t Count>
NameList signal_list(std::vector<Signal>& field,
                     const std::array<core::SignalEntry<Signal>, Count>& catalogue,
                     std::size_t needed) {
  NameList list;
  for (const auto& entry : catalogue) {
    list.names.push_back(entry.name);
    list.meanings.push_back(entry.meaning);
  }
  list.needed = needed;
  list.get = [&field] {
    std::vector<std::size_t> chosen;
    for (const Signal signal : field) chosen.push_back(static_cast<std::size_t>(signal));
    return chosen;
  };
  list.set = [&field](std::vector<std::size_t> chosen) {
    std::sort(chosen.begin(), chosen.end());
    field.clear();
    for (const std::size_t i : chosen) field.push_back(static_cast<Signal>(i));
  };
  return list;
}

template <class Enum, std::size_t size>
Choice choice(Enum& field, const std::array<core::Named<Enum>, size>& table) {
  Choice result;
  for (const auto& entry : table) result.names.push_back(entry.name);
  result.get = [&field, &table] {
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const auto& entry) { return entry.value == field; });
    assert(found != table.end());
    return static_cast<std::size_t>(found - table.begin());
  };
  result.set = [&field, &table](std::size_t i) { field = table[i].value; };
  return result;
}

Choice base_choice(NamedScene& named) {
  return {{std::begin(scene_bases), std::end(scene_bases)},
          [&named] {
            return static_cast<std::size_t>(
                std::find(std::begin(scene_bases), std::end(scene_bases), named.base) -
                std::begin(scene_bases));
          },
          [&named](std::size_t i) { named.base = scene_bases[i]; }};
}

Section top_section(Experiment& e) {
  return {"",
          "the run",
          {{"name", &e.name, 0, 0, "name of the experiment; part of the run's directory"},
           {"generations", &e.generations, 1, 1e7, "generations to evolve"},
           {"seed", &e.seed, 0, 0x1p53, "seed of every random number of the run"},
           {"preset", choice(e.preset, preset_names), 0, 0,
            "where [search] and [neat] start from: gentle mutation and lasting species, or the "
            "paper's search"}}};
}

Section development_section(Experiment& e) {
  core::DevelopmentRules& d = e.development;
  return {
      "development",
      "from one cell to an embryo; times in steps, lengths in cell diameters d",
      {{"steps", &d.steps, 1, 1e6, "whole development; the time input runs from 0 to 1 over it"},
       {"max_cells", &d.max_cells, 1, 4096, "hard cap on living cells"},
       {"created_limit", &e.created_limit, 1, no_limit, "cells ever created before it costs"},
       {"created_penalty", &e.created_penalty, 0, 1, "factor on the fitness above that limit"},
       {"renew_interval", &d.renew_interval, 1, 1e6, "steps between renewals of neighbours"},
       {"update_interval", &d.update_interval, 1, 1e6, "steps between network updates"},
       {"step", &d.step, 1e-6, 10, "time units per step"},
       {"stiffness", &d.stiffness, 0, 1e6, "spring constant between cells"},
       {"damping", &d.damping, 0, 1e6, "damping along the springs"},
       {"drag", &d.drag, 0, 1e6, "drag per cell"},
       {"link_limit", &d.link_limit, 0, 1e6, "d; longer links stay only where needed"},
       {"division_space", &d.division_space, 0, 1e6, "d; free space a daughter needs"},
       {"coordinate_scale", &d.coordinate_scale, 1e-6, 1e6, "d; divides the x and y inputs"},
       {"period_min", &d.period_min, 1e-3, 1e6, "shortest oscillation, time units"},
       {"period_max", &d.period_max, 1e-3, 1e6, "longest oscillation, time units"},
       {"inputs",
        signal_list(d.inputs, core::input_signals, static_cast<std::size_t>(core::Input::bias)), 0,
        0, "what a cell tells its control network; the order does not matter"},
       {"outputs", signal_list(d.outputs, core::output_signals, core::output_signals.size()), 0, 0,
        "what the network tells its cell; one that is left out reads 0"}}};
}

Section body_section(Experiment& e) {
  return {"body",
          "from embryo to soft body",
          {{"min_cells", &e.min_cells, 3, 4096, "fewer nodes are no body: fitness 0"}}};
}

Section locomotion_section(Experiment& e) {
  LocomotionSettings& l = e.locomotion;
  return {"locomotion",
          "how motion is computed; the step belongs to the scene",
          {{"precision", choice(l.precision, core::precision_names), 0, 0, "of the arithmetic"},
           {"method", choice(l.method, core::method_names), 0, 0, "time integrator"}}};
}

Choice search_choice(SearchSettings& s) {
  std::vector<std::string_view> names;
  for (const SearchKind& kind : search_kinds()) names.push_back(kind.name);
  return {names,
          [&s, names] {
            return static_cast<std::size_t>(std::find(names.begin(), names.end(), s.kind) -
                                            names.begin());
          },
          [&s, names](std::size_t i) { s.kind = std::string(names[i]); }};
}

/// The kind, and what each kind lets be set, once.
Section search_section(Experiment& e) {
  SearchSettings& s = e.search;
  Section section{
      "search", "what is selected for", {{"kind", search_choice(s), 0, 0, "the search"}}};
  for (const SearchKind& kind : search_kinds()) {
    for (const Setting& setting : kind.settings) {
      const auto known = [&](const Key& key) { return key.name == setting.name; };
      if (std::any_of(section.keys.begin(), section.keys.end(), known)) continue;
      Key key{setting.name, static_cast<int*>(nullptr), setting.low, setting.high, setting.help};
      std::visit([&](auto& value) { key.field = &value; }, s.values.find(setting.name)->second);
      section.keys.push_back(std::move(key));
    }
  }
  return section;
}

Section neat_section(Experiment& e) {
  Section section{"neat", "how genomes are bred", {}};
  for (const NeatField& field : neat_fields) {
    Key key{field.name, static_cast<int*>(nullptr), field.low, field.high, field.meaning};
    std::visit(
        [&](auto member) {
          auto& value = e.neat.*member;
          if constexpr (std::is_same_v<decltype(value), Separation&>) {
            key.field = choice(value, separation_names);
          } else {
            key.field = &value;
          }
        },
        field.member);
    section.keys.push_back(std::move(key));
  }
  return section;
}

/// "time", "x", "y"
std::string quoted(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) {
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  }
  return text;
}

template <class Number>
std::string range_text(Number low, Number high) {
  if (static_cast<double>(high) >= no_limit) return fmt::format("at least {}", low);
  return fmt::format("from {} to {}", low, high);
}

}  // namespace

std::vector<Section> fixed_sections(Experiment& e) {
  return {top_section(e),        development_section(e), body_section(e),
          locomotion_section(e), search_section(e),      neat_section(e)};
}

Section trial_section(Trial& t) {
  return {"trials." + t.name,
          "a body of one stage, in one scene",
          {{"name", &t.name, 0, 0, "name of the trial"},
           {"stage", &t.stage, 1, 1e6, "development step at which the body is taken"},
           {"scene", &t.scene, 0, 0, "water, land, land-right, slope or one of [scenes]"},
           {"starts", &t.starts, 1, 1000, "times a body is run, from starts a hair apart"},
           {"start_displacement", &t.start_displacement, 0, 1,
            "d; largest move of a node in x and in y; the first start is the body as it is"},
           {"starts_combine", choice(t.starts_combine, starts_combine_names), 0, 0,
            "what counts of the starts; a failed one has distance 0"},
           {"starts_renew", &t.starts_renew, 0, 0,
            "every generation has other starts, the first one moved as well: parents that live on "
            "are run again"}}};
}

Section scene_section(NamedScene& named) {
  Section section{"scenes." + named.scene.name,
                  "an environment; units d, cell mass, spring constant 1; steps are 0.2 time units",
                  {{"base", base_choice(named), 0, 0, "where the defaults come from"}}};
  core::for_each_scene_field([&](const auto& field) {
    auto& value = named.scene.*field.member;
    Key key{field.name, &named.base, field.range.low, field.range.high, field.meaning};
    if constexpr (std::is_same_v<decltype(value), core::DistanceRule&>) {
      key.field = choice(value, core::distance_rule_names);
    } else if constexpr (std::is_same_v<decltype(value), double&>) {
      if (field.is_step()) {
        key.field = Step{&value};
      } else {
        key.field = &value;
      }
    } else {
      key.field = &value;
    }
    section.keys.push_back(std::move(key));
  });
  return section;
}

std::vector<Section> all_sections(Experiment& experiment) {
  std::vector<Section> sections = fixed_sections(experiment);
  for (Trial& trial : experiment.trials) sections.push_back(trial_section(trial));
  for (NamedScene& scene : experiment.scenes) sections.push_back(scene_section(scene));
  return sections;
}

core::Scene base_scene(std::string_view base) {
  if (base == "land") return core::land_scene();
  if (base == "land-right") return core::land_right_scene();
  if (base == "slope") return core::slope_scene();
  assert(base == "water");
  return core::water_scene();
}

std::string expectation(const Key& key) {
  struct Visitor {
    const Key& key;
    std::string operator()(const int*) const {
      return "a whole number " +
             range_text(static_cast<long long>(key.low), static_cast<long long>(key.high));
    }
    std::string operator()(const std::uint64_t*) const {
      return fmt::format("a whole number from 0 to {}", static_cast<std::uint64_t>(key.high));
    }
    std::string operator()(const double*) const {
      return "a number " + range_text(key.low, key.high);
    }
    std::string operator()(const Step&) const {
      return "a number " + range_text(key.low, key.high) + " or \"auto\"";
    }
    std::string operator()(const bool*) const { return "true or false"; }
    std::string operator()(const std::string*) const {
      return "a name of letters, digits, '-', '_' and '.', in quotes";
    }
    std::string operator()(const std::vector<double>*) const {
      return "a list of numbers " + range_text(key.low, key.high);
    }
    std::string operator()(const std::vector<std::string>*) const {
      return "a list of names, each in quotes";
    }
    std::string operator()(const Choice& c) const { return "one of " + quoted(c.names); }
    std::string operator()(const NameList& list) const {
      std::string text = "a list of one or more of " + quoted(list.names) + ", each once";
      if (list.needed < list.names.size()) {
        text += fmt::format(", with \"{}\"", list.names[list.needed]);
      }
      return text;
    }
  };
  return std::visit(Visitor{key}, key.field);
}

std::string value_text(const Key& key) {
  struct Visitor {
    std::string operator()(const int* value) const { return std::to_string(*value); }
    std::string operator()(const std::uint64_t* value) const { return std::to_string(*value); }
    std::string operator()(const double* value) const { return fmt::format("{}", *value); }
    std::string operator()(const Step& step) const {
      return *step.value == core::automatic_step ? "\"auto\"" : fmt::format("{}", *step.value);
    }
    std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
    std::string operator()(const std::string* value) const { return '"' + *value + '"'; }
    std::string operator()(const std::vector<double>* values) const {
      return fmt::format("[{}]", fmt::join(*values, ", "));
    }
    std::string operator()(const std::vector<std::string>* names) const {
      return fmt::format("[{}]", quoted({names->begin(), names->end()}));
    }
    std::string operator()(const Choice& c) const {
      return fmt::format("\"{}\"", c.names[c.get()]);
    }
    std::string operator()(const NameList& list) const {
      std::vector<std::string_view> chosen;
      for (const std::size_t i : list.get()) chosen.push_back(list.names[i]);
      return fmt::format("[{}]", quoted(chosen));
    }
  };
  return std::visit(Visitor{}, key.field);
}

}  // namespace metamorph::evolve
