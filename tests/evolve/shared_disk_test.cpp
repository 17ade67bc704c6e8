#include "evolve/run/shared_disk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/magic.h>
#include <unistd.h>

#include "tests/evolve/child.h"
#include "tests/evolve/damage.h"

namespace metamorph::evolve {
namespace {

using testing::HasSubstr;
using tests::TemporaryDirectory;

TEST(SharedDisk, KindsAreKnownByTheirNumbers) {
  EXPECT_EQ(shared_kind(NFS_SUPER_MAGIC), "NFS");
  EXPECT_EQ(shared_kind(V9FS_MAGIC), "9P");
  EXPECT_EQ(shared_kind(CEPH_SUPER_MAGIC), "Ceph");
  EXPECT_EQ(shared_kind(CIFS_SUPER_MAGIC), "CIFS");
  EXPECT_EQ(shared_kind(FUSE_SUPER_MAGIC), "FUSE");
  // A signed 32-bit field that is widened repeats its sign.
  EXPECT_EQ(shared_kind(static_cast<unsigned long>(static_cast<int>(CIFS_SUPER_MAGIC))), "CIFS");
  const std::vector<unsigned long> locals = {EXT4_SUPER_MAGIC, BTRFS_SUPER_MAGIC, XFS_SUPER_MAGIC,
                                             TMPFS_MAGIC, OVERLAYFS_SUPER_MAGIC};
  for (const unsigned long local : locals) {
    EXPECT_EQ(shared_kind(local), std::nullopt) << local;
  }
  EXPECT_EQ(shared_disk_of("/proc"), std::nullopt);
  EXPECT_EQ(shared_disk_of("/none"), std::nullopt);
}

/// What a process that may write nothing of ours says of `action`; "same" if it said true.
template <class Action>
std::string as_nobody(Action action) {
  return tests::in_child([&]() -> std::string {
           if (geteuid() == 0 && setuid(65534) != 0) return "cannot become nobody";
           return action() ? "same" : "other";
         })
      .text;
}

// A copy made while the run is written is what a killed run leaves.
TEST(KilledRun, CanBeReadWhereNothingCanBeWritten) {
  using std::filesystem::perms;
  const TemporaryDirectory directory;
  std::filesystem::permissions(directory.path(), static_cast<perms>(0711));
  const std::filesystem::path path = directory.path() / "run", killed = directory.path() / "killed";
  std::vector<std::string> truth;
  for (const std::string journal : {"WAL", "DELETE"}) {
    std::filesystem::remove_all(path);
    std::filesystem::remove_all(killed);
    tests::run_whole(path, tests::tiny_experiment("novelty", 2));
    truth = tests::readings_of(path);
    {
      Database database(path / "run.db", Database::Mode::write);
      database.run("PRAGMA journal_mode = " + journal +
                   "; PRAGMA cache_size = 1; PRAGMA wal_autocheckpoint = 0");
      if (journal == "WAL") {
        database.run("UPDATE run SET value = value");
        std::filesystem::create_directory(killed);
        for (const char* part : {"run.db", "run.db-wal"}) {
          std::filesystem::copy_file(path / part, killed / part);
        }
      } else {
        database.run(
            "BEGIN; DELETE FROM individuals; CREATE TABLE more AS WITH RECURSIVE n(i) AS (SELECT 1 "
            "UNION ALL SELECT i + 1 FROM n WHERE i < 3000) SELECT i, randomblob(500) FROM n");
        std::filesystem::copy(path, killed);
        database.run("ROLLBACK");
      }
    }
    const std::string left = journal == "WAL" ? "run.db-wal" : "run.db-journal";
    ASSERT_TRUE(std::filesystem::exists(killed / left));
    for (const auto& file : std::filesystem::directory_iterator(killed)) {
      std::filesystem::permissions(file, static_cast<perms>(0444));
    }
    std::filesystem::permissions(killed, static_cast<perms>(0555));
    EXPECT_EQ(as_nobody([&] {
                const std::vector<std::string> found = tests::readings_of(killed);
                if (found != truth) RunReader(killed).verify();  // tells why
                return found == truth;
              }),
              "same")
        << journal;
    std::filesystem::permissions(killed, perms::owner_all);
  }
}

}  // namespace
}  // namespace metamorph::evolve
