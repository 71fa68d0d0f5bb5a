// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle sums the squared differences triangle by triangle, from barycentric coordinates.
#include "surface/decimate/attribute_quadrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace arete {
namespace {

struct Sample {
  std::array<Vec3, 3> places;
  std::array<double, 3> numbers;
};

/// The number that is linear over a triangle, where a point's foot on its plane is.
double linear(const Sample& s, const Vec3& p) {
  const Vec3 n = cross(s.places[1] - s.places[0], s.places[2] - s.places[0]);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = s.places[(i + 1) % 3], &b = s.places[(i + 2) % 3];
    sum += dot(cross(a - p, b - p), n) / dot(n, n) * s.numbers[i];
  }
  return sum;
}

TEST(AttributeQuadrics, AreTheLeastSumOfWeightedSquaredDifferences) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  const Attribute height{.name = "height", .type = ScalarType::float64};
  const std::array<const Attribute*, 1> attributes = {&height};
  const std::array<AttributeWeight, 1> weights = {{{"height", 0.5}}};
  for (int round = 0; round < 20; ++round) {
    const AttributeChannels channels(attributes, weights, 4);  // a difference of 1 counts 2
    AttributeQuadric quadric;
    std::vector<std::pair<Sample, double>> all;
    for (int t = 0; t < 5; ++t) {
      Sample s{};
      for (Vec3& p : s.places) p = {any(random), any(random), any(random)};
      for (double& x : s.numbers) x = any(random);
      const double weight = 1.5 + any(random);
      all.emplace_back(s, weight);
      quadric += channels.ofTriangle(s.places, weight,
                                     [&](std::size_t, std::size_t corner) { return s.numbers[corner]; });
    }
    const Vec3 p{any(random), any(random), any(random)};
    double mean = 0, sum = 0;
    for (const auto& [s, weight] : all) {
      mean += weight * linear(s, p);
      sum += weight;
    }
    mean /= sum;
    double least = 0, off = 0;
    for (const auto& [s, weight] : all) {
      const double d = linear(s, p) - mean;
      least += 4 * weight * d * d;
      off += 4 * weight * (d - 0.25) * (d - 0.25);
    }
    EXPECT_NEAR(channels.withBest(quadric).at(p), least, 1e-6 * (1 + least)) << "round " << round;
    EXPECT_NEAR(AttributeChannels::best(quadric.channels[0], p, false), mean, 1e-6 * (1 + std::fabs(mean)));
    EXPECT_NEAR(channels.gap(quadric, 0, p, mean + 0.25), off - least, 1e-6 * (1 + off));
  }
}

TEST(AttributeQuadrics, PassOverNumbersThatAreNotFiniteAndTrianglesWithoutArea) {
  const Attribute height{.name = "height", .type = ScalarType::float64};
  const std::array<const Attribute*, 1> attributes = {&height};
  const std::array<AttributeWeight, 1> weights = {{{"height", 1}}};
  const AttributeChannels channels(attributes, weights, 1);
  const std::array<Vec3, 3> places = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const AttributeQuadric made = channels.ofTriangle(
        places, 1, [&](std::size_t, std::size_t corner) { return corner == 1 ? bad : 2; });
    EXPECT_EQ(made.channels[0].weight, 0);
    EXPECT_EQ(made.squares.at({3, 4, 5}), 0);
  }
  const std::array<Vec3, 3> line = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}};
  EXPECT_EQ(channels.ofTriangle(line, 1, [](std::size_t, std::size_t) { return 1.0; }).channels[0].weight, 0);
}

TEST(AttributeQuadrics, CountColoursInTheRangeOfAChannelWhateverTheirType) {
  Attribute bytes{.name = "color", .meaning = AttributeMeaning::color, .type = ScalarType::uint8};
  bytes.isNormalized = true;
  Attribute floats = bytes;
  floats.type = ScalarType::float32;
  floats.isNormalized = false;
  const std::array<AttributeWeight, 1> weights = {{{"color", 1}}};
  const std::array<Vec3, 3> places = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  const auto costOf = [&](const Attribute& attribute, double whole) {
    const std::array<const Attribute*, 1> attributes = {&attribute};
    const AttributeChannels channels(attributes, weights, 1);
    const AttributeQuadric made = channels.ofTriangle(
        places, 1, [&](std::size_t, std::size_t corner) { return corner == 1 ? whole : 0.0; });
    return made.squares.at({1, 0, 0});
  };
  EXPECT_NEAR(costOf(bytes, 255), 1, 1e-12);
  EXPECT_NEAR(costOf(floats, 1), 1, 1e-12);
}

}  // namespace
}  // namespace arete
