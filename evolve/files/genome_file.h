#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "evolve/files/output_file.h"
#include "metamorph/genome.h"

namespace metamorph::evolve {

inline constexpr std::string_view genome_format = "metamorph-genome/1";
inline constexpr double largest_weight = 1000;  ///< in a file; evolution stays within +-8

/// Reads a genome file (see README, Files): `nodes` [{"id", "kind"}] and `links` [{"innovation",
/// "from", "to", "weight"}], in any order; the ids are those of control_shape.h. A link that is not
/// expressed in all stages of life has "first_stage" or "last_stage" (from 0 on). The genome is
/// sound: check() finds nothing. Throws InputError with all faults.
Genome read_genome(const std::filesystem::path& file);
/// The same for development by these rules: one with other inputs or outputs is a fault as well.
Genome read_genome(const std::filesystem::path& file, const core::DevelopmentRules& rules);

/// Throws InputError if the rules have other inputs or outputs than a genome; `source` names it.
void check_fits(const Genome& genome, const core::DevelopmentRules& rules,
                const std::string& source);

/// The same from text; `source` names it in faults.
Genome parse_genome(std::string_view text, const std::string& source);

/// The text of a genome file; parse_genome gives back the same genome.
std::string genome_text(const Genome& genome);

void write_genome(const std::filesystem::path& file, const Genome& genome, Overwrite overwrite);

}  // namespace metamorph::evolve
