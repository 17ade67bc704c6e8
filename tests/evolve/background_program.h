#pragma once

// Runs the program beside the test, which may send it signals and change its limits.

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/evolve/files.h"

namespace metamorph::tests {

struct Ended {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string output;  ///< stdout and stderr
};

/// The program, running in the background.
class Program {
 public:
  /// `file_limit` bytes, if not 0, is the largest file it may write.
  explicit Program(const std::vector<std::string>& arguments, rlim_t file_limit = 0) {
    std::vector<std::string> words = {METAMORPH_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    child_ = fork();
    if (child_ == 0) {
      const int file = open(output().c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      dup2(file, STDOUT_FILENO);
      dup2(file, STDERR_FILENO);
      if (file_limit != 0) {
        const rlimit limit{file_limit, file_limit};
        setrlimit(RLIMIT_FSIZE, &limit);
      }
      execv(argv[0], argv.data());
      _exit(127);
    }
  }

  pid_t process() const { return child_; }
  void signal(int number) const { kill(child_, number); }

  Ended wait() {
    int status = 0;
    waitpid(child_, &status, 0);
    Ended ended;
    if (WIFEXITED(status)) ended.exit_code = WEXITSTATUS(status);
    ended.output = text_of(output());
    return ended;
  }

 private:
  std::filesystem::path output() const { return directory_.path() / "output"; }

  TemporaryDirectory directory_;
  pid_t child_ = -1;
};

}  // namespace metamorph::tests
