// The kernel tells this process of every call that could touch a file, waits, and does what it is
// answered (seccomp_unotify(2)). Nothing of the program is replaced, so no call is missed.

#include "tests/evolve/disk_faults.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/vfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "tests/evolve/files.h"

namespace metamorph::tests {
namespace {

/// A system call on a file, which one of its arguments names or has open.
struct Call {
  enum class File { descriptor, path };
  long number;
  const char* name;
  File file;
  std::size_t argument;  ///< which one; of those that give a file a name, the new name
};

constexpr Call::File descriptor = Call::File::descriptor, path = Call::File::path;

constexpr Call watched[] = {
#ifdef SYS_open  // those that newer architectures have no more
    {SYS_open, "open", path, 0},
    {SYS_stat, "stat", path, 0},
    {SYS_lstat, "lstat", path, 0},
    {SYS_access, "access", path, 0},
    {SYS_unlink, "unlink", path, 0},
    {SYS_rename, "rename", path, 1},
    {SYS_link, "link", path, 1},
    {SYS_mkdir, "mkdir", path, 0},
    {SYS_rmdir, "rmdir", path, 0},
    {SYS_chmod, "chmod", path, 0},
    {SYS_readlink, "readlink", path, 0},
#endif
    {SYS_openat, "openat", path, 1},
    {SYS_newfstatat, "newfstatat", path, 1},
    {SYS_statx, "statx", path, 1},
    {SYS_statfs, "statfs", path, 0},
    {SYS_faccessat, "faccessat", path, 1},
    {SYS_faccessat2, "faccessat2", path, 1},
    {SYS_unlinkat, "unlinkat", path, 1},
#ifdef SYS_renameat
    {SYS_renameat, "renameat", path, 3},
#endif
    {SYS_renameat2, "renameat2", path, 3},
    {SYS_linkat, "linkat", path, 3},
    {SYS_mkdirat, "mkdirat", path, 1},
    {SYS_fchmodat, "fchmodat", path, 1},
    {SYS_truncate, "truncate", path, 0},
    {SYS_readlinkat, "readlinkat", path, 1},
    {SYS_read, "read", descriptor, 0},
    {SYS_pread64, "pread64", descriptor, 0},
    {SYS_write, "write", descriptor, 0},
    {SYS_pwrite64, "pwrite64", descriptor, 0},
    {SYS_writev, "writev", descriptor, 0},
    {SYS_pwritev, "pwritev", descriptor, 0},
    {SYS_fsync, "fsync", descriptor, 0},
    {SYS_fdatasync, "fdatasync", descriptor, 0},
    {SYS_ftruncate, "ftruncate", descriptor, 0},
    {SYS_fallocate, "fallocate", descriptor, 0},
    {SYS_fstat, "fstat", descriptor, 0},
    {SYS_fstatfs, "fstatfs", descriptor, 0},
    {SYS_fchmod, "fchmod", descriptor, 0},
    {SYS_fchown, "fchown", descriptor, 0},
    {SYS_fcntl, "fcntl", descriptor, 0},
    {SYS_lseek, "lseek", descriptor, 0},
    {SYS_getdents64, "getdents64", descriptor, 0},
    {SYS_mmap, "mmap", descriptor, 4},
};

const Call& call_of(long number) {
  return *std::find_if(std::begin(watched), std::end(watched),
                       [&](const Call& call) { return call.number == number; });
}

bool is_write(long number) { return number == SYS_write || number == SYS_pwrite64; }

bool makes_file(const seccomp_data& call) {
#ifdef SYS_open
  if (call.nr == SYS_open) return (call.args[1] & O_CREAT) != 0;
#endif
  return call.nr == SYS_openat && (call.args[2] & (O_CREAT | (O_TMPFILE & ~O_DIRECTORY))) != 0;
}

bool grows(const seccomp_data& call) {
  constexpr const char* growing[] = {"rename",  "renameat", "renameat2", "link",      "linkat",
                                     "mkdir",   "mkdirat",  "write",     "pwrite64",  "writev",
                                     "pwritev", "fsync",    "fdatasync", "ftruncate", "fallocate"};
  const std::string name = call_of(call.nr).name;
  return makes_file(call) || std::any_of(std::begin(growing), std::end(growing),
                                         [&](const char* known) { return name == known; });
}

/// Asks the kernel to tell of the watched calls of this process; the descriptor that they come
/// from, or -1.
int listen_to_calls() {
  std::vector<sock_filter> filter = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offsetof(seccomp_data, nr)))};
  for (const Call& call : watched) {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call.number), 0, 1));
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return -1;
  return static_cast<int>(
      ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER, &program));
}

/// Lets the two processes take turns on one processor, where the kernel knows how (6.6): else each
/// of thousands of calls waits for a time slice.
void take_turns(int listener) {
  const std::uint64_t on_current_processor = 1;
  ::ioctl(listener, _IOW('!', 4, std::uint64_t), on_current_processor);
}

union DescriptorMessage {
  cmsghdr header;
  char bytes[CMSG_SPACE(sizeof(int))];
};

msghdr message_of(iovec& byte, DescriptorMessage& message) {
  msghdr head{};
  head.msg_iov = &byte;
  head.msg_iovlen = 1;
  head.msg_control = message.bytes;
  head.msg_controllen = sizeof message.bytes;
  return head;
}

void send_descriptor(int socket, int sent) {
  char nothing = 0;
  iovec byte{&nothing, 1};
  DescriptorMessage message{};
  msghdr head = message_of(byte, message);
  message.header.cmsg_level = SOL_SOCKET;
  message.header.cmsg_type = SCM_RIGHTS;
  message.header.cmsg_len = CMSG_LEN(sizeof(int));
  std::memcpy(CMSG_DATA(&message.header), &sent, sizeof sent);
  ::sendmsg(socket, &head, 0);
}

/// -1 if nothing is sent.
int receive_descriptor(int socket) {
  char nothing = 0;
  iovec byte{&nothing, 1};
  DescriptorMessage message{};
  msghdr head = message_of(byte, message);
  int received = -1;
  if (::recvmsg(socket, &head, MSG_CMSG_CLOEXEC) <= 0 || head.msg_controllen == 0) return -1;
  std::memcpy(&received, CMSG_DATA(&message.header), sizeof received);
  return received;
}

/// Answers the calls of one child until it ends.
class Supervisor {
 public:
  Supervisor(pid_t child, int listener, const std::filesystem::path& directory,
             const DiskFault& fault, DisturbedEnd& end)
      : child_(child),
        process_(static_cast<int>(::syscall(SYS_pidfd_open, child, 0))),
        listener_(listener),
        directory_(directory.string()),
        fault_(fault),
        end_(end) {}
  ~Supervisor() {
    ::close(process_);
    ::close(listener_);
  }

  void serve() {
    while (true) {
      pollfd ready[2] = {{listener_, POLLIN, 0}, {process_, POLLIN, 0}};
      if (::poll(ready, 2, -1) < 0 && errno != EINTR) return;
      if ((ready[0].revents & POLLIN) == 0) {
        if (ready[1].revents != 0) return;
        continue;
      }
      seccomp_notif call{};
      if (::ioctl(listener_, SECCOMP_IOCTL_NOTIF_RECV, &call) != 0) continue;  // it died
      seccomp_notif_resp answer{};
      answer.id = call.id;
      answer.flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;
      disturb(call, answer);
      ::ioctl(listener_, SECCOMP_IOCTL_NOTIF_SEND, &answer);
    }
  }

 private:
  static void fail(seccomp_notif_resp& answer, int error) {
    answer.flags = 0;
    answer.error = -error;
  }

  void disturb(const seccomp_notif& call, seccomp_notif_resp& answer) {
    const std::string file = file_of(call.pid, call.data);
    if (!file.starts_with(directory_)) return;
    if (fault_.on_nfs && look_like_nfs(call, file, answer)) return;
    if (!counts(call.data)) return skip_sync(call.data, answer);
    const long number = ++end_.calls;
    if (number < fault_.first || number > fault_.last) return skip_sync(call.data, answer);
    if (end_.disturbed.empty()) {
      end_.disturbed = fmt::format("{} {}", call_of(call.data.nr).name, file);
    }
    switch (fault_.kind) {
      case DiskFault::Kind::none:
        break;
      case DiskFault::Kind::error:
        fail(answer, fault_.error);
        break;
      case DiskFault::Kind::short_half:
        write_half(call, answer);
        break;
      case DiskFault::Kind::kill:
        ::kill(child_, SIGKILL);
        break;
    }
  }

  /// No power fails here: without it a sync changes nothing but the time that the test takes.
  static void skip_sync(const seccomp_data& call, seccomp_notif_resp& answer) {
    if (call.nr == SYS_fsync || call.nr == SYS_fdatasync) answer.flags = 0;
  }

  bool counts(const seccomp_data& call) const {
    switch (fault_.calls) {
      case DiskFault::Calls::growing:
        return grows(call);
      case DiskFault::Calls::writes:
        return is_write(call.nr) && call.args[2] > 1;
      default:
        return true;
    }
  }

  /// The file that a call is about: its path, or "" for what is none.
  std::string file_of(pid_t thread, const seccomp_data& call) const {
    const Call& known = call_of(call.nr);
    if (known.file == descriptor) return opened_file(thread, call.args[known.argument]);
    std::string name(4096, '\0');
    iovec here{name.data(), name.size()};
    iovec there{reinterpret_cast<void*>(call.args[known.argument]), name.size()};
    // Up to the end of what is mapped there: page by page at its end.
    ssize_t size = ::process_vm_readv(thread, &here, 1, &there, 1, 0);
    if (size < 0) {
      there.iov_len = 4096 - call.args[known.argument] % 4096;
      size = ::process_vm_readv(thread, &here, 1, &there, 1, 0);
    }
    name.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    name.resize(std::min(name.size(), name.find('\0')));
    // A descriptor and an empty path: the file that is open.
    if (name.empty() && known.argument == 1) return opened_file(thread, call.args[0]);
    return name;
  }

  static std::string opened_file(pid_t thread, std::uint64_t number) {
    std::error_code error;
    return std::filesystem::read_symlink(
               fmt::format("/proc/{}/fd/{}", thread, static_cast<int>(number)), error)
        .string();
  }

  /// Whether the call was answered here.
  bool look_like_nfs(const seccomp_notif& call, const std::string& file,
                     seccomp_notif_resp& answer) const {
    if (call.data.nr == SYS_openat && (call.data.args[2] & O_TMPFILE) == O_TMPFILE) {
      fail(answer, EOPNOTSUPP);
      return true;
    }
    if (call.data.nr != SYS_statfs) return false;
    struct statfs facts{};
    if (::statfs(file.c_str(), &facts) != 0) return false;
    facts.f_type = 0x6969;
    const iovec here{&facts, sizeof facts};
    const iovec there{reinterpret_cast<void*>(call.data.args[1]), sizeof facts};
    ::process_vm_writev(call.pid, &here, 1, &there, 1, 0);
    answer.flags = 0;
    return true;
  }

  /// Writes half of it in place of the child, through a copy of its descriptor.
  void write_half(const seccomp_notif& call, seccomp_notif_resp& answer) const {
    const auto& arguments = call.data.args;
    std::string bytes(arguments[2] / 2, '\0');
    const iovec here{bytes.data(), bytes.size()};
    const iovec there{reinterpret_cast<void*>(arguments[1]), bytes.size()};
    const int file = static_cast<int>(::syscall(SYS_pidfd_getfd, process_, arguments[0], 0));
    answer.flags = 0;
    if (file < 0 || ::process_vm_readv(call.pid, &here, 1, &there, 1, 0) < 0) {
      answer.error = -ENOSYS;
      return;
    }
    const ssize_t written = call.data.nr == SYS_write ? ::write(file, bytes.data(), bytes.size())
                                                      : ::pwrite(file, bytes.data(), bytes.size(),
                                                                 static_cast<off_t>(arguments[3]));
    if (written < 0) answer.error = -errno;
    if (written >= 0) answer.val = written;
    ::close(file);
  }

  pid_t child_;
  int process_;
  int listener_;
  std::string directory_;
  DiskFault fault_;
  DisturbedEnd& end_;
};

}  // namespace

DisturbedEnd run_disturbed(const std::vector<std::string>& arguments,
                           const std::filesystem::path& directory, const DiskFault& fault) {
  const TemporaryDirectory scratch;
  const std::string output = (scratch.path() / "output").string();
  std::vector<std::string> words = {METAMORPH_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  DisturbedEnd end;
  int sockets[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) return end;
  const pid_t child = ::fork();
  if (child == 0) {
    const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::close(file);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int listener = listen_to_calls();
    if (listener >= 0) {
      send_descriptor(sockets[1], listener);
      ::execv(argv[0], argv.data());
    }
    ::_exit(127);
  }
  ::close(sockets[1]);
  const int listener = receive_descriptor(sockets[0]);
  ::close(sockets[0]);
  if (listener >= 0) {
    end.is_supported = true;
    take_turns(listener);
    Supervisor(child, listener, directory, fault, end).serve();
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  end.output = text_of(output);
  return end;
}

}  // namespace metamorph::tests
