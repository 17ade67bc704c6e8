#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "evolve/files/output_file.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"

namespace metamorph::evolve {

inline constexpr std::string_view embryo_format = "metamorph-embryo/1";

/// The text of an embryo file (see README, Files): the state of development after `step` steps,
/// and under `body` the body it would become, or null where `extraction` has none.
std::string embryo_text(const core::Embryo& embryo, const core::Extraction& extraction);

void write_embryo(const std::filesystem::path& file, const core::Embryo& embryo,
                  const core::Extraction& extraction, Overwrite overwrite);

}  // namespace metamorph::evolve
