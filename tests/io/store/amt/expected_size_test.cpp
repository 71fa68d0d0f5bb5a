// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is foretold of a file's size, held against files that are written.
#include "io/store/amt/expected_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <variant>

#include "datasets/families.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"
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

/// Holds what is foretold against files of a model of this field.
/// @param factor of the packed form, either way
void expectSizes(const RasterHeightfield& field, HoleShape shape, double factor, const std::string& name) {
  BuildOptions options;
  options.shape = shape;
  const auto model = build(field, options);
  ASSERT_TRUE(model) << name << ": " << model.error().describe();
  const ExpectedAmtSize expected = expectedAmtSize(field);
  const double plain = written(*model, false), packed = written(*model, true);
  EXPECT_NEAR(expected.plain / plain, 1, 0.1) << name << ": " << expected.plain << " of " << plain;
  EXPECT_LT(std::abs(std::log(expected.packed / packed)), std::log(factor))
      << name << ": " << expected.packed << " of " << packed;
}

TEST(ExpectedSize, IsThatOfTheFileOfEveryFamily) {
  std::size_t number = 0;
  for (const RasterFamily& family : rasterFamilies()) {
    constexpr std::uint32_t kSide = 110, kSeed = 3;
    const bool isWhole = number % 2 == 1, isDelaunay = number % 4 < 2;
    ++number;
    RasterHeightfield field = family.make(kSide, kSide, kSeed);
    if (isWhole)
      for (double& height : field.heights) height = std::round(height);
    // A surface whose rows repeat each other packs better than terrain does.
    expectSizes(field, isDelaunay ? HoleShape::delaunay : HoleShape::dataDependent, 2,
                std::string(family.name) + ", 110 x 110, seed 3, " + (isWhole ? "whole" : "real"));
  }
}

TEST(ExpectedSize, IsWithinAThirdOfTerrain) {
  for (const char* name : {"dem/dted0_n43.tif", "dem/usgsdem_mt_st_helens.dem"}) {
    const std::string file = test::realData(name);
    if (file.empty()) GTEST_SKIP() << name << " is not there";
    const auto dem = readDem(file);
    ASSERT_TRUE(dem) << dem.error().describe();
    expectSizes(std::get<RasterHeightfield>(dem->heightfield), HoleShape::delaunay, 4.0 / 3, name);
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
