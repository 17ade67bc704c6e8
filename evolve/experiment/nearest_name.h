#pragma once

#include <span>
#include <string>
#include <string_view>

namespace metamorph::evolve {

/// The candidate with the fewest edits (insert, delete, replace, swap neighbours) from `name`, or
/// "" if even that one differs in more than a third of its letters (at least two).
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace metamorph::evolve
