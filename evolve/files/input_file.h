#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace metamorph::evolve {

inline constexpr std::size_t largest_input = std::size_t{64} << 20;  ///< bytes of a file

/// The whole text of a file. Throws InputError if it is missing, longer
/// than that or unreadable, and for what is no file: a directory, a pipe and a device, which might
/// never end.
std::string read_text(const std::filesystem::path& file);

}  // namespace metamorph::evolve
