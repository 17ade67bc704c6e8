#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace metamorph::evolve {

enum class Overwrite { no, yes };

/// A file that appears whole or not at all: it is written where nobody sees it, and has its name
/// when commit() returns, on the disk as well. What is killed before leaves nothing behind, where
/// the file system can hold a file without a name; else, and in the moment in which it takes the
/// place of another one, a hidden .metamorph-*.part.
/// Nothing existing is replaced unless Overwrite::yes says so, nor what others put there meanwhile;
/// what is replaced is whole until then, and its rights are kept. A symbolic link stays: what it
/// leads to is written. Devices, pipes and sockets are refused, for they cannot be replaced.
/// Faults (exists already, no such directory, disk full) throw InputError with one line.
class OutputFile {
 public:
  OutputFile(std::filesystem::path file, Overwrite overwrite);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();  ///< without commit(): leaves nothing behind

  void write(std::string_view text);
  /// For a program that writes the bytes instead, by this descriptor opened anew
  /// (/proc/self/fd/N of its own process). It must have ended before commit().
  int descriptor() const { return descriptor_; }
  void commit();

 private:
  [[noreturn]] void fail(int error) const;
  void open_named();
  bool link_to(const std::filesystem::path& name) const;
  void flush();
  void appear();
  void rename_temporary();
  void sync_directory() const;

  std::filesystem::path file_;  ///< as it was given
  Overwrite overwrite_;
  std::filesystem::path target_;     ///< what is written: file_, or what it leads to
  std::filesystem::path directory_;  ///< of target_
  std::filesystem::path temporary_;  ///< empty: the file has no name yet
  std::string buffer_;               ///< not written yet
  int descriptor_ = -1;
};

/// Writes a whole file through OutputFile.
void write_file(const std::filesystem::path& file, std::string_view text, Overwrite overwrite);

/// Removes each .metamorph-*.part in `directory` whose writer was killed. On a disk that machines
/// share the caller has to know that no other one writes there.
void remove_abandoned(const std::filesystem::path& directory);

/// Throws InputError if `file` exists and may not be overwritten, or its place cannot be written:
/// to be asked before long work whose result will be written there.
void check_writable(const std::filesystem::path& file, Overwrite overwrite);

}  // namespace metamorph::evolve
