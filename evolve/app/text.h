#pragma once

#include <string>

namespace metamorph::evolve {

/// A duration for people: "12.3 s", "4 min 05 s", "3 h 07 min".
std::string duration_text(double seconds);

}  // namespace metamorph::evolve
