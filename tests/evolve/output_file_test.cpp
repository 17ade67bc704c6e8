// Files that appear whole or not at all, whatever happens meanwhile.

#include "evolve/files/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <atomic>
#include <barrier>
#include <cerrno>
#include <fstream>
#include <thread>

#include "tests/evolve/child.h"
#include "tests/evolve/files.h"
#include "tests/evolve/sanitized.h"

namespace metamorph::evolve {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using tests::in_child;
using tests::lines_of;
using tests::refuse_calls;
using tests::text_of;

constexpr unsigned nameless = O_TMPFILE & ~O_DIRECTORY;

mode_t rights_of(const std::filesystem::path& file) {
  struct stat info{};
  ::stat(file.c_str(), &info);
  return info.st_mode & 07777;
}

class OutputFileTest : public ::testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return directory_.path() / name; }
  std::vector<std::string> names() const { return directory_.names(); }
  std::string fault(const std::string& name, const std::string& text) const {
    return path(name).string() + ": " + text;
  }
  /// Whether files here can be without a name.
  bool holds_nameless() const {
    const int descriptor = ::open(directory_.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
    if (descriptor >= 0) ::close(descriptor);
    return descriptor >= 0;
  }

  tests::TemporaryDirectory directory_;
  const std::string long_text_ = std::string(300000, 'x');  // is written before commit()
};

TEST_F(OutputFileTest, AppearsWithCommit) {
  OutputFile file(path("a"), Overwrite::no);
  file.write(long_text_);
  file.write("end");
  EXPECT_FALSE(std::filesystem::exists(path("a")));
  file.commit();
  EXPECT_THAT(names(), ElementsAre("a"));
  EXPECT_EQ(text_of(path("a")), long_text_ + "end");
  const mode_t mask = ::umask(022);
  ::umask(mask);
  EXPECT_EQ(rights_of(path("a")), 0666 & ~mask);
  {
    OutputFile abandoned(path("b"), Overwrite::no);
    abandoned.write(long_text_);
  }
  EXPECT_THAT(names(), ElementsAre("a"));
}

TEST_F(OutputFileTest, KilledItLeavesNothingAndTheOldFileWhole) {
  if (!holds_nameless()) GTEST_SKIP() << "no file is without a name here";
  write_file(path("old"), "old", Overwrite::no);
  for (const std::string name : {"old", "new"}) {
    const auto killed = in_child([&]() -> std::string {
      OutputFile file(path(name), Overwrite::yes);
      file.write(long_text_);
      ::kill(::getpid(), SIGKILL);
      return "";
    });
    EXPECT_TRUE(WIFSIGNALED(killed.status));
    EXPECT_THAT(names(), ElementsAre("old"));
    EXPECT_EQ(text_of(path("old")), "old");
  }
}

TEST_F(OutputFileTest, ReplacesOnlyWhenTold) {
  write_file(path("a"), "mine", Overwrite::no);
  ::chmod(path("a").c_str(), 0640);
  const std::string exists = fault("a", "exists already: expected a new file, or --overwrite");
  EXPECT_THAT(lines_of([&] { write_file(path("a"), "b", Overwrite::no); }), ElementsAre(exists));
  EXPECT_EQ(text_of(path("a")), "mine");
  write_file(path("a"), "new", Overwrite::yes);
  EXPECT_EQ(text_of(path("a")), "new");
  EXPECT_EQ(rights_of(path("a")), 0640u);
  EXPECT_THAT(names(), ElementsAre("a"));
}

TEST_F(OutputFileTest, OfManyAtOnceOneWins) {
  constexpr int writers = 4, rounds = 25;
  for (int round = 0; round < rounds; ++round) {
    const std::string name = "file" + std::to_string(round);
    std::barrier all(writers);
    std::atomic<int> winners = 0, losers = 0;
    std::string text;
    std::vector<std::thread> threads;
    for (int w = 0; w < writers; ++w) {
      threads.emplace_back([&, w] {
        OutputFile file(path(name), Overwrite::no);
        file.write(std::string(10, static_cast<char>('a' + w)));
        all.arrive_and_wait();
        const auto lines = lines_of([&] { file.commit(); });
        if (lines.empty()) {
          text = std::string(10, static_cast<char>('a' + w));
          ++winners;
        } else if (lines == std::vector{fault(name,
                                              "exists already: expected a new file, or "
                                              "--overwrite")}) {
          ++losers;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(winners, 1);
    EXPECT_EQ(losers, writers - 1);
    EXPECT_EQ(text_of(path(name)), text);
  }
  EXPECT_EQ(names().size(), static_cast<std::size_t>(rounds));
}

// Where the file system can do less: files have names always, and a rename cannot be told to
// replace nothing.
TEST_F(OutputFileTest, IsAsWholeUnderATemporaryName) {
  for (const bool plain_renames : {false, true}) {
    const auto result = in_child([&]() -> std::string {
      if (!refuse_calls(SYS_openat, EOPNOTSUPP, nameless) ||
          (plain_renames && !refuse_calls(SYS_renameat2, EINVAL))) {
        return "skip";
      }
      std::string told;
      OutputFile late(path("late"), Overwrite::no);
      for (const std::string& name : names()) told += name + ' ';
      write_file(path("late"), "other", Overwrite::no);
      for (const std::string& line : lines_of([&] { late.commit(); })) told += line + ' ';
      write_file(path("late"), text_of(path("late")) + " and new", Overwrite::yes);
      OutputFile abandoned(path("b"), Overwrite::no);
      abandoned.write(long_text_);
      return told;
    });
    if (result.text == "skip") GTEST_SKIP() << "the kernel cannot be asked to refuse calls";
    EXPECT_THAT(result.text, AllOf(StartsWith(".metamorph-"),
                                   HasSubstr(".part " + fault("late", "exists already: "))));
    EXPECT_THAT(names(), ElementsAre("late")) << plain_renames;
    EXPECT_EQ(text_of(path("late")), "other and new");
    std::filesystem::remove(path("late"));
  }
}

TEST_F(OutputFileTest, WhatAKilledWriterLeftCanBeRemoved) {
  const auto result = in_child([&]() -> std::string {
    if (!refuse_calls(SYS_openat, EOPNOTSUPP, nameless)) return "skip";
    OutputFile killed(path("killed"), Overwrite::no);
    ::kill(::getpid(), SIGKILL);
    return "";
  });
  if (result.text == "skip") GTEST_SKIP() << "the kernel cannot be asked to refuse calls";
  EXPECT_THAT(names(), ElementsAre(AllOf(StartsWith(".metamorph-"), EndsWith(".part"))));
  // Of somebody who lives, and names that mean nothing.
  const std::string living = ".metamorph-" + std::to_string(::getpid()) + "-0.part";
  for (const std::string& name : {living, std::string(".metamorph-.part"), std::string("b.part")}) {
    std::ofstream(path(name)) << "kept";
  }
  remove_abandoned(directory_.path());
  EXPECT_THAT(names(), ElementsAre(".metamorph-.part", living, "b.part"));
  remove_abandoned(path("none"));
}

TEST_F(OutputFileTest, EveryFaultIsOneLineAndLeavesNothing) {
  struct Case {
    const char* name;
    long call;
    int error;
    bool named;  ///< only where files have names always
  };
  const Case cases[] = {
      {"write", SYS_write, ENOSPC, false},     {"write", SYS_write, EDQUOT, true},
      {"fsync", SYS_fsync, EIO, false},        {"close", SYS_close, EIO, false},
      {"linkat", SYS_linkat, EPERM, false},
#ifdef SYS_rename
      {"rename", SYS_rename, EIO, false},
#endif
      {"renameat2", SYS_renameat2, EIO, true},
  };
  write_file(path("old"), "old", Overwrite::no);
  for (const Case& c : cases) {
    if (tests::is_sanitized && c.call == SYS_write) continue;  // which probes memory by writing it
    const bool replaces = std::string_view(c.name) != "renameat2";
    const std::string name = replaces ? "old" : "new";
    const auto result = in_child([&]() -> std::string {
      if (c.named && !refuse_calls(SYS_openat, EOPNOTSUPP, nameless)) return "skip";
      if (!refuse_calls(c.call, c.error)) return "skip";
      write_file(path(name), long_text_, replaces ? Overwrite::yes : Overwrite::no);
      return "written";
    });
    if (result.text == "skip") GTEST_SKIP() << "the kernel cannot be asked to refuse calls";
    EXPECT_EQ(result.text, fault(name, std::generic_category().message(c.error) +
                                           ": expected a file that can be written"))
        << c.name;
    EXPECT_THAT(names(), ElementsAre("old")) << c.name;
    EXPECT_EQ(text_of(path("old")), "old") << c.name;
  }
}

TEST_F(OutputFileTest, AFileSizeLimitIsAFault) {
  const auto result = in_child([&]() -> std::string {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    write_file(path("a"), long_text_, Overwrite::no);
    return "written";
  });
  EXPECT_EQ(result.text, fault("a", "File too large: expected a file that can be written"));
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(OutputFileTest, WritesWhatALinkLeadsTo) {
  std::filesystem::create_directory(path("in"));
  write_file(path("in/target"), "old", Overwrite::no);
  std::filesystem::create_symlink("in/target", path("link"));
  std::filesystem::create_symlink(path("link"), path("second"));
  std::filesystem::create_symlink("in/none", path("dangling"));
  std::filesystem::create_symlink("loop", path("loop"));
  for (const std::string name : {"link", "second", "dangling"}) {
    EXPECT_THAT(lines_of([&] { write_file(path(name), "x", Overwrite::no); }),
                ElementsAre(fault(name, "exists already: expected a new file, or --overwrite")));
    write_file(path(name), name, Overwrite::yes);
    EXPECT_TRUE(std::filesystem::is_symlink(path(name)));
    EXPECT_EQ(text_of(path(name == "dangling" ? "in/none" : "in/target")), name);
  }
  EXPECT_THAT(lines_of([&] { write_file(path("loop"), "x", Overwrite::yes); }),
              ElementsAre(StartsWith(fault("loop", "Too many levels of symbolic links: "))));
}

TEST_F(OutputFileTest, RefusesWhatIsNoFile) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  for (const std::string& file : {path("pipe").string(), std::string("/dev/null")}) {
    for (const Overwrite overwrite : {Overwrite::no, Overwrite::yes}) {
      EXPECT_THAT(
          lines_of([&] { write_file(file, "x", overwrite); }),
          ElementsAre(file + ": a device, a pipe or a socket: expected the name of a file"));
    }
  }
  EXPECT_THAT(lines_of([&] { write_file(directory_.path(), "x", Overwrite::yes); }),
              ElementsAre(EndsWith(": a directory: expected the name of a file")));
  EXPECT_THAT(lines_of([&] { write_file(path("none/a"), "x", Overwrite::yes); }),
              ElementsAre(HasSubstr(": no such directory: expected ")));
  const std::string name(300, 'a');
  EXPECT_THAT(lines_of([&] { write_file(path(name), "x", Overwrite::no); }),
              ElementsAre(StartsWith(fault(name, "File name too long: expected"))));
}

TEST_F(OutputFileTest, SaysThatADirectoryCannotBeWritten) {
  std::filesystem::create_directory(path("in"));
  ::chmod(directory_.path().c_str(), 0755);
  ::chmod(path("in").c_str(), 0555);
  const auto result = in_child([&]() -> std::string {
    constexpr uid_t nobody = 65534;  // root may write everywhere
    if (::geteuid() == 0 && ::setresuid(nobody, nobody, nobody) != 0) return "skip";
    check_writable(path("in/a"), Overwrite::no);
    return "";
  });
  if (result.text == "skip") GTEST_SKIP() << "rights cannot be given up";
  EXPECT_EQ(result.text, fault("in/a", "Permission denied: expected a file that can be written"));
}

}  // namespace
}  // namespace metamorph::evolve
