// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples drawn over a plane against the definition u = y / x, v = h / x; steepness against a search of the
// cells.
#include "terrain/viewshed/image_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/random.h"

namespace arete::test {
namespace {

std::vector<double> roughHeights(Random& random, std::uint32_t count, double voids) {
  std::vector<double> heights;
  for (std::uint32_t i = 0; i < count; ++i)
    heights.push_back(random.unit() < voids ? std::nan("") : random.between(-40, 900));
  return heights;
}

TEST(ImagePlane, DrawsSamplesAtTheirDirectionAndNotTooLow) {
  constexpr std::uint64_t kSeed = 151;
  Random random(kSeed);
  TerrainModel model;
  model.columns = 30;
  model.rows = 24;
  const SightGrid grid(30, 24, roughHeights(random, 720, 0.05));
  const auto earth = makePlaneEarth(model);
  const auto scan = makeSightScan(std::make_shared<SightGrid>(grid));
  const ViewshedOptions options;
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", round " << round);
    const ViewshedObserver observer{{random.between(0, 29), random.between(0, 23)}, random.between(0, 1000)};
    const ViewshedExact exact(*scan, *earth, 1, observer, options);
    const std::vector<float> none;
    const ViewshedTask task{model, grid, *earth, observer, options, exact, none};
    const ImagePlane image(task, nullptr, nullptr);
    EXPECT_FALSE(image.isMapped());
    EXPECT_EQ(image.turn(), 0);
    EXPECT_EQ(image.planError(10), 0);
    for (const bool isAlongRows : {true, false})
      for (const int sign : {1, -1}) {
        const ViewshedSector sector{isAlongRows, sign};
        const Vec2 o = image.observer(sector);
        const int xCount = isAlongRows ? 30 : 24, yCount = isAlongRows ? 24 : 30;
        const int xLast = sign > 0 ? xCount - 1 : 0, yLow = sign > 0 ? 0 : 1 - yCount,
                  yHigh = yLow + yCount - 1;
        for (int x = int(std::floor(o.x)) + 1; x <= xLast; x += 3)
          for (const int shear : {0, 1}) {
            ImageLine line;
            image.draw(sector, x, yLow, yHigh, shear, line);
            ASSERT_EQ(line.count, yCount);
            bool hasGaps = false;
            for (int y = yLow; y <= yHigh; ++y) {
              const std::size_t i = line.at(y);
              const Vec2 plan = sector.turned({double(x), double(y)});
              const double z = grid.height(std::uint32_t(plan.x), std::uint32_t(plan.y));
              hasGaps |= std::isnan(z);
              EXPECT_NEAR(line.u[i], (y - o.y) / (x - o.x) - shear, 1e-9 * (1 + std::fabs(line.u[i])));
              EXPECT_NEAR(image.direction(sector, x, y, shear), line.u[i], 1e-9 * (1 + std::fabs(line.u[i])));
              if (std::isnan(z)) continue;
              const double v = (z - observer.height) / (x - o.x);
              EXPECT_GE(line.v[i], v - 1e-15 * std::fabs(v));
              EXPECT_LE(line.v[i], v + image.slack(x - o.x, 0));
              EXPECT_NEAR(image.target(line, i, 7), (z + 7 - observer.height) / (x - o.x),
                          1e-9 * (1 + std::fabs(v)));
              const ImagePlane::Sample sample = image.sample(sector, x, y);
              EXPECT_NEAR(sample.place.x, x - o.x, 1e-12);
              EXPECT_NEAR(sample.height, z - observer.height, 1e-6);
            }
            EXPECT_EQ(line.hasGaps, hasGaps);
          }
      }
  }
}

TEST(ImagePlane, TurnsAPlanVectorIntoASectorAndBack) {
  for (const bool isAlongRows : {true, false})
    for (const int sign : {1, -1}) {
      const ViewshedSector sector{isAlongRows, sign};
      const Vec2 p = sector.turned(sector.turned({3, -5}));
      EXPECT_EQ(p.x, 3);
      EXPECT_EQ(p.y, -5);
    }
}

TEST(ViewshedSteepness, IsTheSteepestOfTheCellsAround) {
  constexpr std::uint64_t kSeed = 152;
  Random random(kSeed);
  for (const double voids : {0.0, 0.1}) {
    const SightGrid grid(21, 17, roughHeights(random, 21 * 17, voids));
    const std::vector<float> steep = viewshedSteepness(grid, {});
    for (int row = 0; row < 17; ++row)
      for (int column = 0; column < 21; ++column) {
        SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", sample " << column << ", " << row);
        double most = 0;
        for (int r = std::max(0, row - 2); r <= std::min(15, row + 1); ++r)
          for (int c = std::max(0, column - 2); c <= std::min(19, column + 1); ++c) {
            const auto z = [&](int x, int y) {
              return grid.height(std::uint32_t(c + x), std::uint32_t(r + y));
            };
            // Both triangles of the cell.
            for (const auto& [a, b] :
                 {std::pair{z(1, 0) - z(0, 0), z(1, 1) - z(1, 0)}, {z(1, 1) - z(0, 1), z(0, 1) - z(0, 0)}})
              if (!std::isnan(a + b)) most = std::max(most, std::hypot(a, b));
          }
        EXPECT_GE(std::fabs(steep[std::size_t(row) * 21 + std::size_t(column)]), most);
        bool isMissing = row == 0 || column == 0 || row == 16 || column == 20;
        for (int r = std::max(0, row - 1); r <= std::min(16, row + 1); ++r)
          for (int c = std::max(0, column - 1); c <= std::min(20, column + 1); ++c)
            isMissing |= std::isnan(grid.height(std::uint32_t(c), std::uint32_t(r)));
        EXPECT_EQ(std::signbit(steep[std::size_t(row) * 21 + std::size_t(column)]), isMissing);
      }
  }
}

}  // namespace
}  // namespace arete::test
