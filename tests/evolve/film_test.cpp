// The command film, run as a person would run it.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/film/ffmpeg.h"
#include "tests/bodies.h"
#include "tests/evolve/background_program.h"
#include "tests/evolve/plain_genomes.h"
#include "tests/evolve/program.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::run_program;

constexpr const char* experiment =
    "name = \"tiny\"\n"
    "[development]\nsteps = 300\nmax_cells = 40\n"
    "[scenes.water]\nrun_steps = 200\n"
    "[scenes.land]\nrun_steps = 200\nsettle_quiet_steps = 20\nsettle_max_steps = 60\n"
    "[[trials]]\nname = \"larva\"\nstage = 180\nscene = \"water\"\n"
    "[[trials]]\nname = \"adult\"\nstage = 300\nscene = \"land\"\n";

/// Small and short: 40 frames.
const std::string brief = " --size 160x120 --fps 20 --seconds 2";

class Film : public ::testing::Test {
 protected:
  Film() {
    write_body(here() / "strip.json", tests::strip_body(20), Overwrite::no);
    write_genome(here() / "blob.json", tests::blob_genome(), Overwrite::no);
    std::ofstream(here() / "tiny.toml") << experiment;
  }
  std::filesystem::path here() const { return directory_.path(); }
  std::vector<std::string> names() const { return directory_.names(); }
  tests::ProgramResult film(const std::string& arguments,
                            const std::string& before = "true") const {
    return run_program(here(), "film " + arguments, "", before);
  }
  std::vector<std::string> frames(const std::string& folder) const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(here() / folder)) {
      found.push_back(entry.path().filename().string());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  std::string bytes(const std::string& name) const { return tests::text_of(here() / name); }

 private:
  tests::TemporaryDirectory directory_;
};

/// What ffprobe says of a film's pictures: key=value lines.
class FilmByFfmpeg : public Film {
 protected:
  void SetUp() override {
    if (!is_program("ffmpeg") || !is_program("ffprobe")) {
      GTEST_SKIP() << "ffmpeg and ffprobe are not installed";
    }
  }
  std::string probe(const std::string& name) const {
    const std::string told = (here() / "told").string();
    const std::string command =
        "ffprobe -v error -count_frames -show_entries "
        "stream=codec_name,pix_fmt,width,height,nb_read_frames:format=duration '" +
        (here() / name).string() + "' >'" + told + "'";
    return std::system(command.c_str()) == 0 ? tests::text_of(told) : "";
  }
  double duration(const std::string& told) const {
    const std::size_t at = told.find("duration=");
    return at == std::string::npos ? -1 : std::atof(told.c_str() + at + 9);
  }
};

TEST_F(FilmByFfmpeg, IsOfTheCodecSizeAndLengthThatItsEndingAndOptionsSay) {
  const struct {
    std::string name, codec;
  } films[] = {{"a film.mp4", "h264"}, {"-b.webm", "vp9"}, {"%d.gif", "gif"}};
  for (const auto& [name, codec] : films) {
    const auto result = film("strip.json --out './" + name + "'" + brief);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const std::string told = probe(name);
    EXPECT_THAT(told, HasSubstr("codec_name=" + codec + "\n"));
    EXPECT_THAT(told, HasSubstr("width=160\nheight=120\n"));
    EXPECT_THAT(told, HasSubstr("nb_read_frames=40\n"));
    EXPECT_NEAR(duration(told), 2, 0.051) << name;  // one frame
    if (codec != "gif") {
      EXPECT_THAT(told, HasSubstr("pix_fmt=yuv420p\n"));
    }
  }
}

TEST_F(FilmByFfmpeg, PlaysBeforeAllOfItIsThere) {
  ASSERT_EQ(film("strip.json --out a.mp4" + brief).exit_code, 0);
  const std::string film = bytes("a.mp4");
  ASSERT_NE(film.find("moov"), std::string::npos);
  EXPECT_LT(film.find("moov"), film.find("mdat"));
}

TEST_F(FilmByFfmpeg, ReplacesWhatExistsOnlyWhenAsked) {
  std::ofstream(here() / "a.mp4") << "mine";
  const auto refused = film("strip.json --out a.mp4" + brief);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err_lines(), ElementsAre(HasSubstr("a.mp4: exists already")));
  EXPECT_EQ(bytes("a.mp4"), "mine");
  EXPECT_EQ(film("strip.json --out a.mp4 --overwrite" + brief).exit_code, 0);
  EXPECT_THAT(probe("a.mp4"), HasSubstr("codec_name=h264"));
}

TEST_F(FilmByFfmpeg, OfADiskThatIsFullIsNotThereAndOneLineTellsWhy) {
  const auto whole = film("strip.json --out whole.mp4" + brief);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const std::size_t block = 512, size = bytes("whole.mp4").size();
  const std::vector<std::string> before = names();
  // Nearly nothing, half of it, and too little for what goes before the pictures in the end.
  for (const std::size_t blocks : {std::size_t{1}, size / 2 / block, (size - 1) / block}) {
    const auto result = film("strip.json --out b.mp4" + brief, fmt::format("ulimit -f {}", blocks));
    EXPECT_EQ(result.exit_code, 1) << blocks << " of " << size;
    // LLVM's OpenMP tells that it has no room for a file of its own, too.
    EXPECT_THAT(result.err_lines(), Contains(StartsWith("metamorph: ")).Times(1)) << blocks;
    EXPECT_THAT(result.err_lines(), Contains(StartsWith("metamorph: ffmpeg: "))) << blocks;
    EXPECT_EQ(names(), before);
  }
}

TEST_F(FilmByFfmpeg, OfAKilledProgramNothingIsLeft) {
  const std::vector<std::string> before = names();
  tests::Program program({"film", (here() / "strip.json").string(), "--out",
                          (here() / "long.mp4").string(), "--size", "160x120", "--seconds",
                          "30000"});
  // Until ffmpeg has been started.
  const std::string children = fmt::format("/proc/{0}/task/{0}/children", program.process());
  for (int wait = 0; wait < 3000 && tests::text_of(children).empty(); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::string child = tests::text_of(children);
  ASSERT_NE(child, "");
  program.signal(SIGKILL);
  EXPECT_EQ(program.wait().exit_code, -1);
  // ffmpeg sees that its frames have ended, and ends.
  const std::string process = "/proc/" + child.substr(0, child.find(' ')) + "/fd";
  for (int wait = 0; wait < 3000 && std::filesystem::exists(process); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(std::filesystem::exists(process));
  EXPECT_EQ(names(), before);
}

TEST_F(Film, OfFramesHasThemAllAndTheSameBytesTwice) {
  for (const std::string folder : {"once", "again"}) {
    const auto result = film("blob.json --experiment tiny.toml --copies 1 --reference --out " +
                             folder + "/" + brief);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("40 frames, 2.0 s"));
  }
  const std::vector<std::string> once = frames("once");
  ASSERT_EQ(once.size(), 40U);
  EXPECT_EQ(once.front(), "00001.png");
  EXPECT_EQ(once.back(), "00040.png");
  EXPECT_EQ(frames("again"), once);
  int changes = 0;
  for (std::size_t f = 0; f < once.size(); ++f) {
    EXPECT_EQ(bytes("once/" + once[f]), bytes("again/" + once[f])) << once[f];
    if (f > 0 && bytes("once/" + once[f]) != bytes("once/" + once[f - 1])) ++changes;
  }
  EXPECT_EQ(changes, 39);  // a bar shows how far the film is
  EXPECT_THAT(names(), ElementsAre("again", "blob.json", "once", "strip.json", "tiny.toml"));
}

TEST_F(Film, ShowsEveryColourCameraAndKindInItsOwnWay) {
  std::map<std::string, std::string> shown;
  const auto last_frame = [&](const std::string& options) {
    const std::string folder = fmt::format("f{}", shown.size());
    const auto result =
        film("blob.json --experiment tiny.toml --out " + folder + "/" + brief + " " + options);
    EXPECT_EQ(result.exit_code, 0) << options << result.err;
    shown[bytes(folder + "/00040.png")] = options;
  };
  for (const std::string colour : {"area", "phase", "period", "speed", "birth", "contact"}) {
    last_frame("--kind motion --colour " + colour);
  }
  last_frame("--camera stay");
  last_frame("--camera path");
  last_frame("--kind development");
  last_frame("--trial larva");
  last_frame("strip.json");
  EXPECT_EQ(shown.size(), 11U);
}

TEST_F(Film, LastsAsLongAsItsSpeedSays) {
  // 200 paper steps of 0.2 at 20 time units a second, 10 frames each.
  const auto result =
      film("strip.json --set scenes.water.run_steps=200 --out a/ --size 64x64 --fps 10 --speed 20");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(frames("a").size(), 20U);
}

TEST_F(Film, TellsWhatWasExpectedInOneLine) {
  const auto refused = [&](const std::string& arguments, const std::string& words,
                           const std::string& before = "true") {
    const std::vector<std::string> there = names();
    const auto result = film(arguments, before);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err_lines(), ElementsAre(HasSubstr(words))) << arguments;
    EXPECT_EQ(names(), there) << arguments;
  };
  const std::string to = " --out a/";
  refused("strip.json --out a.avi", "a.avi: expected a name that ends in .mp4, .webm or .gif");
  refused("strip.json --out a.mp4", "ffmpeg: not found on PATH", "PATH=/nowhere");
  refused("strip.json --out a.mp4 --size 161x120", "161x120: expected even numbers");
  refused("strip.json --out none/a/", "expected none to exist");
  refused("strip.json --out ./", "exists already: expected a new folder");
  refused("strip.json --size 1280" + to, "1280: expected WIDTHxHEIGHT");
  refused("strip.json --size 10x64" + to, "10x64: expected WIDTHxHEIGHT");
  refused("strip.json --colour green" + to,
          "expected area, phase, period, speed, birth or contact");
  refused("strip.json --camera drone" + to, "expected follow, stay or path");
  refused("strip.json --speed 1 --seconds 2" + to, "--seconds");
  refused("strip.json --kind development" + to, "expected life or motion for a body");
  refused("strip.json --trial larva" + to, "expected a run or a genome, not a body");
  refused("blob.json --experiment tiny.toml --trial tadpole" + to, "expected larva or adult");
  refused("blob.json --experiment tiny.toml --kind development --trial larva" + to,
          "not together with --kind development");
  refused("strip.json --speed 0.01 --fps 120" + to, "expected 1000000 at most");
  refused("none.json" + to, "none.json");
}

/// A program that is called ffmpeg, in a folder of its own that comes first.
class FilmByAnother : public Film {
 protected:
  void put(const std::string& script) const {
    std::filesystem::create_directory(here() / "bin");
    std::ofstream(here() / "bin/ffmpeg") << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(here() / "bin/ffmpeg", std::filesystem::perms::owner_all);
  }
  void is_told(const std::string& words) const {
    const auto result = film("strip.json --out a.mp4" + brief, "PATH=\"$PWD/bin:$PATH\"");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err_lines(), ElementsAre(words));
    EXPECT_THAT(names(), ElementsAre("bin", "blob.json", "strip.json", "tiny.toml"));
  }
};

TEST_F(FilmByAnother, IsToldHowItFailed) {
  put("echo 'Unknown encoder' >&2; echo 'and so on' >&2; exit 1");
  is_told("metamorph: ffmpeg: Unknown encoder");
  put("exit 7");
  is_told("metamorph: ffmpeg: exit code 7");
  put("kill -9 $$");
  is_told("metamorph: ffmpeg: ended by signal 9");
  put("exit 0");
  is_told("metamorph: ffmpeg: ended before the film did");
  put("cat >/dev/null; exit 0");
  is_told("metamorph: ffmpeg: wrote nothing");
}

}  // namespace
}  // namespace metamorph::evolve
