#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace metamorph::evolve {

enum class Overwrite { no, yes };

/// A file that appears whole or not at all: it is written under a temporary name in the same
/// directory and renamed by commit(). Nothing existing is replaced unless Overwrite::yes says so.
/// Faults (exists already, no such directory, disk full) throw InputError with one line.
class OutputFile {
 public:
  OutputFile(std::filesystem::path file, Overwrite overwrite);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();  ///< without commit(): leaves nothing behind

  void write(std::string_view text);
  void commit();

 private:
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path file_;
  std::filesystem::path temporary_;
  Overwrite overwrite_;
  std::FILE* stream_ = nullptr;
};

/// Writes a whole file through OutputFile.
void write_file(const std::filesystem::path& file, std::string_view text, Overwrite overwrite);

/// Throws InputError if `file` exists and may not be overwritten: to be asked before long work
/// whose result will be written there.
void check_writable(const std::filesystem::path& file, Overwrite overwrite);

}  // namespace metamorph::evolve
