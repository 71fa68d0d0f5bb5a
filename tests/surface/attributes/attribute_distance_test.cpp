// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/attributes/attribute_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace arete {
namespace {

double between(const Attribute& of, std::vector<double> a, std::vector<double> b,
               std::array<double, 2> pixels = {1, 1}) {
  Attribute two = of;
  two.append(a);
  two.append(b);
  const AttributeDistance distance(two, pixels);
  return distance(distance.values(two, 0), distance.values(two, 1));
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(AttributeDistance, OfColoursIsTheLargestChannelIn255ths) {
  const Attribute bytes{.name = "color",
                        .meaning = AttributeMeaning::color,
                        .type = ScalarType::uint8,
                        .components = 3,
                        .isNormalized = true};
  EXPECT_DOUBLE_EQ(between(bytes, {255, 0, 10}, {250, 3, 10}), 5);
  const Attribute floats{.name = "color", .meaning = AttributeMeaning::color, .components = 4};
  EXPECT_DOUBLE_EQ(between(floats, {0, 0.5, 0, 1}, {0, 0.25, 0, 1}), 63.75);
  Attribute words = bytes;
  words.type = ScalarType::uint16;
  EXPECT_DOUBLE_EQ(between(words, {65535, 0, 0}, {0, 0, 0}), 255);
}

TEST(AttributeDistance, OfNormalsIsTheirAngleWhateverTheirLength) {
  const Attribute normals{.name = "normal", .meaning = AttributeMeaning::normal, .components = 3};
  EXPECT_NEAR(between(normals, {0, 0, 5}, {0, 2, 2}), 45, 1e-6);
  EXPECT_DOUBLE_EQ(between(normals, {1, 0, 0}, {-3, 0, 0}), 180);
  EXPECT_NEAR(between(normals, {1, 0, 0}, {1, 1e-6, 0}), 1e-6 * 180 / M_PI, 1e-10);
  EXPECT_EQ(between(normals, {0, 0, 0}, {0, 0, 0}), 0);
  EXPECT_EQ(between(normals, {0, 0, 0}, {0, 0, 1}), kInfinity);
}

TEST(AttributeDistance, OfCoordinatesIsInTheirUnitOrInPixels) {
  const Attribute coords{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  EXPECT_FLOAT_EQ(float(between(coords, {3, 4}, {3.25, 4})), 0.25f);
  EXPECT_DOUBLE_EQ(between(coords, {0.25, 0}, {0, 0.5}, {400, 100}), std::hypot(100, 50));
  Attribute quantized = coords;
  quantized.type = ScalarType::uint16;
  quantized.isNormalized = true;
  EXPECT_DOUBLE_EQ(between(quantized, {65535, 0}, {0, 0}, {512, 512}), 512);
}

TEST(AttributeDistance, OfLabelsIsNothingOrInfinite) {
  const Attribute labels{.name = "part", .type = ScalarType::int32};
  EXPECT_EQ(between(labels, {7}, {7}), 0);
  EXPECT_EQ(between(labels, {7}, {8}), kInfinity);
}

TEST(AttributeDistance, OfWhatIsNotFiniteIsInfiniteUnlessItIsTheSame) {
  Attribute numbers{.name = "quality", .type = ScalarType::float64};
  numbers.append(std::array{0.5});
  EXPECT_EQ(between(numbers, {std::nan("")}, {1.5}), kInfinity);
}

}  // namespace
}  // namespace arete
