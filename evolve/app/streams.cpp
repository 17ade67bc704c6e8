#include "evolve/app/streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <iterator>
#include <system_error>

namespace metamorph::evolve {

void prepare_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // An open file gets the lowest free number, which is this one. It is open for reading only.
    if (::open("/dev/null", O_RDONLY) != stream) std::_Exit(EXIT_FAILURE);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

void ignore_broken_pipes() { std::signal(SIGPIPE, SIG_IGN); }

bool finish_output() {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return true;
  const int error = errno;
  tell("standard output: {}: expected room for all that is printed\n",
       error == 0 ? "cannot be written" : std::generic_category().message(error));
  return false;
}

void print_to_error(fmt::string_view text, fmt::format_args values) noexcept {
  try {
    fmt::memory_buffer line;
    fmt::vformat_to(std::back_inserter(line), text, values);
    // What could be done if this failed?
    [[maybe_unused]] const auto written = std::fwrite(line.data(), 1, line.size(), stderr);
  } catch (const std::exception&) {  // no memory left even for a line
  }
}

}  // namespace metamorph::evolve
