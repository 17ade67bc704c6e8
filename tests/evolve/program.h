#pragma once

// Runs the program as a person would.

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/evolve/files.h"

namespace metamorph::tests {

struct ProgramResult {
  int exit_code = -1;
  std::string out, err;

  std::vector<std::string> err_lines() const {
    std::vector<std::string> lines;
    std::istringstream stream(err);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
};

/// Runs `metamorph ARGUMENTS` in `directory`; the arguments are shell text, and so are redirections
/// (of what would be kept otherwise) and commands before it.
inline ProgramResult run_program(const std::filesystem::path& directory,
                                 const std::string& arguments, const std::string& redirections = "",
                                 const std::string& before = "true") {
  const TemporaryDirectory scratch;
  const auto out = scratch.path() / "out", err = scratch.path() / "err";
  // Under the leak sanitizer: fontconfig keeps what it knows about fonts to the end.
  const auto suppressions = scratch.path() / "suppressions";
  std::ofstream(suppressions) << "leak:libfontconfig\n";
  const std::string command =
      "cd '" + directory.string() + "' && " + before +
      // It knows the library by its file, and would complain where nothing else names its calls.
      " && ASAN_OPTIONS=external_symbolizer_path= "
      "LSAN_OPTIONS='print_suppressions=0:suppressions=" +
      suppressions.string() + "' '" METAMORPH_PROGRAM "' " + arguments + " >'" + out.string() +
      "' 2>'" + err.string() + "' " + redirections;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
}

}  // namespace metamorph::tests
