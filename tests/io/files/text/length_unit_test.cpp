// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/length_unit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace arete {
namespace {

TEST(LengthUnit, TurnsALengthIntoMetres) {
  struct Case {
    const char* text;
    double metres;
  };
  // The definitions: international yard of 1959, US survey foot of 1893, nautical mile of 1929.
  for (const Case& c :
       {Case{"20km", 20000}, Case{"5m", 5}, Case{"250 cm", 2.5}, Case{"7mm", 0.007}, Case{"10ft", 3.048},
        Case{"3937us-ft", 1200}, Case{"1mi", 1609.344}, Case{"2.5nmi", 4630}, Case{"1e3m", 1000},
        Case{"+1.5 km ", 1500}, Case{"0ft", 0}, Case{"-2m", -2}, Case{"1e-3km", 1}, Case{".5m", 0.5}}) {
    const auto length = parseLength(c.text, "--radius");
    ASSERT_TRUE(length) << c.text << ": " << length.error().describe();
    EXPECT_TRUE(length->hasUnit()) << c.text;
    const auto metres = inDataUnit(*length, DataUnit{1}, "--radius");
    ASSERT_TRUE(metres) << c.text;
    EXPECT_NEAR(*metres, c.metres, 1e-12 * std::abs(c.metres)) << c.text;
  }
}

TEST(LengthUnit, LeavesANumberWithoutAUnitAsItIs) {
  for (const double number : {0.0, 5.0, -1.25, 1e300, 0.1}) {
    const auto length = parseLength(fmt::format("{}", number), "--radius");
    ASSERT_TRUE(length) << number;
    EXPECT_FALSE(length->hasUnit());
    for (const DataUnit unit : {DataUnit{}, DataUnit{1}, DataUnit{0.3048}})
      EXPECT_EQ(inDataUnit(*length, unit, "").value(), number);
  }
  EXPECT_EQ(parseLength("inf", "").value().number, std::numeric_limits<double>::infinity());
}

TEST(LengthUnit, RefusesUnitsByNameInsteadOfGuessing) {
  // "M" is mega or miles to somebody, "nm" nanometres or nautical miles, "'" feet or minutes.
  for (const char* text :
       {"5M",   "5KM",   "5Km",  "5nm", "5'",     "5feet", "5metres", "5yd",    "5mm2", "5m/s",
        "5kmh", "5 k m", "5mkm", "5e",  "1_000m", "0x10m", "5,5m",    "5 000m", "5µm",  "5%m"}) {
    const auto length = parseLength(text, "--radius");
    ASSERT_FALSE(length) << text;
    EXPECT_EQ(length.error().code, ErrorCode::usage);
    EXPECT_EQ(length.error().culprit, "--radius");
    EXPECT_NE(length.error().message.find("mm, cm, m, km, ft, us-ft, mi, nmi"), std::string::npos)
        << length.error().message;
  }
  for (const char* text : {"", " ", "m", "km5", "five", "nan", "nanm", "+-5m", "--5m", "infm", "infkm"})
    EXPECT_FALSE(parseLength(text, "")) << text;
}

TEST(LengthUnit, RefusesAUnitWhereThatOfTheDataIsNotKnown) {
  const auto known = parseLength("5m", "").value();
  const auto refused = inDataUnit(known, DataUnit{}, "--max-error 5m");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_EQ(refused.error().culprit, "--max-error 5m");
  EXPECT_FALSE(inDataUnit(parseLength("1e308km", "").value(), DataUnit{1}, "")) << "no number is so large";
}

TEST(LengthUnit, DoesNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "there is no German locale";
  EXPECT_EQ(parseLength("1.5km", "").value().number, 1.5);
  EXPECT_FALSE(parseLength("1,5km", ""));
  std::setlocale(LC_ALL, before.c_str());
}

/// There and back: a length stated in each unit, of data in each unit, is the same length.
TEST(LengthUnit, AgreesWithDefinitionsInExactFractions) {
  struct Unit {
    const char* name;
    double numerator, denominator;  // metres
  };
  constexpr Unit kUnits[] = {{"mm", 1, 1000},   {"cm", 1, 100},        {"m", 1, 1},         {"km", 1000, 1},
                             {"ft", 381, 1250}, {"us-ft", 1200, 3937}, {"mi", 201168, 125}, {"nmi", 1852, 1}};
  constexpr unsigned kSeed = 59;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> numbers(-1e5, 1e5);
  for (int i = 0; i < 200; ++i)
    for (const Unit& stated : kUnits)
      for (const Unit& data : kUnits) {
        const double number = numbers(random);
        const long double exact = static_cast<long double>(number) * stated.numerator * data.denominator /
                                  (static_cast<long double>(stated.denominator) * data.numerator);
        const auto got = inDataUnit(parseLength(fmt::format("{}{}", number, stated.name), "").value(),
                                    DataUnit{data.numerator / data.denominator}, "");
        ASSERT_TRUE(got) << "seed " << kSeed;
        EXPECT_NEAR(*got, static_cast<double>(exact), 1e-14 * std::abs(static_cast<double>(exact)))
            << number << stated.name << " in " << data.name << ", seed " << kSeed;
        if (&stated == &data) {
          EXPECT_EQ(*got, number) << "to the bit";
        }
      }
}

}  // namespace
}  // namespace arete
