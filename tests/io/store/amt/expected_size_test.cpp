// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is foretold of a file's size, held against files that are written.
#include "io/store/amt/expected_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "datasets/families.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

double written(const TerrainModel& model, bool isPacked) {
  std::string pattern = (fs::temp_directory_path() / "arete-size-XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data()), file = folder / "x.amt";
  const Status status = writeAmt(file.string(), model, {}, {.isPacked = isPacked});
  EXPECT_TRUE(status) << status.error().describe();
  const double bytes = status ? double(fs::file_size(file)) : 0;
  fs::remove_all(folder);
  return bytes;
}

TEST(ExpectedSize, IsThatOfTheFileOfEveryFamily) {
  for (const RasterFamily& family : rasterFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
      for (const bool isWhole : {false, true}) {
        constexpr std::uint32_t kSide = 110, kSeed = 3;
        RasterHeightfield field = family.make(kSide, kSide, kSeed);
        if (isWhole)
          for (double& height : field.heights) height = std::round(height);
        BuildOptions options;
        options.shape = shape;
        const auto model = build(field, options);
        ASSERT_TRUE(model) << model.error().describe();
        const ExpectedAmtSize expected = expectedAmtSize(field);
        const double plain = written(*model, false), packed = written(*model, true);
        const auto name = [&] {
          return std::string(family.name) + ", 110 x 110, seed 3, " + (isWhole ? "whole" : "real") + ", " +
                 std::string(toString(shape));
        };
        EXPECT_NEAR(expected.plain / plain, 1, 0.1) << name() << ": " << expected.plain << " of " << plain;
        EXPECT_LT(std::abs(std::log(expected.packed / packed)), std::log(4.0 / 3))
            << name() << ": " << expected.packed << " of " << packed;
      }
}

TEST(ExpectedSize, OfPointsIsWithinAFactorOfTwo) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(3000, 5);
    const auto model = build(field);
    if (!model) continue;  // families of what cannot be built
    const ExpectedAmtSize expected = expectedAmtSize(field);
    for (const bool isPacked : {false, true}) {
      const double bytes = written(*model, isPacked), guess = isPacked ? expected.packed : expected.plain;
      EXPECT_LT(std::abs(std::log(guess / bytes)), std::log(2.0))
          << family.name << ", 3000 points, seed 5, " << (isPacked ? "packed: " : "plain: ") << guess
          << " of " << bytes;
    }
  }
}

TEST(ExpectedSize, OfNothingIsAHeader) {
  RasterHeightfield field;
  field.columns = field.rows = 4;
  field.heights.assign(16, std::nan(""));
  EXPECT_LT(expectedAmtSize(field).plain, 10'000);
  EXPECT_LT(expectedAmtSize(field).packed, 10'000);
}

}  // namespace
}  // namespace arete
