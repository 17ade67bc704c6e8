#include "metamorph/development.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/core/network_builder.h"

namespace metamorph::core {
namespace {

using testing::NetworkBuilder;
using Out = testing::Output;
using In = testing::Input;

std::vector<Embryo> grow(const Network& network, std::vector<int> stages,
                         DevelopmentRules rules = {}) {
  return develop(std::vector{network}, rules, stages, 1).front();
}

/// Divides at every update along +x: nothing turns it, and nothing moves since all springs are at
/// rest, exactly. Only the tip has space, so every update adds one cell.
NetworkBuilder line() { return NetworkBuilder().always(Out::inhibit, false); }

void expect_line(const Embryo& embryo, int cells) {
  ASSERT_EQ(embryo.cell_count(), cells);
  EXPECT_TRUE(embryo.faces.empty());
  ASSERT_EQ(embryo.links.size(), static_cast<std::size_t>(cells - 1));
  for (int i = 0; i < cells; ++i) {
    const auto c = static_cast<std::size_t>(i);
    EXPECT_EQ(embryo.id[c], i);
    EXPECT_EQ(embryo.mother[c], i - 1);
    EXPECT_EQ(embryo.birth_step[c], std::max(0, 30 * (i - 1)));
    EXPECT_EQ(embryo.x[c], i);
    EXPECT_EQ(embryo.y[c], 0);
    EXPECT_EQ(embryo.orientation[c], 0);
    if (i > 0) {
      EXPECT_EQ(embryo.links[c - 1], (std::array<Index, 2>{i - 1, i}));
    }
  }
}

TEST(Development, WithoutDivisionTheFounderStaysAlone) {
  for (const Embryo& embryo :
       grow(NetworkBuilder().always(Out::inhibit, true).build(), {0, 1200})) {
    EXPECT_EQ(embryo.status, Status::ok);
    ASSERT_EQ(embryo.cell_count(), 1);
    EXPECT_EQ(embryo.x[0], 0);
    EXPECT_EQ(embryo.y[0], 0);
    EXPECT_EQ(embryo.mother[0], -1);
    EXPECT_EQ(embryo.created, 1);
    EXPECT_EQ(embryo.died, 0);
    EXPECT_TRUE(embryo.links.empty());
  }
}

TEST(Development, AFounderThatDiesAtOnceLeavesNothing) {
  const auto embryos = grow(line().always(Out::die, true).build(), {0, 1, 1200});
  EXPECT_EQ(embryos[0].cell_count(), 1);
  for (const std::size_t stage : {1u, 2u}) {
    EXPECT_EQ(embryos[stage].status, Status::empty);
    EXPECT_EQ(embryos[stage].cell_count(), 0);
    EXPECT_EQ(embryos[stage].created, 1);
    EXPECT_EQ(embryos[stage].died, 1);
  }
}

TEST(Development, DivisionInOneDirectionGrowsAStraightLineByOneCellPerUpdate) {
  const auto embryos = grow(line().build(), {0, 1, 30, 31, 600, 1200});
  expect_line(embryos[0], 1);
  expect_line(embryos[1], 2);  // the first update is at step 0
  expect_line(embryos[2], 2);  // a stage sees the state before the update of its own step
  expect_line(embryos[3], 3);
  expect_line(embryos[4], 21);  // 20 updates
  expect_line(embryos[5], 41);  // 40 updates
}

TEST(Development, TheCapIsHard) {
  DevelopmentRules rules;
  rules.max_cells = 10;
  const auto embryos = grow(line().build(), {269, 271, 1200}, rules);
  expect_line(embryos[0], 10);
  expect_line(embryos[1], 10);
  expect_line(embryos[2], 10);
  EXPECT_EQ(embryos[2].created, 10);
}

TEST(Development, ABodyFillsToTheCapExactly) {
  // Turns by a constant share of a full turn at every update, so that all sides get their turn.
  const Network network = line().link(Out::angle, In::bias, 1.0f).build();
  DevelopmentRules rules;
  for (const int cap : {2, 17, 64, 128}) {
    rules.max_cells = cap;
    const Embryo embryo = grow(network, {1200}, rules).front();
    EXPECT_EQ(embryo.cell_count(), cap);
    EXPECT_EQ(embryo.created, cap);
  }
}

TEST(Development, TimeInhibitsFromItsStepOn) {
  // At step 300 the output is exactly 0: not inhibited. Updates at 0, 30 .. 300 divide.
  const auto embryos =
      grow(NetworkBuilder().positive_after(Out::inhibit, 0.25f).build(), {600, 1200});
  expect_line(embryos[0], 12);
  expect_line(embryos[1], 12);
}

TEST(Development, TimeIsCountedOverTheWholeDevelopmentOfTheRules) {
  DevelopmentRules rules;
  rules.steps = 800;  // half of it lies between the updates at 390 and 420
  const auto embryos =
      grow(NetworkBuilder().positive_after(Out::inhibit, 0.5f).build(), {400, 800}, rules);
  expect_line(embryos[0], 15);
  expect_line(embryos[1], 15);
}

TEST(Development, DividesThenDies) {
  const auto embryos =
      grow(line().positive_after(Out::die, 0.5f).build(), {600, 601, 630, 631, 1200});
  expect_line(embryos[0], 21);
  expect_line(embryos[1], 22);  // exactly 0 at step 600: nobody dies yet
  expect_line(embryos[2], 22);
  for (const std::size_t stage : {3u, 4u}) {
    EXPECT_EQ(embryos[stage].status, Status::empty);
    EXPECT_EQ(embryos[stage].created, 22);
    EXPECT_EQ(embryos[stage].died, 22);
  }
}

TEST(Development, TheDeadMakeSpaceInTheirOwnUpdate) {
  // Cells beyond x = 4.5 die. Cell 5, born in the update at 120, dies at 150, and at once cell 4
  // puts another in its place: one death and one birth per update from then on.
  const auto embryos = grow(
      line().link(Out::die, In::x, 640.0f).link(Out::die, In::bias, -288.0f).build(), {150, 600});
  EXPECT_EQ(embryos[0].cell_count(), 6);
  EXPECT_EQ(embryos[0].died, 0);
  ASSERT_EQ(embryos[1].cell_count(), 6);
  EXPECT_EQ(embryos[1].created, 21);
  EXPECT_EQ(embryos[1].died, 15);
  EXPECT_EQ(embryos[1].id.back(), 20);
  EXPECT_EQ(embryos[1].mother.back(), 4);
  EXPECT_EQ(embryos[1].birth_step.back(), 570);
  EXPECT_EQ(embryos[1].x.back(), 5);
}

TEST(Development, DaughtersStartWithTheMorphogensJustComputed) {
  // Turned by pi the founder divides to the left; its next direction, the daughter's turned by pi,
  // points to the right, where there is space. It stays unused: both cells read a mean of 1.
  const auto builder = [] { return NetworkBuilder().always(Out::angle, true); };
  const Network inhibited = builder()
                                .always(Out::morphogen1, true)
                                .link(Out::inhibit, In::mean1, 64.0f)
                                .link(Out::inhibit, In::bias, -32.0f)
                                .build();
  const Embryo two = grow(inhibited, {1200}).front();
  ASSERT_EQ(two.cell_count(), 2);
  EXPECT_EQ(two.x[1], -1);
  const Embryo free = grow(builder().always(Out::inhibit, false).build(), {31}).front();
  ASSERT_EQ(free.cell_count(), 3);
  EXPECT_EQ(free.x[2], 1);
}

TEST(Development, SecondMorphogenIsReadSeparately) {
  const Network network = NetworkBuilder()
                              .always(Out::angle, true)
                              .always(Out::morphogen1, false)
                              .always(Out::morphogen2, true)
                              .link(Out::inhibit, In::mean2, 64.0f)
                              .link(Out::inhibit, In::bias, -32.0f)
                              .build();
  EXPECT_EQ(grow(network, {1200}).front().cell_count(), 2);
}

TEST(Development, ABlockedCellTurnsAndAnInhibitedOneDoesNot) {
  DevelopmentRules rules;
  rules.max_cells = 1;
  const NetworkBuilder turning = NetworkBuilder().always(Out::angle, true);
  const auto blocked =
      grow(NetworkBuilder(turning).always(Out::inhibit, false).build(), {0, 30, 31}, rules);
  EXPECT_EQ(blocked[0].orientation[0], 0);
  EXPECT_EQ(blocked[1].orientation[0], std::numbers::pi);
  EXPECT_NEAR(blocked[2].orientation[0], 0, 1e-15);
  const auto inhibited =
      grow(NetworkBuilder(turning).always(Out::inhibit, true).build(), {1, 31}, rules);
  EXPECT_EQ(inhibited[0].orientation[0], 0);
  EXPECT_EQ(inhibited[1].orientation[0], 0);
}

TEST(Development, ADaughterIsBornOneDiameterAwayInTheMothersDirection) {
  for (const float weight : {-3.0f, -1.0f, 0.3f, 1.5f}) {
    const Embryo embryo = grow(line().link(Out::angle, In::bias, weight).build(), {1}).front();
    ASSERT_EQ(embryo.cell_count(), 2);
    const double angle = std::numbers::pi * std::tanh(weight / 2.0);
    // Float unit vector: errors of tanh, pi * angle, sine and cosine, each some 1e-7; the spring
    // answers a stretch e with 0.04 e in the first step.
    EXPECT_NEAR(embryo.x[1], std::cos(angle), 2e-6);
    EXPECT_NEAR(embryo.y[1], std::sin(angle), 2e-6);
    EXPECT_NEAR(embryo.orientation[1], angle, 2e-6);
    EXPECT_EQ(embryo.orientation[1], embryo.orientation[0]);
  }
}

TEST(Development, PeriodAndPhaseComeFromTheOutputsAtTheStageEnd) {
  const auto at_end = [](const NetworkBuilder& network) {
    return grow(network.build(), {1200}).front();
  };
  const NetworkBuilder one = NetworkBuilder().always(Out::inhibit, true);
  const Embryo low = at_end(NetworkBuilder(one).always(Out::period, false));
  EXPECT_EQ(low.period[0], 30);
  EXPECT_EQ(low.phase[0], 0);
  const Embryo high =
      at_end(NetworkBuilder(one).always(Out::period, true).always(Out::phase, false));
  EXPECT_EQ(high.period[0], 120);
  EXPECT_EQ(high.phase[0], -std::numbers::pi);
  EXPECT_EQ(at_end(one).period[0], 75);
  // o = tanh(s/2) = 1/4 in the middle of the linear part: 30 + 0.75 * 90; s = ln(5/3).
  const Embryo between = at_end(NetworkBuilder(one)
                                    .link(Out::period, In::bias, 0.510825624f)
                                    .link(Out::phase, In::bias, 0.510825624f));
  EXPECT_NEAR(between.period[0], 97.5, 90 * 2e-7);
  EXPECT_NEAR(between.phase[0], std::numbers::pi / 4, std::numbers::pi * 2e-7);
  // Read with the time of the stage end, not of the last update before it.
  const Embryo timed = at_end(NetworkBuilder(one).link(Out::phase, In::time, 0.510825624f));
  EXPECT_EQ(timed.phase[0], between.phase[0]);
}

TEST(Development, ANetworkThatIsNotANumberIsReportedAndDisturbsNobody) {
  const Network bad =
      line().link(Out::angle, In::bias, std::numeric_limits<float>::quiet_NaN()).build();
  const std::vector<Network> networks = {line().build(), bad, line().build()};
  const std::vector<int> stages = {0, 600, 1200};
  const auto batch = develop(networks, {}, stages, 1);
  EXPECT_EQ(batch[1][0].status, Status::ok);
  EXPECT_EQ(batch[1][1].status, Status::bad_development);
  EXPECT_EQ(batch[1][1].cell_count(), 0);
  EXPECT_EQ(batch[1][2].status, Status::bad_development);
  expect_line(batch[0][2], 41);
  expect_line(batch[2][2], 41);
}

TEST(Development, AnEmbryoWhosePhasesAreNoNumbersIsReported) {
  const float no_number = std::numeric_limits<float>::quiet_NaN();
  for (const Out output : {Out::phase, Out::period}) {
    const Network bad = line().link(output, In::bias, no_number).build();
    for (const Embryo& embryo : grow(bad, {0, 600})) {
      EXPECT_EQ(embryo.status, Status::bad_development);
      EXPECT_EQ(embryo.cell_count(), 0);
      EXPECT_TRUE(embryo.faces.empty());
    }
  }
}

}  // namespace
}  // namespace metamorph::core
