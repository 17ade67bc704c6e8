#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "evolve/files/output_file.h"
#include "metamorph/body.h"

namespace metamorph::evolve {

inline constexpr std::string_view body_format = "metamorph-body/1";

/// Reads a body file (see README, Files): `nodes` [[x, y], ...] in d, `triangles` [[i, j, k], ...]
/// counter-clockwise, `period` (time units) and `phase` (radians) per node, and, where they are not
/// those of the nodes, `springs` [[i, j], ...] in any order with `rest_length` (d) per spring, and
/// `rest_area` (d^2) per triangle. The body is sound: core::check() finds nothing. Throws
/// InputError with all faults.
core::Body read_body(const std::filesystem::path& file);

/// The same from text; `source` names it in faults.
core::Body parse_body(std::string_view text, const std::string& source);

/// The text of a body file; parse_body gives back the same bits, but for Body::cell, which the
/// format leaves out. Rest values are written only where they are not those of the nodes.
std::string body_text(const core::Body& body);

/// The body as a JSON object whose closing brace is indented by `indent`.
std::string body_object(const core::Body& body, std::size_t indent);

void write_body(const std::filesystem::path& file, const core::Body& body, Overwrite overwrite);

}  // namespace metamorph::evolve
