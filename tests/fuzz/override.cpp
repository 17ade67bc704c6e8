// Overrides as --set takes them, several ended by NUL, on an experiment that has all tables.

#include <vector>

#include "evolve/experiment/experiment_file.h"
#include "tests/fuzz/contract.h"

using namespace metamorph;

namespace {

constexpr std::string_view file = R"(
name = "overridden"
[search]
kind = "novelty"
[[trials]]
name = "larva"
stage = 600
scene = "water"
[[trials]]
name = "adult"
stage = 1200
scene = "hill"
[scenes.hill]
base = "land"
slope_degrees = 5
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<evolve::Override> overrides;
  std::string_view left = fuzz::text_of(data, size);
  while (!left.empty()) {
    const std::string_view one = left.substr(0, left.find('\0'));
    left.remove_prefix(one.size() + (one.size() < left.size() ? 1 : 0));
    fuzz::is_taken("--set", [&] { overrides.push_back(evolve::parse_override(one)); });
  }
  evolve::Experiment experiment;
  // A line names the override, or the file where one makes it contradict itself.
  if (!fuzz::is_taken("", [&] { experiment = evolve::parse_experiment(file, "toml", overrides); }))
    return 0;
  const std::string text = evolve::to_toml(experiment);
  fuzz::require(evolve::to_toml(evolve::parse_experiment(text, "written")) == text,
                "an experiment comes back", text);
  return 0;
}
