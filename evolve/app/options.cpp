#include "evolve/app/options.h"

#include <map>
#include <string>

namespace metamorph::evolve {
namespace {

using MakeScene = core::Scene (*)();

const std::map<std::string, MakeScene>& scenes() {
  static const std::map<std::string, MakeScene> table = {{"land", core::land_scene},
                                                         {"land-right", core::land_right_scene},
                                                         {"slope", core::slope_scene},
                                                         {"water", core::water_scene}};
  return table;
}

/// An option that takes one of a few names for a value.
template <class T>
void add_choice(CLI::App& command, const std::string& option, T& value,
                std::map<std::string, T> names, const std::string& type,
                const std::string& default_name, const std::string& help) {
  command.add_option(option, value, help)
      ->transform(CLI::CheckedTransformer(std::move(names)).description(""))
      ->option_text(type + " [" + default_name + "]");
}

}  // namespace

void add_development_options(CLI::App& command, core::DevelopmentRules& rules, int& min_cells) {
  command.add_option("--steps-of-development", rules.steps, "Length of the whole development")
      ->check(CLI::Range(1, 1000000))
      ->option_text("STEPS [1200]")
      ->group("Development");
  command.add_option("--max-cells", rules.max_cells, "Most cells alive at one time")
      ->check(CLI::Range(1, 100000))
      ->option_text("N [256]")
      ->group("Development");
  command.add_option("--min-cells", min_cells, "Fewest cells of a body")
      ->check(CLI::Range(3, 100000))
      ->option_text("N [8]")
      ->group("Development");
}

void add_locomotion_options(CLI::App& command, core::LocomotionOptions& options) {
  using core::Method;
  using core::Precision;
  add_choice(command, "--method", options.method,
             {{"drift_kick_drift", Method::drift_kick_drift},
              {"symplectic_euler", Method::symplectic_euler}},
             "drift_kick_drift|symplectic_euler", "drift_kick_drift", "Integrator");
  add_choice(command, "--precision", options.precision,
             {{"float32", Precision::float32}, {"float64", Precision::float64}}, "float32|float64",
             "float32", "Arithmetic");
}

void add_scene_option(CLI::App& command, std::string& name) {
  command.add_option("--scene", name, "Environment")
      ->check(CLI::IsMember(scenes()).description(""))
      ->option_text("water|land|land-right|slope [water]");
}

core::Scene scene_named(const std::string& name) { return scenes().at(name)(); }

}  // namespace metamorph::evolve
