// Axes and charts.

#include "evolve/view/chart.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>

#include "evolve/view/axis.h"
#include "tests/evolve/svg.h"

namespace metamorph::evolve {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

RC_GTEST_PROP(Ticks, AreRoundFewAndAroundWhatIsShown, ()) {
  const double size = std::pow(10.0, *rc::gen::inRange(-3, 7));
  const double low = size * *rc::gen::inRange(-100, 100) / 7;
  const double high = low + size * *rc::gen::inRange(0, 100) / 11;
  const int most = *rc::gen::inRange(2, 10);
  const Ticks ticks = ticks_around(low, high, most);
  RC_ASSERT(ticks.last > ticks.first);
  RC_ASSERT(ticks.last - ticks.first <= most);
  // A mark may lie inside by rounding of the quotient.
  const double rounding = 1e-8 * ticks.step;
  RC_ASSERT(ticks.low() <= low + rounding);
  RC_ASSERT(ticks.high() >= high - rounding);
  RC_ASSERT(ticks.low() > low - ticks.step);
  const double leading = ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step) + 1e-9));
  RC_ASSERT(std::abs(leading - 1) < 1e-9 || std::abs(leading - 2) < 1e-9 ||
            std::abs(leading - 5) < 1e-9);
  for (const double value : ticks.values()) {
    RC_ASSERT(std::abs(std::stod(ticks.label(value)) - value) <= 1e-5 * std::abs(value) + rounding);
  }
}

TEST(Ticks, OfWholeNumbersAreWhole) {
  for (const int last : {1, 2, 3, 7, 59, 1999}) {
    const Ticks ticks = ticks_around(0, last, 6, true);
    EXPECT_EQ(ticks.step, std::floor(ticks.step)) << last;
    EXPECT_EQ(ticks.label(ticks.step).find('.'), std::string::npos) << last;
  }
}

TEST(Ticks, AreAsCloseAsTheyMayBe) {
  EXPECT_EQ(ticks_around(0, 10, 5).step, 2);
  EXPECT_EQ(ticks_around(0, 10, 10).step, 1);
  EXPECT_EQ(ticks_around(0, 0.7, 5).step, 0.2);
  EXPECT_EQ(ticks_around(0, 0, 5).step, 0.2);  // nothing to show: from 0 to 1
}

Chart chart_with(ChartCurve curve) {
  Chart chart;
  chart.heading = "A <chart> & \"its\" marks";
  chart.remark = "3 runs";
  chart.across = "generation";
  chart.keys = {{"first", curve.colour, false}};
  chart.panels = {{"Panel", "distance, d", {curve}}};
  return chart;
}

int paths_of(const Chart& chart) {
  const tests::Svg svg = tests::read_svg(draw_chart(chart, "a.svg"));
  EXPECT_EQ(svg.fault, "");
  return svg.drawn_paths;
}

TEST(Chart, EveryPieceOfALineIsAPathAndABandHasTwoEdges) {
  const ChartCurve whole{{1, 2, 3, 2, 1}, {}, {}, {}, false};
  const ChartCurve broken{{1, 3, gap, 2, 1}, {}, {}, {}, false};
  const ChartCurve banded{{1, 2, 3, 2, 1}, {0, 1, 2, 1, 0}, {2, 3, 3, 3, 2}, {}, false};
  EXPECT_EQ(paths_of(chart_with(broken)), paths_of(chart_with(whole)) + 1);
  EXPECT_EQ(paths_of(chart_with(banded)), paths_of(chart_with(whole)) + 3);
}

TEST(Chart, WhatCannotBeALineIsADot) {
  const ChartCurve none{{gap, gap, gap}, {}, {}, {}, false};
  const ChartCurve dot{{gap, 1, gap}, {}, {}, {}, false};
  EXPECT_EQ(paths_of(chart_with(dot)), paths_of(chart_with(none)) + 1);
  EXPECT_GT(paths_of(chart_with({{0.0}, {0.0}, {0.0}, {}, false})), 0);
}

TEST(Chart, TheSameChartGivesTheSameBytes) {
  const Chart chart = chart_with({{1, 2, 3}, {0, 1, 2}, {2, 3, 4}, curve_colour(0), true});
  for (const std::string file : {"a.svg", "a.png"}) {
    EXPECT_GT(draw_chart(chart, file).size(), 1000u);
    EXPECT_EQ(draw_chart(chart, file), draw_chart(chart, file)) << file;
  }
}

TEST(Chart, ColoursOfCurvesDiffer) {
  std::set<std::tuple<double, double, double>> colours;
  for (int i = 0; i < curve_colours; ++i) {
    const Colour colour = curve_colour(i);
    colours.insert({colour.red, colour.green, colour.blue});
  }
  EXPECT_EQ(std::ssize(colours), curve_colours);
  EXPECT_EQ(curve_colour(curve_colours), curve_colour(0));
}

}  // namespace
}  // namespace metamorph::evolve
