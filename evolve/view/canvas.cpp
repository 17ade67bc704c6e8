#include "evolve/view/canvas.h"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo-svg.h>
#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "evolve/view/palette_png.h"

namespace metamorph::evolve {
namespace {

constexpr const char* font = "DejaVu Sans";

using SurfacePointer = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using ContextPointer = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void select_font(cairo_t* cairo, double size, bool bold) {
  cairo_select_font_face(cairo, font, CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
}

double width_of(cairo_t* cairo, const std::string& words) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, words.c_str(), &extents);
  return extents.x_advance;
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

SurfacePointer create(const std::string& file, std::string& bytes, double width, double height,
                      double density) {
  cairo_surface_t* surface = nullptr;
  if (file.ends_with(".svg")) {
    surface = cairo_svg_surface_create_for_stream(append, &bytes, width, height);
  } else if (file.ends_with(".pdf")) {
    surface = cairo_pdf_surface_create_for_stream(append, &bytes, width, height);
  } else if (file.ends_with(".png")) {
    surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                         static_cast<int>(std::lround(width * density)),
                                         static_cast<int>(std::lround(height * density)));
    cairo_surface_set_device_scale(surface, density, density);
  } else {
    throw std::runtime_error(file + ": a picture's name ends in .svg, .png or .pdf");
  }
  return {surface, cairo_surface_destroy};
}

SurfacePointer create_frame(int width, int height, double density) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  cairo_surface_set_device_scale(surface, density, density);
  return {surface, cairo_surface_destroy};
}

}  // namespace

struct Canvas::Surface {
  std::string file;   // of a frame "frame.png" or "frame"
  std::string bytes;  // complete after cairo_surface_finish()
  SurfacePointer surface;
  ContextPointer context;

  Surface(const std::string& name, double width, double height, double density)
      : file(name),
        surface(create(name, bytes, width, height, density)),
        context(cairo_create(surface.get()), cairo_destroy) {
    check(cairo_surface_status(surface.get()));
  }

  Surface(Frame frame, int width, int height, double density)
      : file(frame == Frame::png ? "frame.png" : "frame"),
        surface(create_frame(width, height, density)),
        context(cairo_create(surface.get()), cairo_destroy) {
    check(cairo_surface_status(surface.get()));
  }

  void check(cairo_status_t status) const {
    if (status != CAIRO_STATUS_SUCCESS) {
      throw std::runtime_error(file + ": cannot be drawn: " + cairo_status_to_string(status));
    }
  }

  // Cairo numbers the one group of a picture by all surfaces the process ever made; without the
  // number the same picture has the same bytes.
  void name_group() {
    const std::string id = "id=\"surface";
    const std::size_t start = bytes.find(id), end = bytes.find('"', start + id.size());
    if (start != std::string::npos && end != std::string::npos) {
      bytes.replace(start, end - start, "id=\"picture");
    }
  }

  void write_png() {
    cairo_surface_flush(surface.get());
    const int width = cairo_image_surface_get_width(surface.get());
    const int height = cairo_image_surface_get_height(surface.get());
    // Cairo's rows of RGB24 are as wide as the picture: four bytes of every pixel.
    const auto* pixels =
        reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface.get()));
    bytes =
        palette_png({pixels, static_cast<std::size_t>(width) * static_cast<std::size_t>(height)},
                    width, height);
  }

  cairo_t* cairo() const { return context.get(); }

  void prepare() const {
    cairo_set_line_join(cairo(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo(), CAIRO_LINE_CAP_ROUND);
    use(colours::paper);
    cairo_paint(cairo());
  }

  void take_pixels() {
    cairo_surface_flush(surface.get());
    const auto row = static_cast<std::size_t>(cairo_image_surface_get_width(surface.get())) * 4;
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    const auto* data = reinterpret_cast<const char*>(cairo_image_surface_get_data(surface.get()));
    for (int y = 0; y < cairo_image_surface_get_height(surface.get()); ++y) {
      bytes.append(data + stride * static_cast<std::size_t>(y), row);
    }
  }

  void use(const Colour& c) const {
    cairo_set_source_rgba(cairo(), c.red, c.green, c.blue, c.alpha);
  }

  void path(std::span<const Point> points) const {
    cairo_new_path(cairo());
    for (const Point& p : points) cairo_line_to(cairo(), p.x, p.y);
  }
};

Canvas::Canvas(const std::string& file, double width, double height, double density)
    : surface_(std::make_unique<Surface>(file, width, height, density)) {
  surface_->prepare();
}

Canvas::Canvas(Frame frame, int width, int height, double density)
    : surface_(std::make_unique<Surface>(frame, width, height, density)) {
  surface_->prepare();
}

Canvas::~Canvas() = default;

void Canvas::look_at(Point origin, double scale) {
  cairo_matrix_t matrix;
  cairo_matrix_init(&matrix, scale, 0, 0, -scale, origin.x, origin.y);
  cairo_set_matrix(surface_->cairo(), &matrix);
}

void Canvas::look_at_layout() { cairo_identity_matrix(surface_->cairo()); }

void Canvas::show_only(Point corner, double width, double height) {
  show_all();
  cairo_new_path(surface_->cairo());
  cairo_rectangle(surface_->cairo(), corner.x, corner.y, width, height);
  cairo_clip(surface_->cairo());
}

void Canvas::show_all() { cairo_reset_clip(surface_->cairo()); }

void Canvas::fill_polygon(std::span<const Point> points, const Colour& colour) {
  surface_->use(colour);
  surface_->path(points);
  cairo_fill(surface_->cairo());
}

void Canvas::fill_tiles(std::span<const std::vector<Point>> tiles, const Colour& colour) {
  cairo_t* cairo = surface_->cairo();
  surface_->use(colour);
  cairo_new_path(cairo);
  for (const std::vector<Point>& tile : tiles) {
    cairo_new_sub_path(cairo);
    for (const Point& p : tile) cairo_line_to(cairo, p.x, p.y);
    cairo_close_path(cairo);
  }
  cairo_fill_preserve(cairo);
  cairo_matrix_t matrix;
  cairo_get_matrix(cairo, &matrix);
  cairo_set_line_width(cairo, std::max(0.03, 0.7 / std::hypot(matrix.xx, matrix.yx)));
  cairo_stroke(cairo);
}

void Canvas::stroke_line(std::span<const Point> points, const Colour& colour, double width,
                         bool dashed) {
  cairo_t* cairo = surface_->cairo();
  const double dash = 4 * width;
  cairo_set_dash(cairo, &dash, dashed ? 1 : 0, 0);
  surface_->use(colour);
  surface_->path(points);
  cairo_set_line_width(cairo, width);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0);
}

void Canvas::stroke_lines(std::span<const std::array<Point, 2>> lines, const Colour& colour,
                          double width) {
  cairo_t* cairo = surface_->cairo();
  surface_->use(colour);
  cairo_new_path(cairo);
  for (const auto& [from, to] : lines) {
    cairo_move_to(cairo, from.x, from.y);
    cairo_line_to(cairo, to.x, to.y);
  }
  cairo_set_line_width(cairo, width);
  cairo_stroke(cairo);
}

void Canvas::fill_circle(Point centre, double radius, const Colour& colour) {
  surface_->use(colour);
  cairo_new_path(surface_->cairo());
  cairo_arc(surface_->cairo(), centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(surface_->cairo());
}

void Canvas::stroke_circle(Point centre, double radius, const Colour& colour, double width) {
  surface_->use(colour);
  cairo_new_path(surface_->cairo());
  cairo_arc(surface_->cairo(), centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  cairo_set_line_width(surface_->cairo(), width);
  cairo_stroke(surface_->cairo());
}

void Canvas::text(Point at, const std::string& words, double size, const Colour& colour,
                  Align align, bool bold) {
  cairo_t* cairo = surface_->cairo();
  select_font(cairo, size, bold);
  double x = at.x;
  if (align == Align::centre) x -= width_of(cairo, words) / 2;
  if (align == Align::right) x -= width_of(cairo, words);
  surface_->use(colour);
  cairo_move_to(cairo, x, at.y);
  cairo_show_text(cairo, words.c_str());
}

std::string Canvas::finish() {
  surface_->check(cairo_status(surface_->cairo()));
  // Of a film every frame would have a palette of its own, and flicker.
  if (surface_->file == "frame.png") {
    surface_->check(
        cairo_surface_write_to_png_stream(surface_->surface.get(), append, &surface_->bytes));
  } else if (surface_->file == "frame") {
    surface_->take_pixels();
  } else if (surface_->file.ends_with(".png")) {
    surface_->write_png();
  }
  cairo_surface_finish(surface_->surface.get());
  surface_->check(cairo_surface_status(surface_->surface.get()));
  if (surface_->file.ends_with(".svg")) surface_->name_group();
  return std::move(surface_->bytes);
}

double text_width(const std::string& words, double size, bool bold) {
  const SurfacePointer surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1),
                               cairo_surface_destroy);
  const ContextPointer context(cairo_create(surface.get()), cairo_destroy);
  select_font(context.get(), size, bold);
  return width_of(context.get(), words);
}

bool is_picture_file(const std::string& file) {
  return file.ends_with(".svg") || file.ends_with(".png") || file.ends_with(".pdf");
}

}  // namespace metamorph::evolve
