#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

namespace metamorph::evolve {

/// True if there is a program of this name to be run.
bool is_program(const std::string& name);

/// The program ffmpeg, fed with what it reads as pipe:0; what it opens as
/// /proc/self/fd/3 is `output`. No shell is asked, and no name of a file told.
class Ffmpeg {
 public:
  /// Starts it. Throws std::runtime_error, as all others do.
  Ffmpeg(const std::vector<std::string>& arguments, int output);
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;
  ~Ffmpeg();  ///< without finish(): ends it

  void write(std::string_view bytes);
  /// Tells it that this was all, and waits. What it says of a fault is thrown.
  void finish();

 private:
  [[noreturn]] void fail();
  int wait();
  std::string said() const;

  pid_t process_ = -1;
  int input_ = -1;   ///< our end of its standard input
  int errors_ = -1;  ///< its standard error, a file in memory
};

}  // namespace metamorph::evolve
