#include "evolve/files/trajectory_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/evolve/files.h"

namespace metamorph::evolve {
namespace {

TEST(TrajectoryFile, OneLinePerFrameAndNode) {
  const tests::TemporaryDirectory directory;
  const auto file = directory.path() / "t.csv";
  TrajectoryWriter writer(file, Overwrite::no);
  const std::vector<double> x = {0, 1.5}, y = {-0.25, 1e-9}, vx = {0.1, 3}, vy = {-2, 1e300};
  writer.write({0, 0, x, y, vx, vy});
  writer.write({10, 0.1 + 0.2, y, x, vy, vx});
  EXPECT_FALSE(std::filesystem::exists(file));
  writer.finish();
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(text.str(),
            "step,time,node,x,y,vx,vy\n"
            "0,0,0,0,-0.25,0.1,-2\n"
            "0,0,1,1.5,1e-09,3,1e+300\n"
            "10,0.30000000000000004,0,-0.25,0,-2,0.1\n"
            "10,0.30000000000000004,1,1e-09,1.5,1e+300,3\n");
}

RC_GTEST_PROP(TrajectoryFile, NumbersReadBackToTheSameBits, ()) {
  const double value = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
  RC_PRE(std::isfinite(value));
  const tests::TemporaryDirectory directory;
  const auto file = directory.path() / "t.csv";
  TrajectoryWriter writer(file, Overwrite::no);
  const std::vector<double> one = {value};
  writer.write({0, 0, one, one, one, one});
  writer.finish();
  std::ifstream input(file);
  std::string line;
  std::getline(input, line);
  std::getline(input, line);
  const double again = std::strtod(line.substr(line.rfind(',') + 1).c_str(), nullptr);
  RC_ASSERT(std::bit_cast<std::uint64_t>(again) == std::bit_cast<std::uint64_t>(value));
}

}  // namespace
}  // namespace metamorph::evolve
