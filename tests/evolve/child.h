#pragma once

// Does something in a process of its own, which may lose rights, be killed or meet a kernel that
// refuses.

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

namespace metamorph::tests {

/// Status of a child, as of waitpid, and the text that its action gave.
struct ChildResult {
  int status = -1;
  std::string text;
};

/// `action()` gives a text; what it throws is the text, too.
template <class Action>
ChildResult in_child(Action action) {
  int ends[2];
  if (::pipe(ends) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    std::string text;
    try {
      text = action();
    } catch (const std::exception& error) {
      text = error.what();
    }
    // Not write(), which the kernel may have been asked to refuse.
    const iovec whole{text.data(), text.size()};
    [[maybe_unused]] const auto written = ::writev(ends[1], &whole, 1);
    ::_exit(0);
  }
  ::close(ends[1]);
  ChildResult result;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
    result.text.append(buffer, static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  ::waitpid(child, &result.status, 0);
  return result;
}

/// From here on the kernel answers a system call of this process with an error; with a `flag`, only
/// where the third argument has it. False if the kernel cannot be asked for that.
inline bool refuse_calls(long number, int error, unsigned flag = 0) {
  const auto load = [](std::size_t offset) {
    return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset));
  };
  std::vector<sock_filter> filter = {load(offsetof(seccomp_data, nr))};
  const unsigned char rest = flag == 0 ? 1 : 3;  // instructions that are skipped for other calls
  filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, rest));
  if (flag != 0) {
    filter.push_back(load(offsetof(seccomp_data, args) + 2 * sizeof(__u64)));  // its lower half
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, flag, 0, 1));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<unsigned>(error)));
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace metamorph::tests
