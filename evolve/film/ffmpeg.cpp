#include "evolve/film/ffmpeg.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "evolve/files/printable.h"

namespace metamorph::evolve {
namespace {

constexpr int output_number = 3;  ///< of its descriptor
constexpr std::size_t longest_told = 300;

[[noreturn]] void refuse(const std::string& what, int error) {
  throw std::runtime_error("ffmpeg: " + what + ": " + std::generic_category().message(error));
}

void close_of(int& descriptor) {
  if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

/// Which descriptors a program starts with, and no signal that we ignore ignored but SIGXFSZ: a
/// file size limit is a fault that it can tell.
class SpawnRules {
 public:
  SpawnRules(int input, int output, int errors) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    // Last: one of the others may have this number.
    ::posix_spawn_file_actions_adddup2(&actions_, output, output_number);
    ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawnattr_init(&attributes_);
    sigset_t usual;
    ::sigemptyset(&usual);
    ::sigaddset(&usual, SIGPIPE);
    ::posix_spawnattr_setsigdefault(&attributes_, &usual);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF);
  }
  SpawnRules(const SpawnRules&) = delete;
  SpawnRules& operator=(const SpawnRules&) = delete;
  ~SpawnRules() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }

  int start(pid_t& process, std::vector<char*>& words) const {
    return ::posix_spawnp(&process, words.front(), &actions_, &attributes_, words.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

bool is_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/bin:/usr/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder.empty() ? "." : folder) / name;
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0) {
      return true;
    }
  }
  return false;
}

Ffmpeg::Ffmpeg(const std::vector<std::string>& arguments, int output) {
  // A socket, not a pipe: one can be written to without a signal when nobody reads any more.
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    refuse("cannot be started", errno);
  }
  input_ = ends[0];
  errors_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  int error = errors_ < 0 ? errno : 0;
  if (error == 0) {
    std::vector<std::string> texts = {"ffmpeg"};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& text : texts) words.push_back(text.data());
    words.push_back(nullptr);
    error = SpawnRules(ends[1], output, errors_).start(process_, words);
  }
  ::close(ends[1]);
  if (error != 0) {
    close_of(input_);
    close_of(errors_);
    process_ = -1;
    refuse("cannot be started", error);
  }
}

Ffmpeg::~Ffmpeg() {
  close_of(input_);
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    wait();
  }
  close_of(errors_);
}

int Ffmpeg::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

void Ffmpeg::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) fail();
    if (sent > 0) bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

void Ffmpeg::finish() {
  close_of(input_);
  const int status = wait();
  // It may say that something could not be written and still end well.
  if (status == 0 && said().empty()) return;
  const std::string words = said();
  if (!words.empty()) throw std::runtime_error("ffmpeg: " + words);
  throw std::runtime_error(WIFSIGNALED(status)
                               ? "ffmpeg: ended by signal " + std::to_string(WTERMSIG(status))
                               : "ffmpeg: exit code " + std::to_string(WEXITSTATUS(status)));
}

void Ffmpeg::fail() {
  finish();
  throw std::runtime_error("ffmpeg: ended before the film did");
}

/// The first line that it said, which the others follow from.
std::string Ffmpeg::said() const {
  std::string text(1 << 14, '\0');
  const ssize_t length = ::pread(errors_, text.data(), text.size(), 0);
  text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) {
      return printable(line.substr(0, longest_told));
    }
  }
  return "";
}

}  // namespace metamorph::evolve
