#pragma once

// Runs the program on a disk that fails on purpose.

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace metamorph::tests {

/// What becomes of some of the system calls that a program makes on the files of a directory.
struct DiskFault {
  enum class Kind {
    none,
    error,       ///< not done, and answered with an error
    short_half,  ///< half of what is to be written is
    kill,        ///< the program is killed instead
  };
  enum class Calls {
    all,      ///< that name such a file or a descriptor of one
    growing,  ///< that a full disk refuses
    writes,   ///< of two bytes at least
  };
  static constexpr long never = std::numeric_limits<long>::max();

  Kind kind = Kind::none;
  Calls calls = Calls::all;
  int error = 0;                    ///< of Kind::error, as errno
  long first = never, last = never; /**< numbers, from 1, of the calls that it happens to */
  /// The directory looks as if it lay on NFS: files without a name cannot be made there either.
  bool on_nfs = false;
};

struct DisturbedEnd {
  bool is_supported = false;  ///< false: the kernel cannot be asked for this
  int exit_code = -1;         ///< -1: ended by a signal
  std::string output;         ///< stdout and stderr
  long calls = 0;             ///< of the kind that the fault counts
  std::string disturbed;      ///< the first call that the fault met, for messages
};

/// Runs the program with these arguments; `directory` is absolute, and need not exist yet.
DisturbedEnd run_disturbed(const std::vector<std::string>& arguments,
                           const std::filesystem::path& directory, const DiskFault& fault);

}  // namespace metamorph::tests
