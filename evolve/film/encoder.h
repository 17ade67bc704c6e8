#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "evolve/files/output_file.h"
#include "evolve/view/canvas.h"

namespace metamorph::evolve {

struct FilmFormat {
  int width = 1280, height = 720;  ///< pixels
  int fps = 30;
};

/// Where frames go. What they become is there whole after finish(), or not at all.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual Canvas::Frame form() const = 0;  ///< in which add() takes frames
  virtual void add(std::string_view frame) = 0;
  virtual void finish() = 0;
};

/// Throws InputError with a line for each fault: a name of which no film or folder can come, a
/// format it cannot have, something that exists, no ffmpeg. To be asked before long work.
void check_film(const std::string& out, const FilmFormat& format, Overwrite overwrite);

/// By the ending of `out`: .mp4 (H.264), .webm (VP9) or .gif by the program ffmpeg; one that ends
/// in '/' is a new folder with a PNG for each frame. Throws InputError as check_film() does, its
/// sink std::runtime_error with what ffmpeg says.
std::unique_ptr<FrameSink> open_film(const std::string& out, const FilmFormat& format,
                                     Overwrite overwrite);

}  // namespace metamorph::evolve
