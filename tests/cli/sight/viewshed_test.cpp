// SPDX-License-Identifier: GPL-3.0-or-later
// arete viewshed over a plain with a wall.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cli/sight_fixture.h"
#include "io/geo/dem/raster_reader.h"
#include "io/geo/dem/raster_writer.h"

namespace arete::cli_test {
namespace {

using Viewsheds = SightCommands;

TEST_F(Viewsheds, HasTheAnswersOfLos) {
  makeModel();
  const Outcome outcome = run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--target-height", "2",
                               "-o", "seen.tif", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto seen = readRaster(path("seen.tif"));
  ASSERT_TRUE(seen);
  const RasterHeightfield& field = seen->heightfield;
  ASSERT_EQ(field.columns, 61u);
  std::string sites = "x,y,h\n";
  std::vector<double> expected;
  for (std::uint32_t row = 0; row < field.rows; row += 3)
    for (std::uint32_t column = 0; column < field.columns; column += 3) {
      const Vec2 xy = field.georeference.toSource(column, row);
      if (std::isnan(field.at(column, row))) continue;
      sites += fmt::format("{},{},2\n", xy.x, xy.y);
      expected.push_back(field.at(column, row));
    }
  write("sites.csv", sites);
  const Json los =
      run({"los", "dem.amt", "--from", "1105,1895,20", "--points", "sites.csv", "--json"}).json();
  ASSERT_EQ(los["answers"].size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::string verdict = los["answers"][i]["verdict"];
    EXPECT_EQ(expected[i], verdict == "visible" ? 255 : verdict == "blocked" ? 0 : 100) << los["answers"][i];
  }
}

TEST_F(Viewsheds, TakesTheGridOfAnotherRaster) {
  makeModel();
  ASSERT_EQ(run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "-o", "seen.tif", "-q"}).code, 0);
  ASSERT_EQ(
      run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--like", "seen.tif", "-o", "like.tif", "-q"})
          .code,
      0);
  const auto seen = readRaster(path("seen.tif")), like = readRaster(path("like.tif"));
  ASSERT_TRUE(seen && like);
  ASSERT_EQ(like->heightfield.size(), seen->heightfield.size());
  for (std::size_t i = 0; i < seen->heightfield.size(); ++i) {
    const double a = seen->heightfield.heights[i], b = like->heightfield.heights[i];
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << i;
  }
  // Twice as coarse: every other sample.
  RasterHeightfield half;
  half.georeference = seen->heightfield.georeference;
  half.columns = (seen->heightfield.columns + 1) / 2;
  half.rows = (seen->heightfield.rows + 1) / 2;
  half.heights.assign(std::size_t{half.columns} * half.rows, 1);
  auto& g = half.georeference.geoTransform;
  g = {g[0] - g[1] / 2, 2 * g[1], 0, g[3] - g[5] / 2, 0, 2 * g[5]};
  ASSERT_TRUE(writeGeoTiff(path("half.tif"), half.columns, half.rows, half.heights, half.georeference));
  ASSERT_EQ(
      run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--like", "half.tif", "-o", "half_seen.tif"})
          .code,
      0);
  const auto coarse = readRaster(path("half_seen.tif"));
  ASSERT_TRUE(coarse);
  ASSERT_EQ(coarse->heightfield.columns, half.columns);
  for (std::uint32_t row = 0; row < half.rows; ++row)
    for (std::uint32_t column = 0; column < half.columns; ++column) {
      const double a = seen->heightfield.at(2 * column, 2 * row), b = coarse->heightfield.at(column, row);
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << column << ", " << row;
    }
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--observer", "1205,1895,20", "--like",
           "half.tif", "-o", "v.tif"},
          2, "requires a single observer");
  // Somewhere else.
  g[0] += 5000;
  ASSERT_TRUE(writeGeoTiff(path("far.tif"), half.columns, half.rows, half.heights, half.georeference));
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--like", "far.tif", "-o", "v.tif"}, 2,
          "--like far.tif: has no sample within the DEM");
  EXPECT_FALSE(exists("v.tif"));
}

TEST_F(Viewsheds, TakesTheGridOfAPicture) {
  makeModel();
  write("photo.ppm", "P6\n3 2\n255\n" + std::string(18, 'x'));
  write("photo.wld", "200\n0\n0\n-50\n1105\n1895\n");
  const Outcome made = run(
      {"viewshed", "dem.amt", "--observer", "1105,1895,20", "--like", "photo.ppm", "-o", "seen.tif", "-q"});
  ASSERT_EQ(made.code, 0) << made.err;
  const auto seen = readRaster(path("seen.tif"));
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->heightfield.heights, (std::vector<double>{255, 255, 0, 255, 255, 0}));  // behind the wall
}

TEST_F(Viewsheds, NamesTheColumnsThatItDoesNotUse) {
  makeModel();
  const auto errorsOf = [&](const std::string& table) {
    write("masts.csv", table);
    return run({"viewshed", "dem.amt", "--observers", "masts.csv", "--observer-height", "20", "-o", "v.tif"})
        .err;
  };
  const auto expect = [&](const std::string& table, const std::string& sentence) {
    const std::string errors = errorsOf(table);
    EXPECT_NE(errors.find(sentence), std::string::npos) << errors;
  };
  expect("x,y,radius\n1105,1895,50\n", "masts.csv: the column radius is not used");
  expect("x,y,azimuth\n1105,1895,50\n", "masts.csv: azimuth is not used in 1 row without a beamwidth");
  expect("x,y,beamwidth\n1105,1895,50\n1105,1895,60\n",
         "masts.csv: beamwidth is not used in 2 rows without an azimuth");
  expect("x,y,azimuth,beamwidth\n1105,1895,50,400\n", "masts.csv, row 1: has a beamwidth of 400, above 360");
  expect("x,y,beamwidth\n1105,1895,-3\n", "masts.csv, row 1: has a beamwidth that is not above 0");
  EXPECT_EQ(
      errorsOf("x,y,azimuth,beamwidth,range\n1105,1895,50,360,90\n1105,1895,,360,\n").find("is not used"),
      std::string::npos);
}

TEST_F(Viewsheds, OfManyCountsAndNamesTheNearest) {
  makeModel();
  write("masts.csv", "x,y\n1105,1895\n1505,1895\n1515,1895\n");
  const auto valueAt = [&](const std::string& file, double x, double y) {
    const auto read = readRaster(path(file));
    EXPECT_TRUE(read);
    const Vec2 at = read->heightfield.georeference.toGrid(x, y);
    return read->heightfield.at(std::uint32_t(std::lround(at.x)), std::uint32_t(std::lround(at.y)));
  };
  const auto make = [&](const char* mode) {
    const Outcome outcome = run({"viewshed", "dem.amt", "--observers", "masts.csv", "--observer-height", "20",
                                 "--mode", mode, "-o", "v.tif", "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  make("count");
  EXPECT_EQ(valueAt("v.tif", 1205, 1895), 1);
  EXPECT_EQ(valueAt("v.tif", 1405, 1895), 2);
  EXPECT_EQ(valueAt("v.tif", 1305, 1895), 3);
  make("server");
  EXPECT_EQ(valueAt("v.tif", 1205, 1895), 1);
  EXPECT_EQ(valueAt("v.tif", 1405, 1895), 2);
  EXPECT_EQ(valueAt("v.tif", 1575, 1895), 3);
  make("seen");
  EXPECT_EQ(valueAt("v.tif", 1205, 1895), 255);
  ASSERT_EQ(
      run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--mode", "height", "-o", "v.tif", "-q"})
          .code,
      0);
  // Over the wall at 200 m, 10 above the observer, the line has risen by 20 at 400 m: 140 over a plain of
  // 100.
  EXPECT_NEAR(valueAt("v.tif", 1505, 1895), 40, 1e-4);
  ASSERT_EQ(
      run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--mode", "horizon", "-o", "v.tif", "-q"})
          .code,
      0);
  EXPECT_NEAR(valueAt("v.tif", 1505, 1895), std::atan(10.0 / 200) * 180 / 3.14159265358979, 1e-4);
}

TEST_F(Viewsheds, OfManyTakesNobodyForBlindWhoMaySee) {
  makeModel();
  const auto valuesOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"viewshed", "dem.amt", "--observer", "1205,1615,20",
                                          "-o",       "v.tif",   "--observer", "1105,1615,20",
                                          "-q",       "--nodata"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    auto read = readRaster(path("v.tif"));
    EXPECT_TRUE(read);
    return read ? std::move(read->heightfield.heights) : std::vector<double>();
  };
  // Behind the hole neither is known to see anything, before it both do.
  const std::size_t behind = 38 * 61 + 40, before = 38 * 61 + 22;
  for (const char* mode : {"count", "server"}) {
    const auto unknown = valuesOf({"unknown", "--mode", mode});
    EXPECT_EQ(unknown[behind], 65533) << mode;
    EXPECT_EQ(unknown[before], mode == std::string("count") ? 2 : 1);
    EXPECT_LT(valuesOf({"clear", "--mode", mode})[behind], 3) << mode;
    const auto exact = valuesOf({"clear", "--mode", mode}),
               within = valuesOf({"clear", "--mode", mode, "--max-error", "40"});
    std::size_t undecided = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      if (within[i] == 65534) {
        ++undecided;
      } else {
        EXPECT_TRUE(within[i] == exact[i] || std::isnan(exact[i])) << mode << " " << i;
      }
    }
    EXPECT_GT(undecided, 0u) << mode;
  }
}

TEST_F(Viewsheds, TellsNoHeightBehindNodata) {
  makeModel();
  const auto valuesOf = [&](const char* mode, const char* nodata) {
    const Outcome outcome = run({"viewshed", "dem.amt", "--observer", "1205,1615,20", "--mode", mode,
                                 "--nodata", nodata, "-o", "v.tif", "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    auto read = readRaster(path("v.tif"));
    EXPECT_TRUE(read);
    return read ? std::move(read->heightfield.heights) : std::vector<double>();
  };
  const std::size_t behind = 38 * 61 + 40, before = 38 * 61 + 22;
  for (const char* nodata : {"unknown", "clear", "blocked"})
    EXPECT_EQ(valuesOf("height", nodata)[before], 0) << nodata;
  EXPECT_TRUE(std::isnan(valuesOf("height", "unknown")[behind]));
  EXPECT_EQ(valuesOf("height", "clear")[behind], 0);
  // Infinite, which a reader of heights takes for NODATA.
  EXPECT_FALSE(std::isfinite(valuesOf("height", "blocked")[behind]));
  EXPECT_EQ(valuesOf("horizon", "blocked")[behind], 90);
  // Beside the hole and behind the wall a height is known.
  EXPECT_GT(valuesOf("height", "unknown")[2 * 61 + 40], 0);
}

TEST_F(Viewsheds, RefusesWhatMakesNoSense) {
  makeModel();
  write("masts.csv", "x,y\n1105,1895\n");
  refused({"viewshed", "dem.amt", "-o", "v.tif"}, 2, "--observer or --observers is required");
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--observer-height", "5", "-o", "v.tif"}, 2,
          "--observer-height requires --observers");
  refused({"viewshed", "dem.amt", "--observer", "1,1,2", "-o", "v.tif"}, 4, "has no terrain below it");
  refused({"viewshed", "dem.amt", "--observers", "masts.csv", "-o", "v.tif"}, 2, "has no height");
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--observer", "1205,1895,2", "--mode",
           "height", "-o", "v.tif"},
          2, "requires one observer");
  for (const char* output : {"v.png", "v.csv", "v", "v.tif.gz"}) {
    refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "-o", output}, 2,
            std::string("--output ") + output +
                ": a viewshed is a GeoTIFF and ends in .tif or .tiff; --polygons writes a GeoPackage");
    EXPECT_FALSE(exists(output));
  }
  EXPECT_EQ(run({"viewshed", "dem.amt", "--observer", "1105,1895,2", "-o", "V.TIFF", "-q"}).code, 0);
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--azimuth", "3", "-o", "v.tif"}, 2,
          "must be two numbers");
  for (const char* nothing : {"10,10", "370,-350"})
    refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--azimuth", nothing, "-o", "v.tif"}, 2,
            std::string("--azimuth ") + nothing + ": is an empty field of view");
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--radius", "100", "--min-distance", "200",
           "-o", "v.tif"},
          2, "--min-distance 200: is beyond --radius 100");
  write("sectors.csv", "x,y,h,range\n1105,1895,2,300\n1105,1895,2,150\n");
  refused({"viewshed", "dem.amt", "--observers", "sectors.csv", "--min-distance", "200", "-o", "v.tif"}, 4,
          "sectors.csv, row 2: has a range below --min-distance 200");
  EXPECT_FALSE(exists("v.tif"));
}

TEST_F(Viewsheds, WarnsOfAFieldOfViewWithoutASample) {
  makeModel();
  const auto warned = [&](const std::vector<std::string>& more, const std::string& sentence) {
    std::vector<std::string> words = {"viewshed", "dem.amt", "--observer", "1108,1898,20", "-o", "v.tif"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << sentence << "\n" << outcome.err;
  };
  // The nearest sample is 4.2 away.
  warned({"--radius", "2"},
         "v.tif: no sample is within the radius of 2: it is in metres, and the samples are "
         "10 x 10 apart");
  warned({"--min-distance", "5000"}, "no sample is within the field of view: --min-distance");
  warned({"--elevation", "80,90"}, "no sample is within the field of view: --elevation");
  const Outcome seen =
      run({"viewshed", "dem.amt", "--observer", "1108,1898,20", "--radius", "5", "-o", "w.tif"});
  EXPECT_EQ(seen.err, "");
  EXPECT_NE(seen.out.find("w.tif: 1 sample seen"), std::string::npos) << seen.out;
}

}  // namespace
}  // namespace arete::cli_test
