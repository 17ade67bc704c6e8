#include "evolve/view/palette_png.h"

#include <gtest/gtest.h>
#include <omp.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace metamorph::evolve {
namespace {

constexpr int width = 120, height = 80;

/// A disk with a soft edge, blended from red to blue, on white.
std::vector<std::uint32_t> picture() {
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double edge = 30 - std::hypot(x - 60, y - 40), inside = std::clamp(edge, 0.0, 1.0);
      const auto channel = [&](double value) {
        return static_cast<std::uint32_t>(255 - inside * (255 - value) + 0.5);
      };
      const double blend = 2.0 * x;
      pixels.push_back(channel(255 - blend) << 16 | channel(60) << 8 | channel(blend));
    }
  }
  return pixels;
}

std::vector<unsigned char> channels_of(const std::string& png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, png.data(), png.size()) == 0) return {};
  EXPECT_TRUE((image.format & PNG_FORMAT_FLAG_COLORMAP) != 0);
  EXPECT_EQ(image.width, static_cast<png_uint_32>(width));
  EXPECT_EQ(image.height, static_cast<png_uint_32>(height));
  image.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> channels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, channels.data(), 0, nullptr) == 0) return {};
  return channels;
}

TEST(PalettePng, IsTheSamePictureButForWhatTheEyeLetsPass) {
  const auto pixels = picture();
  const auto channels = channels_of(palette_png(pixels, width, height));
  ASSERT_EQ(channels.size(), 3 * pixels.size());
  double sum = 0;
  int worst = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int wanted = static_cast<int>(pixels[i] >> (16 - 8 * c) & 0xff);
      const int error = std::abs(wanted - channels[3 * i + c]);
      worst = std::max(worst, error);
      sum += error;
    }
  }
  EXPECT_EQ(channels[0], 255);  // paper stays paper
  EXPECT_LT(worst, 48);
  EXPECT_LT(sum / static_cast<double>(channels.size()), 2);
}

TEST(PalettePng, HasTheSameBytesWhateverTheThreads) {
  const int before = omp_get_max_threads();
  const auto pixels = picture();
  const std::string once = palette_png(pixels, width, height);
  for (const int threads : {1, 3, 7}) {
    omp_set_num_threads(threads);
    EXPECT_EQ(palette_png(pixels, width, height), once);
    EXPECT_EQ(omp_get_max_threads(), threads);  // left as it was
  }
  omp_set_num_threads(before);
}

TEST(PalettePng, OfOneColourIsWrittenToo) {
  const std::vector<std::uint32_t> white(width * height, 0xffffff);
  const auto channels = channels_of(palette_png(white, width, height));
  ASSERT_EQ(channels.size(), 3 * white.size());
  EXPECT_TRUE(std::all_of(channels.begin(), channels.end(), [](int v) { return v == 255; }));
  EXPECT_THROW(palette_png({}, 0, 0), std::exception);
}

}  // namespace
}  // namespace metamorph::evolve
