#include "kernels/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/tolerance.h"

namespace metamorph::kernels {
namespace {

template <class T>
double worst_relative_error_of_tanh_half() {
  double worst = 0;
  for (double x = 1e-30; x < 100; x *= 1.0001) {
    const T argument = static_cast<T>(x);
    const long double exact = std::tanh(static_cast<long double>(argument) / 2);
    const long double error = (static_cast<long double>(tanh_half(argument)) - exact) / exact;
    worst = std::max(worst, static_cast<double>(std::fabs(error)));
  }
  return worst;
}

TEST(TanhHalf, KeepsItsErrorBound) {
  EXPECT_TRUE(tests::within(worst_relative_error_of_tanh_half<float>(), 4e-7));
  EXPECT_TRUE(tests::within(worst_relative_error_of_tanh_half<double>(), 1e-15));
}

TEST(TanhHalf, IsOddAndStaysWithinOne) {
  for (double x = 1e-6; x < 200; x *= 1.01) {
    EXPECT_EQ(tanh_half(-x), -tanh_half(x));
    EXPECT_EQ(tanh_half(static_cast<float>(-x)), -tanh_half(static_cast<float>(x)));
    EXPECT_LE(tanh_half(x), 1.0);
    EXPECT_LE(tanh_half(static_cast<float>(x)), 1.0f);
  }
  EXPECT_EQ(tanh_half(0.0), 0.0);
}

TEST(TanhHalf, SaturatesExactlyAndPassesNotANumberOn) {
  EXPECT_EQ(tanh_half(32.0f), 1.0f);
  EXPECT_EQ(tanh_half(-64.0), -1.0);
  EXPECT_EQ(tanh_half(std::numeric_limits<float>::infinity()), 1.0f);
  EXPECT_EQ(tanh_half(-std::numeric_limits<double>::infinity()), -1.0);
  EXPECT_TRUE(std::isnan(tanh_half(std::numeric_limits<float>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(tanh_half(std::numeric_limits<double>::quiet_NaN())));
}

template <class T>
double worst_error_of_sin_cos_pi() {
  double worst = 0;
  for (int i = -100000; i <= 100000; ++i) {
    const T u = static_cast<T>(i * 1e-5);
    T sine, cosine;
    sin_cos_pi(u, sine, cosine);
    const long double angle = std::numbers::pi_v<long double> * static_cast<long double>(u);
    worst = std::max({worst, static_cast<double>(std::fabs(sine - std::sin(angle))),
                      static_cast<double>(std::fabs(cosine - std::cos(angle)))});
  }
  return worst;
}

TEST(SinCosPi, KeepsItsErrorBound) {
  EXPECT_TRUE(tests::within(worst_error_of_sin_cos_pi<float>(), 2e-7));
  EXPECT_TRUE(tests::within(worst_error_of_sin_cos_pi<double>(), 5e-16));
}

TEST(SinCosPi, IsExactAtQuarterTurns) {
  const double sines[] = {0, -1, 0, 1, 0}, cosines[] = {-1, 0, 1, 0, -1};
  for (int q = -2; q <= 2; ++q) {
    double sine, cosine;
    sin_cos_pi(q * 0.5, sine, cosine);
    EXPECT_EQ(sine, sines[q + 2]);
    EXPECT_EQ(cosine, cosines[q + 2]);
  }
}

}  // namespace
}  // namespace metamorph::kernels
