// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/colors.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace arete {
namespace {

Attribute colors(ScalarType type, ColorSpace space, std::uint8_t components,
                 const std::vector<std::vector<double>>& elements) {
  Attribute color{.name = "color",
                  .meaning = AttributeMeaning::color,
                  .type = type,
                  .components = components,
                  .isNormalized = !isFloat(type),
                  .colorSpace = space};
  for (const auto& element : elements) color.append(element);
  return color;
}

TEST(Colors, AreConvertedByTheFormulaOfSrgb) {
  // IEC 61966-2-1; the values that its authors and glTF's exporters print.
  EXPECT_DOUBLE_EQ(linearOfSrgb(0), 0);
  EXPECT_DOUBLE_EQ(linearOfSrgb(1), 1);
  EXPECT_NEAR(linearOfSrgb(0.5), 0.21404114048223255, 1e-15);
  EXPECT_NEAR(linearOfSrgb(0.04), 0.04 / 12.92, 1e-17);
  EXPECT_NEAR(srgbOfLinear(0.21404114048223255), 0.5, 1e-15);
  EXPECT_NEAR(srgbOfLinear(0.002), 0.02584, 1e-15);
  for (int i = -1000; i <= 1000; ++i) EXPECT_NEAR(linearOfSrgb(srgbOfLinear(i / 1000.0)), i / 1000.0, 2e-7);
}

TEST(Colors, OfEightBitsComeBackFromSixteenLinearOnes) {
  std::vector<std::vector<double>> codes;
  for (int i = 0; i < 256; ++i) codes.push_back({double(i), double(255 - i), double(i ^ 85), double(i)});
  const Attribute bytes = colors(ScalarType::uint8, ColorSpace::srgb, 4, codes);
  const Attribute linear = toLinear16(bytes);
  EXPECT_EQ(linear.type, ScalarType::uint16);
  EXPECT_EQ(linear.colorSpace, ColorSpace::linear);
  EXPECT_TRUE(linear.isNormalized);
  EXPECT_EQ(linear.numbers(128)[0], 14146) << "65535 times 0.2158605";
  EXPECT_EQ(linear.numbers(128)[3], 128 * 257) << "alpha has no transfer function";
  bool isRounded = false;
  EXPECT_EQ(toSrgb8(linear, isRounded), bytes);
  EXPECT_FALSE(isRounded);
  EXPECT_EQ(toSrgb8(toLinear32(bytes), isRounded), bytes);
  EXPECT_FALSE(isRounded);
}

TEST(Colors, FinerThanEightBitsAreToldFromTheCodes) {
  const auto isRounded = [](const Attribute& color) {
    bool rounded = false;
    toSrgb8(color, rounded);
    return rounded;
  };
  const double code = linearOfSrgb(100 / 255.0);
  using enum ColorSpace;
  EXPECT_FALSE(isRounded(colors(ScalarType::float32, linear, 3, {{0, 1, code}})));
  EXPECT_TRUE(isRounded(colors(ScalarType::float32, linear, 3, {{0, 1, code + 1e-4}})));
  EXPECT_FALSE(isRounded(colors(ScalarType::float64, srgb, 3, {{0.501961, 0, 1}}))) << "128 / 255 as text";
  EXPECT_TRUE(isRounded(colors(ScalarType::float64, srgb, 3, {{0.5, 0, 1}})));
  EXPECT_TRUE(isRounded(colors(ScalarType::float32, srgb, 3, {{1.5, 0, 1}}))) << "brighter than white";
  EXPECT_TRUE(isRounded(colors(ScalarType::float32, srgb, 3, {{-0.1, 0, 1}})));
  EXPECT_TRUE(
      isRounded(colors(ScalarType::float32, srgb, 3, {{std::numeric_limits<double>::quiet_NaN(), 0, 1}})));
  EXPECT_TRUE(isRounded(colors(ScalarType::uint16, srgb, 3, {{300, 0, 1}})));
  EXPECT_FALSE(isRounded(colors(ScalarType::uint16, srgb, 3, {{257, 0, 65535}})));
}

TEST(Colors, OfGltfThatAreTheStandardsAreLeftAsTheyAre) {
  const Attribute linear = colors(ScalarType::uint16, ColorSpace::linear, 3, {{0, 1, 65535}, {7, 8, 9}});
  EXPECT_EQ(toLinear16(linear), linear);
}

}  // namespace
}  // namespace arete
