#include "evolve/film/encoder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "evolve/files/input_error.h"
#include "evolve/film/ffmpeg.h"

namespace metamorph::evolve {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

bool is_folder(const std::string& out) { return out.ends_with('/'); }

/// Options that make a film of one ending; none of another one.
Words encoding_of(const std::string& out) {
  // Screens take a film for one of television unless its colours are named.
  const std::string to_yuv = "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
  const Words colours = {"-vf",   to_yuv,       "-colorspace", "bt709",        "-color_primaries",
                         "bt709", "-color_trc", "bt709",       "-color_range", "tv"};
  Words words;
  if (out.ends_with(".mp4")) {
    words = {"-c:v", "libx264",   "-preset",    "medium", "-crf",
             "23",   "-movflags", "+faststart", "-f",     "mp4"};
    words.insert(words.begin(), colours.begin(), colours.end());
  } else if (out.ends_with(".webm")) {
    words = {"-c:v", "libvpx-vp9", "-crf", "32",      "-b:v", "0",  "-deadline",
             "good", "-cpu-used",  "4",    "-row-mt", "1",    "-f", "webm"};
    words.insert(words.begin(), colours.begin(), colours.end());
  } else if (out.ends_with(".gif")) {
    // A palette for each frame: one for all of them would keep every frame in memory.
    words = {"-vf",
             "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=none",
             "-f", "gif"};
  }
  return words;
}

fs::path parent_of(const fs::path& folder) {
  const fs::path parent = folder.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// "a/b/" without its last slashes.
fs::path folder_of(const std::string& out) {
  const std::size_t end = out.find_last_not_of('/');
  return end == std::string::npos ? fs::path("/") : fs::path(out.substr(0, end + 1));
}

void check_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error))) {
    throw InputError(folder.string() + "/: exists already: expected a new folder");
  }
  if (!fs::is_directory(parent_of(folder), error)) {
    throw InputError(folder.string() + "/: no such directory: expected " +
                     parent_of(folder).string() + " to exist");
  }
  if (::access(parent_of(folder).c_str(), W_OK | X_OK) != 0) {
    throw InputError(folder.string() + "/: " + std::generic_category().message(errno) +
                     ": expected a place that can be written");
  }
}

/// A film in one file.
class FilmFile : public FrameSink {
 public:
  FilmFile(const std::string& out, const FilmFormat& format, Overwrite overwrite)
      : file_(out, overwrite), ffmpeg_(arguments(out, format), file_.descriptor()) {}

  Canvas::Frame form() const override { return Canvas::Frame::pixels; }
  void add(std::string_view frame) override { ffmpeg_.write(frame); }
  void finish() override {
    ffmpeg_.finish();
    struct stat written{};
    if (::fstat(file_.descriptor(), &written) != 0 || written.st_size == 0) {
      throw std::runtime_error("ffmpeg: wrote nothing");
    }
    file_.commit();
  }

 private:
  static Words arguments(const std::string& out, const FilmFormat& format) {
    Words words = {"-v",          "error",
                   "-nostdin",    "-xerror",
                   "-f",          "rawvideo",
                   "-pix_fmt",    "bgr0",
                   "-video_size", fmt::format("{}x{}", format.width, format.height),
                   "-framerate",  std::to_string(format.fps),
                   "-i",          "pipe:0",
                   "-an"};
    const Words encoding = encoding_of(out);
    words.insert(words.end(), encoding.begin(), encoding.end());
    // The same film gives the same bytes under the same ffmpeg.
    for (const char* word : {"-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1",
                             "-y", "file:/proc/self/fd/3"}) {
      words.emplace_back(word);
    }
    return words;
  }

  OutputFile file_;
  Ffmpeg ffmpeg_;  // goes first: it writes the file
};

/// A folder of pictures. Until finish() it has a hidden name beside its own.
class FrameFolder : public FrameSink {
 public:
  explicit FrameFolder(fs::path folder) : folder_(std::move(folder)) {
    check_folder(folder_);
    temporary_ = parent_of(folder_) / fmt::format(".metamorph-{}-frames.part", ::getpid());
    std::error_code error;
    if (!fs::create_directory(temporary_, error)) fail(error ? error.value() : EEXIST);
    made_ = true;
  }
  FrameFolder(const FrameFolder&) = delete;
  FrameFolder& operator=(const FrameFolder&) = delete;
  ~FrameFolder() override {
    std::error_code ignored;
    if (made_) fs::remove_all(temporary_, ignored);
  }

  Canvas::Frame form() const override { return Canvas::Frame::png; }

  void add(std::string_view frame) override {
    const fs::path file = temporary_ / fmt::format("{:05}.png", ++count_);
    const int descriptor = ::open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(errno);
    int error = 0;
    while (!frame.empty() && error == 0) {
      const ssize_t written = ::write(descriptor, frame.data(), frame.size());
      if (written < 0 && errno != EINTR) error = errno;
      if (written > 0) frame.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error != 0) fail(error);
  }

  void finish() override {
    if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, folder_.c_str(), RENAME_NOREPLACE) !=
        0) {
      // A file system that knows plain renames only lets none replace a folder with something in
      // it.
      if ((errno != EINVAL && errno != ENOSYS) ||
          ::rename(temporary_.c_str(), folder_.c_str()) != 0) {
        fail(errno);
      }
    }
    made_ = false;
  }

 private:
  [[noreturn]] void fail(int error) const {
    throw InputError(folder_.string() + "/: " + std::generic_category().message(error) +
                     ": expected a folder that can be written");
  }

  fs::path folder_, temporary_;
  bool made_ = false;
  int count_ = 0;
};

}  // namespace

void check_film(const std::string& out, const FilmFormat& format, Overwrite overwrite) {
  if (is_folder(out)) {
    check_folder(folder_of(out));
    return;
  }
  if (encoding_of(out).empty()) {
    throw InputError("--out: " + out +
                     ": expected a name that ends in .mp4, .webm or .gif, or in / for a new folder "
                     "of PNG frames");
  }
  if (!out.ends_with(".gif") && (format.width % 2 != 0 || format.height % 2 != 0)) {
    throw InputError(fmt::format("--size: {}x{}: expected even numbers for {}", format.width,
                                 format.height, out));
  }
  check_writable(out, overwrite);
  if (!is_program("ffmpeg")) {
    throw InputError("ffmpeg: not found on PATH: expected this program for " + out +
                     "; --out frames/ writes PNG frames without it");
  }
}

std::unique_ptr<FrameSink> open_film(const std::string& out, const FilmFormat& format,
                                     Overwrite overwrite) {
  check_film(out, format, overwrite);
  if (is_folder(out)) return std::make_unique<FrameFolder>(folder_of(out));
  return std::make_unique<FilmFile>(out, format, overwrite);
}

}  // namespace metamorph::evolve
