#include "evolve/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "evolve/files/input_error.h"

namespace metamorph::evolve {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view value,
                         std::string_view expected) {
  FaultList faults(file.string());
  faults.add("", value, expected);
  throw InputError(faults.lines());
}

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  refuse(file, error == ENOENT ? "no such file" : std::generic_category().message(error),
         "a file that can be read");
}

void check_kind(const std::filesystem::path& file, const struct stat& info) {
  if (S_ISDIR(info.st_mode)) refuse(file, "a directory", "a file");
  if (!S_ISREG(info.st_mode)) refuse(file, "a device, a pipe or a socket", "a file");
}

[[noreturn]] void refuse_length(const std::filesystem::path& file) {
  refuse(file, "too long", "at most " + std::to_string(largest_input >> 20) + " MiB");
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  operator int() const { return number_; }

 private:
  int number_;
};

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  struct stat info{};
  // Asked before, for opening alone means something to some devices, and after, for it may have
  // been another file then. Opening a pipe would wait for its other end.
  if (::stat(file.c_str(), &info) != 0) refuse(file, errno);
  check_kind(file, info);
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (descriptor < 0 || ::fstat(descriptor, &info) != 0) refuse(file, errno);
  check_kind(file, info);
  if (std::cmp_greater(info.st_size, largest_input)) refuse_length(file);
  std::string text;
  char buffer[1 << 16];
  while (true) {
    const ssize_t read = ::read(descriptor, buffer, sizeof buffer);
    if (read == 0) return text;
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) refuse(file, errno);
    text.append(buffer, static_cast<std::size_t>(read));
    if (text.size() > largest_input) refuse_length(file);  // it grew, or never told its length
  }
}

}  // namespace metamorph::evolve
