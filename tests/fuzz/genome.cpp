// Genome files: what is read is sound, comes back when it was written, and compiles if it fits.

#include "evolve/files/genome_file.h"

#include "metamorph/development.h"
#include "tests/fuzz/contract.h"

using namespace metamorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  evolve::Genome genome;
  if (!fuzz::is_taken("genome",
                      [&] { genome = evolve::parse_genome(fuzz::text_of(data, size), "genome"); }))
    return 0;
  fuzz::require(evolve::check(genome).empty(), "a genome that is read is sound");
  const std::string text = evolve::genome_text(genome);
  const evolve::Genome back = evolve::parse_genome(text, "written");
  fuzz::require(back == genome && evolve::genome_text(back) == text, "a genome comes back", text);
  const core::DevelopmentRules rules;
  if (!fuzz::is_taken("genome", [&] { evolve::check_fits(genome, rules, "genome"); })) return 0;
  for (const core::Network& network :
       evolve::compile_stages(genome, evolve::shape_of(rules.inputs, rules.outputs), 3)) {
    fuzz::require(core::check(network, rules).empty(), "a genome that fits compiles", text);
  }
  return 0;
}
