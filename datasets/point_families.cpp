// SPDX-License-Identifier: GPL-3.0-or-later
// Point sets that stress a triangulation in one way each. Where a family is about exact coincidence
// (collinear, cocircular, duplicate), its coordinates are integers, so that it holds exactly.
#include <fmt/format.h>

#include <array>
#include <string>

#include "datasets/families.h"
#include "datasets/noise.h"
#include "datasets/random.h"

namespace arete {
namespace {

std::string sourceOf(std::string_view name) {
  return fmt::format("family:{}", name);
}

PointHeightfield blank(std::string_view name, std::uint32_t count) {
  PointHeightfield field;
  field.positions.reserve(count);
  field.heights.reserve(count);
  // The identity with the half pixel taken out: toSource(x, y) == (x, y).
  field.georeference.geoTransform = {-0.5, 1, 0, -0.5, 0, 1};
  field.source = sourceOf(name);
  return field;
}

void add(PointHeightfield& field, double x, double y, double z) {
  field.positions.push_back({x, y});
  field.heights.push_back(z);
}

double hills(std::uint64_t seed, double x, double y) {
  return 500 + 300 * fractalNoise(seed, x / 240, y / 240);
}

PointHeightfield makeRandom(std::uint32_t count, std::uint64_t seed) {
  PointHeightfield field = blank("random", count);
  Random random(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = random.between(0, 1000), y = random.between(0, 1000);
    add(field, x, y, hills(seed, x, y));
  }
  return field;
}

// Row by row on the smallest square lattice that holds them: four cocircular corners everywhere.
PointHeightfield makeGrid(std::uint32_t count, std::uint64_t seed) {
  PointHeightfield field = blank("grid", count);
  std::uint32_t side = 1;
  while (side * side < count) ++side;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = 10.0 * (i % side), y = 10.0 * (i / side);
    add(field, x, y, hills(seed, x, y));
  }
  return field;
}

// Lattice points of the circle of radius 32045 = 5 * 13 * 17 * 29 (324 of them, a common circle), the rest
// inside.
PointHeightfield makeCocircular(std::uint32_t count, std::uint64_t seed) {
  PointHeightfield field = blank("cocircular", count);
  constexpr std::int64_t kRadius = 32045;
  for (std::int64_t x = 0, y = kRadius; x <= kRadius && field.size() + 4 <= count; ++x) {
    while (y > 0 && x * x + y * y > kRadius * kRadius) --y;
    if (x * x + y * y != kRadius * kRadius || y == 0) continue;
    // A quarter of the circle, turned three times; y == 0 is the turn of x == 0.
    for (const auto& [a, b] :
         std::array<std::array<std::int64_t, 2>, 4>{{{x, y}, {-y, x}, {-x, -y}, {y, -x}}})
      add(field, static_cast<double>(a), static_cast<double>(b), hills(seed, double(a) / 50, double(b) / 50));
  }
  Random random(seed);
  while (field.size() < count) {
    const double x = double(random.below(40001)) - 20000, y = double(random.below(40001)) - 20000;
    add(field, x, y, hills(seed, x / 50, y / 50));
  }
  return field;
}

PointHeightfield makeClustered(std::uint32_t count, std::uint64_t seed) {
  PointHeightfield field = blank("clustered", count);
  Random random(seed);
  std::array<Vec3, 6> clusters;  // centre and width
  for (Vec3& c : clusters) c = {random.between(0, 1000), random.between(0, 1000), random.between(0.01, 40)};
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3& c = clusters[random.below(clusters.size())];
    // The mean of three uniforms: a bell without a logarithm.
    const double x = c.x + c.z * (random.unit() + random.unit() + random.unit() - 1.5);
    const double y = c.y + c.z * (random.unit() + random.unit() + random.unit() - 1.5);
    add(field, x, y, hills(seed, x, y));
  }
  return field;
}

PointHeightfield makeHugeOffset(std::uint32_t count, std::uint64_t seed) {
  PointHeightfield field = makeRandom(count, seed);
  field.source = sourceOf("huge offset");
  for (Vec2& p : field.positions) p = {p.x + 4e5, p.y + 9e6};
  for (double& z : field.heights) z += 1e7;
  return field;
}

// Every third point repeats an earlier one, height and all.
PointHeightfield makeDuplicates(std::uint32_t count, std::uint64_t seed) {
  PointHeightfield field = makeRandom(count, seed);
  field.source = sourceOf("duplicates");
  Random random(seed + 1);
  // The first points stay as they are, so that there is a triangle.
  for (std::uint32_t i = 4; i < count; i += 3) {
    const std::uint32_t earlier = random.below(i);
    field.positions[i] = field.positions[earlier];
    field.heights[i] = field.heights[earlier];
  }
  return field;
}

PointHeightfield makeCollinear(std::uint32_t count, std::uint64_t seed) {
  PointHeightfield field = blank("collinear", count);
  for (std::uint32_t i = 0; i < count; ++i) {
    // Whole numbers keep the points exactly on the line.
    const double x = 3.0 * i + 7, y = 5.0 * i - 2;
    add(field, x, y, hills(seed, x, y));
  }
  return field;
}

PointHeightfield makeOnePoint(std::uint32_t, std::uint64_t seed) {
  PointHeightfield field = makeRandom(1, seed);
  field.source = sourceOf("one point");
  return field;
}

PointHeightfield makeTwoPoints(std::uint32_t, std::uint64_t seed) {
  PointHeightfield field = makeRandom(2, seed);
  field.source = sourceOf("two points");
  return field;
}

PointHeightfield makeOnePlace(std::uint32_t count, std::uint64_t) {
  PointHeightfield field = blank("one place", count);
  for (std::uint32_t i = 0; i < count; ++i) add(field, 12, 34, 56);
  return field;
}

PointHeightfield makeContradiction(std::uint32_t count, std::uint64_t seed) {
  PointHeightfield field = makeRandom(count + 1, seed);
  field.source = sourceOf("two heights at one place");
  field.positions.back() = field.positions.front();
  field.heights.back() = field.heights.front() + 1;
  return field;
}

constexpr std::array kPointFamilies = {
    PointFamily{"random", makeRandom},          PointFamily{"grid", makeGrid},
    PointFamily{"cocircular", makeCocircular},  PointFamily{"clustered", makeClustered},
    PointFamily{"huge offset", makeHugeOffset}, PointFamily{"duplicates", makeDuplicates},
};

constexpr std::array kDegeneratePointFamilies = {
    PointFamily{"one point", makeOnePoint},
    PointFamily{"two points", makeTwoPoints},
    PointFamily{"collinear", makeCollinear},
    PointFamily{"one place", makeOnePlace},
    PointFamily{"two heights at one place", makeContradiction},
};

}  // namespace

std::span<const PointFamily> pointFamilies() {
  return kPointFamilies;
}
std::span<const PointFamily> degeneratePointFamilies() {
  return kDegeneratePointFamilies;
}

}  // namespace arete
