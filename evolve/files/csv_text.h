#pragma once

#include <string>
#include <string_view>

namespace metamorph::evolve {

/// A text as one field of CSV (RFC 4180): in quotes where it holds a comma, a quote or a line end.
std::string csv_field(std::string_view text);

}  // namespace metamorph::evolve
