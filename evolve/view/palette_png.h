#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace metamorph::evolve {

/// A picture as a PNG file with a palette of 128 colours, or as many as it has: about a quarter of
/// the bytes that all its colours would take. Pixels are 0xRRGGBB, row by row
/// from the top; their highest byte does not count. The same pixels give the same bytes. Throws
/// std::runtime_error if it cannot be made.
std::string palette_png(std::span<const std::uint32_t> pixels, int width, int height);

}  // namespace metamorph::evolve
