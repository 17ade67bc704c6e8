#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "evolve/view/colour.h"

namespace metamorph::evolve {

struct Point {
  double x = 0, y = 0;
};

enum class Align { left, centre, right };

/// A picture being drawn. Coordinates are layout pixels with y down until look_at() maps a
/// part of the picture to lengths in d with y up; line widths and radii follow the same unit.
/// What it becomes is decided by the name of its file: .svg, .png or .pdf.
class Canvas {
 public:
  /// `density`: pixels of a PNG per layout pixel. Throws std::runtime_error for another ending or
  /// if it is too large to be drawn.
  Canvas(const std::string& file, double width, double height, double density = 2);
  /// A frame of a film: `width` by `height` pixels, `density` of them per layout pixel, that
  /// finish() gives as PNG or as they are.
  enum class Frame { png, pixels };
  Canvas(Frame frame, int width, int height, double density);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Puts (0, 0) of the model at `origin` (layout pixels), `scale` pixels per d, y up.
  void look_at(Point origin, double scale);
  /// Back to layout pixels.
  void look_at_layout();

  /// Nothing is drawn outside this part of the layout until show_all().
  void show_only(Point corner, double width, double height);
  void show_all();

  void fill_polygon(std::span<const Point> points, const Colour& colour);
  /// Fills and strokes polygons in one colour, so that neighbours show no seam.
  void fill_tiles(std::span<const std::vector<Point>> tiles, const Colour& colour);
  void stroke_line(std::span<const Point> points, const Colour& colour, double width,
                   bool dashed = false);
  /// Lines that have one colour; where they cross it is no darker, whatever its opacity.
  void stroke_lines(std::span<const std::array<Point, 2>> lines, const Colour& colour,
                    double width);
  void fill_circle(Point centre, double radius, const Colour& colour);
  void stroke_circle(Point centre, double radius, const Colour& colour, double width);
  /// Base line at `at`; size in layout pixels.
  void text(Point at, const std::string& words, double size, const Colour& colour,
            Align align = Align::left, bool bold = false);

  /// Completes the picture: the bytes of its file, of pixels row by row blue, green, red and a byte
  /// without meaning. Throws std::runtime_error if something could not
  /// be drawn.
  std::string finish();

 private:
  struct Surface;
  std::unique_ptr<Surface> surface_;
};

/// Width of a line of text in layout pixels.
double text_width(const std::string& words, double size, bool bold = false);

/// True for file names that a Canvas can write.
bool is_picture_file(const std::string& file);

}  // namespace metamorph::evolve
