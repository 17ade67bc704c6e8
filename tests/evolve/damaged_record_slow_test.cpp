#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "tests/evolve/damage.h"

namespace metamorph::evolve {
namespace {

using tests::TemporaryDirectory;

// A thousand times another bit: info, export, audit and resume give what was recorded, or one line.
TEST(ThousandFlippedBits, AreToldOrChangeNothing) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory.path() / "run", copy = directory.path() / "copy";
  tests::run_whole(path, tests::tiny_experiment("novelty", 3));
  const std::string whole = tests::text_of(path / "run.db");
  const auto put = [&](const std::string& bytes) {
    std::filesystem::remove_all(copy);
    std::filesystem::create_directory(copy);
    std::ofstream(copy / "run.db", std::ios::binary) << bytes;
  };
  const std::vector<std::string> truth = tests::readings_of(path);
  const std::string audited = tests::audit_reading(path);
  put(whole);
  const std::string resumed = tests::resumed_reading(copy);
  int refused = 0;
  std::mt19937 random(2016);
  for (int n = 0; n < 1000; ++n) {
    std::string bytes = whole;
    const std::size_t place = random() % whole.size();
    const unsigned bit = random() % 8;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << bit));
    put(bytes);
    bool any_refused = false;
    const auto compare = [&](const std::string& found, const std::string& expected,
                             const std::string& what) {
      EXPECT_TRUE(found == expected || found == "refused")
          << what << ", bit " << bit << " of byte " << place << ": " << found.substr(0, 300);
      any_refused = any_refused || found == "refused";
    };
    const std::vector<std::string> found = tests::readings_of(copy);
    for (std::size_t r = 0; r < truth.size(); ++r) {
      compare(found[r], truth[r], fmt::format("reading {}", r));
    }
    compare(tests::audit_reading(copy), audited, "audit");
    put(bytes);
    compare(tests::resumed_reading(copy), resumed, "resume");
    refused += any_refused ? 1 : 0;
  }
  std::printf("%d of 1000 flipped bits were told by somebody\n", refused);
  EXPECT_GT(refused, 300);  // most of the file holds data
}

}  // namespace
}  // namespace metamorph::evolve
