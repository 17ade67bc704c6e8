#include "evolve/view/palette_png.h"

#include <libimagequant.h>
#include <omp.h>
#include <png.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

namespace metamorph::evolve {
namespace {

constexpr int most_colours = 128;
constexpr unsigned char of_areas = 255, of_edges = 24;  // what their colours count

/// The library shares sums out among threads: of one thread the same pixels give the same palette.
class OneThread {
 public:
  OneThread() { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_ = omp_get_max_threads();
};

void check(liq_error error) {
  if (error != LIQ_OK) throw std::runtime_error("no palette was found for the picture");
}

struct Destroy {
  void operator()(liq_attr* settings) const { liq_attr_destroy(settings); }
  void operator()(liq_image* image) const { liq_image_destroy(image); }
  void operator()(liq_result* result) const { liq_result_destroy(result); }
};
template <class T>
using Owned = std::unique_ptr<T, Destroy>;

struct Indexed {
  std::vector<unsigned char> pixels, palette;  ///< palette: red, green, blue of every colour
};

void read_row(liq_color row[], int y, int width, void* pixels) {
  const std::uint32_t* from = static_cast<const std::uint32_t*>(pixels) +
                              static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  for (int x = 0; x < width; ++x) {
    row[x] = {static_cast<unsigned char>(from[x] >> 16), static_cast<unsigned char>(from[x] >> 8),
              static_cast<unsigned char>(from[x]), 255};
  }
}

/// What a pixel counts: at edges, where one colour blends into another, nobody sees a small error;
/// a legend is a small area whose colours have to be right.
std::vector<unsigned char> importance_of(std::span<const std::uint32_t> pixels, int width) {
  std::vector<unsigned char> importance(pixels.size(), of_areas);
  const auto row = static_cast<std::size_t>(width);
  for (std::size_t i = row; i < pixels.size(); ++i) {
    if (((pixels[i] ^ pixels[i - row]) & 0xffffff) != 0) importance[i] = of_edges;
  }
  return importance;
}

Indexed quantise(std::span<const std::uint32_t> pixels, int width, int height) {
  const OneThread alone;
  const Owned<liq_attr> settings(liq_attr_create());
  if (!settings) throw std::bad_alloc();
  check(liq_set_max_colors(settings.get(), most_colours));
  const Owned<liq_image> image(liq_image_create_custom(
      settings.get(), read_row, const_cast<std::uint32_t*>(pixels.data()), width, height, 0));
  if (!image) throw std::bad_alloc();
  std::vector<unsigned char> importance = importance_of(pixels, width);
  check(liq_image_set_importance_map(image.get(), importance.data(), importance.size(),
                                     LIQ_COPY_PIXELS));
  liq_result* found = nullptr;
  check(liq_image_quantize(image.get(), settings.get(), &found));
  const Owned<liq_result> result(found);
  check(liq_set_dithering_level(found, 0));  // dots would cost more than they please
  Indexed indexed;
  indexed.pixels.resize(pixels.size());
  check(liq_write_remapped_image(found, image.get(), indexed.pixels.data(), indexed.pixels.size()));
  const liq_palette& palette = *liq_get_palette(found);
  for (unsigned int k = 0; k < palette.count; ++k) {
    const liq_color& colour = palette.entries[k];
    indexed.palette.insert(indexed.palette.end(), {colour.r, colour.g, colour.b});
  }
  return indexed;
}

}  // namespace

std::string palette_png(std::span<const std::uint32_t> pixels, int width, int height) {
  const Indexed indexed = quantise(pixels, width, height);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = static_cast<png_uint_32>(indexed.palette.size() / 3);
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  const int done = png_image_write_to_memory(&image, bytes.data(), &size, 0, indexed.pixels.data(),
                                             0, indexed.palette.data());
  if (done == 0) throw std::runtime_error(std::string("not written as PNG: ") + image.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace metamorph::evolve
