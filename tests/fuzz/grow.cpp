// Every genome that is read grows, through two stages of life, and what has a body moves.

#include <algorithm>
#include <array>

#include "evolve/files/genome_file.h"
#include "evolve/run/table_digest.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"
#include "tests/fuzz/moving.h"

using namespace metamorph;

namespace {

bool are_numbers(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  core::DevelopmentRules rules;
  rules.steps = 240;
  rules.max_cells = 32;
  const std::array stages = {120, 240};
  const std::array switches = {120};

  const std::string_view text = fuzz::text_of(data, size);
  evolve::Genome genome;
  if (!fuzz::is_taken("genome", [&] {
        genome = evolve::parse_genome(text, "genome");
        evolve::check_fits(genome, rules, "genome");
      }))
    return 0;
  const std::vector<std::vector<core::Network>> lives = {
      evolve::compile_stages(genome, evolve::shape_of(rules.inputs, rules.outputs), 2)};
  const auto embryos = core::develop(lives, switches, rules, stages, 1);
  for (const core::Embryo& embryo : embryos.front()) {
    fuzz::require(are_numbers(embryo.x) && are_numbers(embryo.y) &&
                      are_numbers(embryo.orientation) && are_numbers(embryo.period) &&
                      are_numbers(embryo.phase),
                  "an embryo has numbers", text);
    fuzz::require(embryo.cell_count() <= rules.max_cells, "an embryo is no larger than allowed");
    const core::Extraction extraction = core::extract_body(embryo);
    if (extraction.status != core::Status::ok) continue;
    fuzz::require(core::check(extraction.body).empty(), "a body that was grown is sound", text);
    fuzz::move(extraction.body, evolve::hash_of(text));
  }
  return 0;
}
