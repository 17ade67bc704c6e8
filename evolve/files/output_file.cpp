#include "evolve/files/output_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <system_error>
#include <utility>

#include "evolve/files/input_error.h"

namespace metamorph::evolve {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t chunk = 1 << 16;  ///< bytes written at once
constexpr int most_links = 40;          ///< of a chain of symbolic links, as the kernel follows
constexpr mode_t for_all = 0666;        ///< less the umask

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw InputError(file.string() + ": " + reason + ": expected a file that can be written");
}

[[noreturn]] void refuse_existing(const fs::path& file) {
  throw InputError(file.string() + ": exists already: expected a new file, or --overwrite");
}

std::string message(int error) { return std::generic_category().message(error); }

/// What a chain of symbolic links ends at, which need not exist.
fs::path behind_links(const fs::path& file) {
  fs::path end = file;
  for (int i = 0; i < most_links; ++i) {
    std::error_code no_link;
    const fs::path next = fs::read_symlink(end, no_link);
    if (no_link) return end;
    end = end.parent_path() / next;
  }
  refuse(file, message(ELOOP));
}

fs::path directory_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Where a file would be written; throws if it may not be.
fs::path target_of(const fs::path& file, Overwrite overwrite) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::none) refuse(file, error.message());
  if (fs::is_directory(status)) {
    throw InputError(file.string() + ": a directory: expected the name of a file");
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InputError(file.string() + ": a device, a pipe or a socket: expected the name of a file");
  }
  std::error_code ignored;
  if (overwrite == Overwrite::no && (fs::exists(status) || fs::is_symlink(file, ignored))) {
    refuse_existing(file);
  }
  const fs::path target = behind_links(file);
  const fs::path directory = directory_of(target);
  if (!fs::is_directory(directory, ignored)) {
    throw InputError(file.string() + ": no such directory: expected " + directory.string() +
                     " to exist");
  }
  if (::access(directory.c_str(), W_OK | X_OK) != 0) refuse(file, message(errno));
  return target;
}

constexpr std::string_view temporary_begin = ".metamorph-", temporary_end = ".part";

/// A name for a moment beside the file; each call gives another one.
fs::path temporary_in(const fs::path& directory) {
  static std::atomic<unsigned> count = 0;
  std::string name(temporary_begin);
  name += std::to_string(::getpid()) + "-" + std::to_string(count.fetch_add(1));
  return directory / name.append(temporary_end);
}

/// Whether a file has a temporary name, and the process that gave it is no more.
bool is_abandoned(const std::string& name) {
  if (!name.starts_with(temporary_begin) || !name.ends_with(temporary_end)) return false;
  pid_t process = 0;
  std::from_chars(name.data() + temporary_begin.size(), name.data() + name.size(), process);
  return process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
}

std::string descriptor_path(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

}  // namespace

void remove_abandoned(const fs::path& directory) {
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (is_abandoned(entry->path().filename().string())) fs::remove(entry->path(), ignored);
  }
}

void check_writable(const fs::path& file, Overwrite overwrite) { target_of(file, overwrite); }

OutputFile::OutputFile(fs::path file, Overwrite overwrite)
    : file_(std::move(file)),
      overwrite_(overwrite),
      target_(target_of(file_, overwrite_)),
      directory_(directory_of(target_)) {
  descriptor_ = ::open(directory_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, for_all);
  // Without /proc the file could never get its name.
  if (descriptor_ >= 0 && ::access(descriptor_path(descriptor_).c_str(), F_OK) != 0) {
    ::close(std::exchange(descriptor_, -1));
  }
  if (descriptor_ < 0) open_named();
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::fail(int error) const { refuse(file_, message(error)); }

void OutputFile::open_named() {
  do {
    fs::path name = temporary_in(directory_);
    descriptor_ = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, for_all);
    if (descriptor_ >= 0) temporary_ = std::move(name);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) fail(errno);
}

void OutputFile::write(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= chunk) flush();
}

void OutputFile::flush() {
  std::string_view left = buffer_;
  while (!left.empty()) {
    const ssize_t written = ::write(descriptor_, left.data(), left.size());
    if (written < 0 && errno != EINTR) fail(errno);
    if (written > 0) left.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void OutputFile::commit() {
  flush();
  if (::fsync(descriptor_) != 0) fail(errno);
  // Some file systems tell of a fault when a file is closed. A copy of the descriptor is told the
  // same, while nothing has been replaced yet.
  const int copy = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (copy < 0 || ::close(copy) != 0) fail(errno);
  appear();
  ::close(std::exchange(descriptor_, -1));
  sync_directory();
}

/// Gives the file without a name one that is free; false if it is not.
bool OutputFile::link_to(const fs::path& name) const {
  if (::linkat(AT_FDCWD, descriptor_path(descriptor_).c_str(), AT_FDCWD, name.c_str(),
               AT_SYMLINK_FOLLOW) == 0) {
    return true;
  }
  if (errno != EEXIST) fail(errno);
  return false;
}

void OutputFile::appear() {
  if (temporary_.empty()) {
    if (link_to(target_)) return;
    if (overwrite_ == Overwrite::no) refuse_existing(file_);
    // A link replaces nothing, a rename does.
    fs::path name;
    do {
      name = temporary_in(directory_);
    } while (!link_to(name));
    temporary_ = std::move(name);
  }
  rename_temporary();
  temporary_.clear();
}

void OutputFile::rename_temporary() {
  if (overwrite_ == Overwrite::yes) {
    struct stat old{};
    if (::stat(target_.c_str(), &old) == 0) ::fchmod(descriptor_, old.st_mode & 07777);
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    return;
  }
  if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0) {
    return;
  }
  if (errno == EINVAL || errno == ENOSYS) {  // a file system that knows plain renames only
    if (::link(temporary_.c_str(), target_.c_str()) == 0) {
      ::unlink(temporary_.c_str());
      return;
    }
  }
  if (errno == EEXIST) refuse_existing(file_);
  fail(errno);
}

/// Makes the name last, too. A directory that may be written but not read cannot be asked.
void OutputFile::sync_directory() const {
  const int directory = ::open(directory_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  const int error = ::fsync(directory) == 0 ? 0 : errno;
  ::close(directory);
  if (error != 0 && error != EINVAL) fail(error);  // EINVAL: directories are not synced here
}

void write_file(const fs::path& file, std::string_view text, Overwrite overwrite) {
  OutputFile output(file, overwrite);
  output.write(text);
  output.commit();
}

}  // namespace metamorph::evolve
