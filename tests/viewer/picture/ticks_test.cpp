// SPDX-License-Identifier: GPL-3.0-or-later
// Ticks are round, within the range, and read well.
#include "viewer/picture/ticks.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using test::kNone;

TEST(Ticks, NumbersReadWell) {
  EXPECT_EQ(numberText(0), "0");
  EXPECT_EQ(numberText(1234), "1234");
  EXPECT_EQ(numberText(-0.5), "\u22120.5");
  EXPECT_EQ(numberText(93410), "93\u2009410");
  EXPECT_EQ(numberText(9.98765), "9.988");
  EXPECT_EQ(numberText(kNone), "?");
  EXPECT_EQ(countText(1535664), "1\u2009535\u2009664");
  EXPECT_EQ(signedText(2.5), "+2.5");
}

TEST(Ticks, StepsAreRound) {
  EXPECT_DOUBLE_EQ(roundDownNice(4999), 2000);
  EXPECT_DOUBLE_EQ(roundDownNice(5000), 5000);
  EXPECT_DOUBLE_EQ(roundDownNice(0.003), 0.002);
  EXPECT_EQ(linearTicks(-10, 10, 4), (std::vector<double>{-10, -5, 0, 5, 10}));
  std::vector<double> major;
  for (const LogTick& tick : logTicks(1, 100)) {
    if (tick.major) major.push_back(tick.value);
  }
  EXPECT_EQ(major, (std::vector<double>{1, 2, 5, 10, 20, 50, 100}));
}

TEST(Ticks, RoundsDownToOneTwoOrFiveTimesAPowerOfTen) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-12, 12);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::pow(10, exponent(random)), nice = roundDownNice(value);
    SCOPED_TRACE(value);
    EXPECT_LE(nice, value * (1 + 1e-12));
    EXPECT_GT(nice, value / 2.5 * (1 - 1e-12)) << "the next one is at most 2.5 times as large";
    const double mantissa = nice / std::pow(10, std::floor(std::log10(nice) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 ||
                std::abs(mantissa - 5) < 1e-9)
        << nice;
  }
}

TEST(Ticks, AreEquallyFarApartAndWithinTheRange) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> any(-1000, 1000);
  for (int i = 0; i < 500; ++i) {
    const double a = any(random), b = any(random), low = std::min(a, b), high = std::max(a, b) + 1e-3;
    const std::vector<double> ticks = linearTicks(low, high, 8);
    SCOPED_TRACE(low);
    SCOPED_TRACE(high);
    ASSERT_GE(ticks.size(), 2u);
    EXPECT_LE(ticks.size(), 30u);
    const double step = ticks[1] - ticks[0], slack = 1e-9 * (high - low);
    EXPECT_GE(ticks.front(), low - slack);
    EXPECT_LE(ticks.back(), high + slack);
    for (std::size_t k = 1; k < ticks.size(); ++k) EXPECT_NEAR(ticks[k] - ticks[k - 1], step, slack);
  }
}

/// What a person reads.
double numberOf(std::string text) {
  const auto replace = [&](const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what))
      text.replace(at, what.size(), by);
  };
  replace("\u2009", "");
  replace("\u2212", "-");
  return std::stod(text);
}

TEST(Ticks, HaveTextsThatTellThemApart) {
  const std::vector<double> relief = linearTicks(4321.2, 4321.8, 6);
  EXPECT_EQ(tickTexts(relief),
            (std::vector<std::string>{"4321.2", "4321.3", "4321.4", "4321.5", "4321.6", "4321.7", "4321.8"}));
  EXPECT_EQ(tickTexts(std::vector<double>{-20, 0, 20}), (std::vector<std::string>{"\u221220", "0", "20"}));
  EXPECT_EQ(tickTexts(std::vector<double>{7}), std::vector<std::string>{"7"});
  const unsigned seed = 60;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 3000; ++i) {
    const auto exponent = [&](double low, double high) {
      return std::pow(10, std::uniform_real_distribution<double>(low, high)(random));
    };
    const double middle = exponent(-8, 14) * (i % 2 == 0 ? 1 : -1), range = exponent(-9, 14);
    if (range < std::abs(middle) * 1e-13) continue;
    const std::vector<double> ticks = linearTicks(middle, middle + range, 6);
    const std::vector<std::string> texts = tickTexts(ticks);
    ASSERT_EQ(texts.size(), ticks.size());
    SCOPED_TRACE(::testing::Message() << middle << " + " << range);
    for (std::size_t k = 1; k < ticks.size(); ++k) {
      const double step = ticks[k] - ticks[k - 1];
      ASSERT_NE(texts[k], texts[k - 1]);
      ASSERT_NEAR(numberOf(texts[k]) - numberOf(texts[k - 1]), step, step * 0.05);
      ASSERT_NEAR(numberOf(texts[k]), ticks[k], step * 0.05);
    }
  }
}

TEST(Ticks, OfNumbersThatDoublesHardlyTellApartAreTheEnds) {
  const double low = 1e17, high = 1e17 + 64;
  EXPECT_EQ(linearTicks(low, high, 8), (std::vector<double>{low, high}));
}

TEST(Ticks, OfALogarithmAreMajorAtPowersOfTen) {
  for (const auto& [low, high] : {std::pair{0.3, 40.0}, {1.0, 1000.0}, {1e-6, 1e7}}) {
    double last = 0;
    for (const LogTick& tick : logTicks(low, high)) {
      EXPECT_GE(tick.value, low * (1 - 1e-9));
      EXPECT_LE(tick.value, high * (1 + 1e-9));
      EXPECT_GT(tick.value, last) << "rising";
      last = tick.value;
      const double decade = std::log10(tick.value);
      if (std::abs(decade - std::round(decade)) < 1e-9) {
        EXPECT_TRUE(tick.major) << tick.value;
      }
    }
    EXPECT_GT(last, 0);
  }
}

}  // namespace
}  // namespace arete
