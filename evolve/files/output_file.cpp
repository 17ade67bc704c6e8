#include "evolve/files/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "evolve/files/input_error.h"

namespace metamorph::evolve {

void check_writable(const std::filesystem::path& file, Overwrite overwrite) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(file.string() + ": a directory: expected the name of a file");
  }
  if (overwrite == Overwrite::no && std::filesystem::exists(file, error)) {
    throw InputError(file.string() + ": exists already: expected a new file, or --overwrite");
  }
  const std::filesystem::path directory =
      file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(directory, error)) {
    throw InputError(file.string() + ": no such directory: expected " + directory.string() +
                     " to exist");
  }
}

OutputFile::OutputFile(std::filesystem::path file, Overwrite overwrite)
    : file_(std::move(file)), overwrite_(overwrite) {
  check_writable(file_, overwrite_);
  temporary_ = file_;
  temporary_ += ".part" + std::to_string(::getpid());
  stream_ = std::fopen(temporary_.c_str(), "wbx");
  if (stream_ == nullptr) fail(std::strerror(errno));
}

OutputFile::~OutputFile() {
  if (stream_ == nullptr) return;
  std::fclose(stream_);
  std::error_code error;
  std::filesystem::remove(temporary_, error);
}

void OutputFile::fail(const std::string& reason) const {
  throw InputError(file_.string() + ": " + reason + ": expected a file that can be written");
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) fail(std::strerror(errno));
}

void OutputFile::commit() {
  if (std::fflush(stream_) != 0) fail(std::strerror(errno));
  check_writable(file_, overwrite_);
  std::error_code error;
  std::filesystem::rename(temporary_, file_, error);
  if (error) fail(error.message());
  std::fclose(std::exchange(stream_, nullptr));
}

void write_file(const std::filesystem::path& file, std::string_view text, Overwrite overwrite) {
  OutputFile output(file, overwrite);
  output.write(text);
  output.commit();
}

}  // namespace metamorph::evolve
