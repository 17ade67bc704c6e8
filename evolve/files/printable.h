#pragma once

#include <string>
#include <string_view>

namespace metamorph::evolve {

/// A text, such as the name of a file, as a line can show it: what is no UTF-8 and what controls a
/// terminal (line ends too) become \xNN.
std::string printable(std::string_view text);

}  // namespace metamorph::evolve
