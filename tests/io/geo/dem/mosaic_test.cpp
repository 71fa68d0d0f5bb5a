// SPDX-License-Identifier: GPL-3.0-or-later
//
// One raster is cut into tiles at random, with overlaps and gaps, and read back in any order. The oracle is
// the array that the tiles were cut from.
#include "io/geo/dem/mosaic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <random>

#include "io/geo/dem/dem_files.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::RasterSpec;
using test::TemporaryFolder;

constexpr double kNoSample = std::numeric_limits<double>::quiet_NaN();
constexpr double kNodata = -9999;

struct Box {
  int column = 0, row = 0, columns = 0, rows = 0;
};

/// A raster that is cut into tiles.
struct Whole {
  int columns = 0, rows = 0;
  std::array<double, 6> transform{};
  std::string crs = "EPSG:32611";
  std::vector<double> heights;

  double at(int column, int row) const { return heights[std::size_t(row * columns + column)]; }
  RasterSpec cut(const Box& box) const {
    RasterSpec spec;
    spec.columns = box.columns;
    spec.rows = box.rows;
    spec.type = GDT_Float64;
    spec.crs = crs;
    spec.values.clear();
    for (int r = box.row; r < box.row + box.rows; ++r)
      for (int c = box.column; c < box.column + box.columns; ++c)
        spec.values.push_back(std::isnan(at(c, r)) ? kNodata : at(c, r));
    const auto& g = transform;
    spec.geoTransform = {g[0] + box.column * g[1] + box.row * g[2], g[1], g[2],
                         g[3] + box.column * g[4] + box.row * g[5], g[4], g[5]};
    spec.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(kNodata); };
    return spec;
  }
};

Whole randomWhole(std::mt19937& random, int columns, int rows) {
  Whole whole;
  whole.columns = columns;
  whole.rows = rows;
  for (int i = 0; i < columns * rows; ++i)
    whole.heights.push_back(random() % 11 == 0 ? kNoSample : double(random() % 1000) / 8);
  return whole;
}

Result<RasterRead> readAll(const std::vector<std::string>& paths, const RasterReadOptions& options = {}) {
  return readRasters(paths, options);
}

void expectSame(const RasterHeightfield& read, const Whole& whole, const std::vector<Box>& boxes) {
  ASSERT_EQ(read.columns, unsigned(whole.columns));
  ASSERT_EQ(read.rows, unsigned(whole.rows));
  for (int row = 0; row < whole.rows; ++row)
    for (int column = 0; column < whole.columns; ++column) {
      const bool isCovered = std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) {
        return column >= b.column && column < b.column + b.columns && row >= b.row && row < b.row + b.rows;
      });
      const double wanted = isCovered ? whole.at(column, row) : kNoSample,
                   got = read.at(unsigned(column), unsigned(row));
      ASSERT_TRUE(got == wanted || (std::isnan(got) && std::isnan(wanted)))
          << column << ", " << row << ": " << got << " is not " << wanted;
    }
}

TEST(Mosaic, GivesTheSameResultHoweverARasterIsCut) {
  TemporaryFolder folder;
  std::mt19937 random(41);
  for (int round = 0; round < 30; ++round) {
    SCOPED_TRACE("seed 41, round " + std::to_string(round));
    Whole whole = randomWhole(random, 20 + int(random() % 40), 20 + int(random() % 40));
    const std::array<std::array<double, 6>, 4> transforms = {
        {{500000.125, 30, 0, 4000000.5, 0, -30},
         {500000, 30, 5, 4000000, 7, -30},
         {7.0 - 1 / 2400.0, 1 / 1200.0, 0, 47 + 1 / 2400.0, 0, -1 / 1200.0},
         {500000, 10, 0, 4000000, 0, 20}}};
    whole.transform = transforms[std::size_t(round) % 4];
    whole.crs = round % 4 == 2 ? "EPSG:4326" : "EPSG:32611";
    // The corners are always there, so that the whole extent is.
    const int w = whole.columns, h = whole.rows;
    std::vector<Box> boxes = {{0, 0, w / 2 + 1, h / 2},
                              {w / 3, h / 2 - 1, w - w / 3, h - h / 2 + 1},
                              {w - 3, 0, 3, 3},
                              {0, h - 2, 2, 2}};
    for (int i = int(random() % 4); i > 0; --i) {
      const int c = int(random() % unsigned(w - 2)), r = int(random() % unsigned(h - 2));
      boxes.push_back({c, r, 1 + int(random() % unsigned(w - c)), 1 + int(random() % unsigned(h - r))});
    }
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      paths.push_back(writeRaster(folder.file(std::to_string(round) + "-" + std::to_string(i) + ".tif"),
                                  whole.cut(boxes[i])));
    std::shuffle(paths.begin(), paths.end(), random);
    const auto read = readAll(paths);
    ASSERT_TRUE(read) << read.error().describe();
    EXPECT_TRUE(read->warnings.empty()) << joined(read->warnings);
    expectSame(read->heightfield, whole, boxes);
    if (round % 4 != 1) {
      EXPECT_EQ(read->heightfield.georeference.geoTransform, whole.transform);
    }
    const auto single = readRaster(writeRaster(folder.file("whole.tif"), whole.cut({0, 0, w, h})));
    ASSERT_TRUE(single);
    EXPECT_EQ(read->heightfield.georeference.crsWkt, single->heightfield.georeference.crsWkt);
  }
}

TEST(Mosaic, CanBeReadRowByRowInAnyOrder) {
  TemporaryFolder folder;
  std::mt19937 random(7);
  Whole whole = randomWhole(random, 33, 21);
  whole.transform = {0, 1, 0, 21, 0, -1};
  const std::vector<std::string> paths = {writeRaster(folder.file("a.tif"), whole.cut({0, 0, 20, 21})),
                                          writeRaster(folder.file("b.tif"), whole.cut({15, 0, 18, 12})),
                                          writeRaster(folder.file("c.tif"), whole.cut({20, 12, 13, 9}))};
  auto mosaic = DemMosaic::open(paths, {}, {});
  ASSERT_TRUE(mosaic) << mosaic.error().describe();
  for (int i = 0; i < 100; ++i) {
    const unsigned row = random() % 21, count = 1 + random() % (21 - row);
    std::vector<double> rows(std::size_t(33) * count);
    ASSERT_TRUE(mosaic->read(row, count, rows, {}));
    for (unsigned r = 0; r < count; ++r)
      for (int c = 0; c < 33; ++c) {
        const double wanted = whole.at(c, int(row + r)), got = rows[std::size_t(r) * 33 + std::size_t(c)];
        ASSERT_TRUE(got == wanted || (std::isnan(got) && std::isnan(wanted)));
      }
  }
}

TEST(Mosaic, TakesTheLaterFileWhereTwoDifferAndWarns) {
  TemporaryFolder folder;
  RasterSpec a, b;
  a.values = {1, 2, 3, 4, 5, 6};
  b.values = {30, -1, 10, 6, 20, 40};
  b.geoTransform = {500060, 30, 0, 4000000, 0, -30};
  b.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(-1); };
  const std::vector<std::string> paths = {writeRaster(folder.file("a.tif"), a),
                                          writeRaster(folder.file("b.tif"), b)};
  auto read = readAll(paths);
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(read->heightfield.at(2, 0), 30);
  EXPECT_EQ(read->heightfield.at(2, 1), 6);
  EXPECT_TRUE(
      contains(joined(read->warnings), "1 sample has different heights in several files, by up to 27"))
      << joined(read->warnings);
  read = readAll({paths[1], paths[0]});
  ASSERT_TRUE(read);
  EXPECT_EQ(read->heightfield.at(2, 0), 3);
  EXPECT_EQ(read->heightfield.at(4, 0), 10);
}

TEST(Mosaic, RefusesByNameWhatDoesNotFit) {
  TemporaryFolder folder;
  const RasterSpec plain;
  const std::string first = writeRaster(folder.file("first.tif"), plain);
  const auto altered = [&](const auto& alter) {
    RasterSpec spec;
    spec.geoTransform = {500090, 30, 0, 4000000, 0, -30};
    alter(spec);
    return writeRaster(folder.file("other.tif"), spec);
  };
  const std::vector<std::pair<std::string, std::function<void(RasterSpec&)>>> cases = {
      {"pixels of 29 by 30", [](RasterSpec& s) { s.geoTransform = {500090, 29, 0, 4000000, 0, -30}; }},
      {"in other directions", [](RasterSpec& s) { s.geoTransform = {500090, 30, 0, 4000000, 0, 30}; }},
      {"0.5 and 0 pixel", [](RasterSpec& s) { s.geoTransform = {500105, 30, 0, 4000000, 0, -30}; }},
      {"shifted by 0 and -0.02 pixel",
       [](RasterSpec& s) { s.geoTransform = {500090, 30, 0, 4000000.6, 0, -30}; }},
      {"gdalwarp -t_srs", [](RasterSpec& s) { s.crs = "EPSG:32612"; }},
      {"no CRS", [](RasterSpec& s) { s.crs.clear(); }},
      {"has heights in 'ft'",
       [](RasterSpec& s) { s.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetUnitType("ft"); }; }},
      {"has heights in 'metre'", [](RasterSpec& s) { s.crs = "EPSG:32611+3855"; }},
      {"has no CRS", [](RasterSpec& s) { s.crs.clear(), s.geoTransform.reset(); }},
      {"too far", [](RasterSpec& s) { s.geoTransform = {5e15, 30, 0, 4000000, 0, -30}; }},
  };
  for (const auto& [sentence, alter] : cases) {
    const auto read = readAll({first, altered(alter)});
    ASSERT_FALSE(read) << sentence;
    EXPECT_TRUE(contains(read.error().describe(), "other.tif") && contains(read.error().message, sentence))
        << read.error().describe() << " has no '" << sentence << "'";
  }
  // Far apart on one lattice: more than can be numbered, and no hang.
  EXPECT_FALSE(readAll({first, altered([](RasterSpec& s) {
                          s.geoTransform = {500000 + 3e8, 30, 0, 4000000 - 3e7, 0, -30};
                        })}));
}

TEST(Mosaic, JoinsTilesOnBothSidesOfTheDateLine) {
  TemporaryFolder folder;
  std::mt19937 random(3);
  Whole whole = randomWhole(random, 40, 10);
  whole.crs = "EPSG:4326";
  for (const double west : {178.0, 358.0, -2.0, 539.0, 90.0}) {
    whole.transform = {west, 0.1, 0, 10, 0, -0.1};
    const auto tile = [&](const char* name, const Box& box, double turns) {
      RasterSpec spec = whole.cut(box);
      (*spec.geoTransform)[0] += 360 * turns;
      return writeRaster(folder.file(name), spec);
    };
    const std::vector<Box> boxes = {{0, 0, 20, 10}, {20, 0, 20, 10}};
    for (const int turns : {0, -1, 1, 2}) {
      const auto read = readAll({tile("a.tif", boxes[0], 0), tile("b.tif", boxes[1], turns)});
      ASSERT_TRUE(read) << read.error().describe();
      expectSame(read->heightfield, whole, boxes);
      EXPECT_NEAR(read->heightfield.georeference.geoTransform[0], west, 1e-9);
    }
  }
}

TEST(Mosaic, IsWhatAFolderAPatternOrSeveralNamesStandFor) {
  TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("tiles"));
  std::mt19937 random(5);
  Whole whole = randomWhole(random, 30, 20);
  whole.transform = {500000, 30, 0, 4000000, 0, -30};
  const std::vector<Box> boxes = {{0, 0, 15, 20}, {14, 0, 16, 20}};
  const std::string a = writeRaster(folder.file("tiles/a.tif"), whole.cut(boxes[0]));
  RasterSpec pair = whole.cut(boxes[1]);
  pair.driver = "ENVI";
  const std::string b = writeRaster(folder.file("tiles/b.img"), pair);
  folder.write("tiles/README.txt", "About the tiles: 1 2 3");
  folder.write("tiles/list.csv", "1,2,3\n4,5,6\n");
  {
    GDALDataset* dataset = GDALDataset::Open(a.c_str(), GDAL_OF_RASTER);
    const int level = 2;
    ASSERT_EQ(dataset->BuildOverviews("NEAREST", 1, const_cast<int*>(&level), 0, nullptr, nullptr, nullptr),
              CE_None);
    GDALClose(GDALDataset::ToHandle(dataset));
    ASSERT_TRUE(std::filesystem::exists(a + ".ovr"));
  }
  SourceReading reading;
  reading.otherFiles = {b};
  SourceReading twice;
  twice.otherFiles = {folder.file("tiles/*.img"), a, folder.file("tiles")};
  for (const auto& [path, how] : {std::pair{a, reading},
                                  {folder.file("tiles"), SourceReading{}},
                                  {folder.file("tiles/[ab].*[fg]"), SourceReading{}},
                                  {a, twice}}) {
    const auto read = readDem(path, how);
    ASSERT_TRUE(read) << path << read.error().describe();
    const auto& field = std::get<RasterHeightfield>(read->heightfield);
    expectSame(field, whole, boxes);
    EXPECT_EQ(field.source, path);
  }
  EXPECT_EQ(readDem(folder.file("tiles/*.dem")).error().code, ErrorCode::notFound);
  std::filesystem::create_directory(folder.file("empty"));
  EXPECT_TRUE(contains(readDem(folder.file("empty")).error().message, "without a raster"));
  reading.otherFiles = {folder.file("tiles/list.csv")};
  EXPECT_TRUE(contains(readDem(a, reading).error().message, "holds points"));
  reading.otherFiles = {folder.file("tiles/none.tif")};
  EXPECT_EQ(readDem(a, reading).error().code, ErrorCode::notFound);
  reading.otherFiles = {folder.file("tiles/README.txt")};
  EXPECT_FALSE(readDem(a, reading));
}

/// Tiles of one raster, of which some are empty and fit none.
TEST(Mosaic, LeavesEmptyTilesOutThatDoNotFit) {
  const TemporaryFolder folder;
  std::mt19937 random(8);
  Whole whole = randomWhole(random, 24, 12);
  whole.transform = {500000, 30, 0, 4000000, 0, -30};
  struct Oddity {
    const char* what;
    std::function<void(RasterSpec&)> make;
  };
  const std::vector<Oddity> oddities = {
      {"no CRS", [](RasterSpec& s) { s.crs = ""; }},
      {"another CRS", [](RasterSpec& s) { s.crs = "EPSG:4326"; }},
      {"another step", [](RasterSpec& s) { (*s.geoTransform)[1] *= 2; }},
      {"a shift", [](RasterSpec& s) { (*s.geoTransform)[0] += (*s.geoTransform)[1] / 3; }},
      {"no position", [](RasterSpec& s) { s.geoTransform.reset(); }},
      {"far away", [](RasterSpec& s) { (*s.geoTransform)[0] += 1e13 * (*s.geoTransform)[1]; }},
      {"feet",
       [](RasterSpec& s) {
         const auto before = s.adjust;
         s.adjust = [before](GDALDataset& d) {
           before(d);
           d.GetRasterBand(1)->SetUnitType("ft");
         };
       }},
  };
  const auto tile = [&](const std::string& name, const Box& box, bool isEmpty, const Oddity* oddity) {
    RasterSpec spec = whole.cut(box);
    if (isEmpty) spec.values.assign(spec.values.size(), kNodata);
    if (oddity) oddity->make(spec);
    return writeRaster(folder.file(name), spec);
  };
  const std::string a = tile("a.tif", {0, 0, 12, 12}, false, nullptr),
                    b = tile("b.tif", {12, 0, 12, 12}, false, nullptr);
  const auto expected = readRasters({a, b});
  ASSERT_TRUE(expected) << expected.error().describe();
  for (const Oddity& oddity : oddities) {
    const std::string empty = tile("empty.tif", {24, 0, 5, 4}, true, &oddity),
                      full = tile("full.tif", {0, 0, 5, 4}, false, &oddity);
    for (const std::vector<std::string>& files :
         {std::vector{a, b, empty}, {empty, a, b}, {a, empty, b}, {empty, empty, a, empty, b}}) {
      const auto read = readRasters(files);
      ASSERT_TRUE(read) << oddity.what << ": " << read.error().describe();
      EXPECT_EQ(read->heightfield.sourceChecksum, expected->heightfield.sourceChecksum) << oddity.what;
      EXPECT_EQ(read->heightfield.georeference.geoTransform, expected->heightfield.georeference.geoTransform);
      EXPECT_TRUE(contains(joined(read->warnings), "empty.tif: has no valid sample"))
          << joined(read->warnings);
    }
    const auto one = readRasters({empty, a}), alone = readRaster(a);
    ASSERT_TRUE(one && alone) << oddity.what;
    EXPECT_EQ(one->heightfield.sourceChecksum, alone->heightfield.sourceChecksum) << oddity.what;
    for (const std::vector<std::string>& files : {std::vector{a, full}, {full, a}, {empty, full, a}})
      EXPECT_FALSE(readRasters(files)) << oddity.what;
  }
}

TEST(Mosaic, SaysHowATileGetsACrs) {
  const TemporaryFolder folder;
  std::mt19937 random(9);
  Whole whole = randomWhole(random, 24, 12);
  whole.transform = {500000, 30, 0, 4000000, 0, -30};
  const std::string with = writeRaster(folder.file("with.tif"), whole.cut({0, 0, 12, 12}));
  RasterSpec spec = whole.cut({12, 0, 12, 12});
  spec.crs = "";
  const std::string without = writeRaster(folder.file("without.tif"), spec);
  for (const std::vector<std::string>& files : {std::vector{with, without}, {without, with}}) {
    const auto read = readRasters(files);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().culprit, without);
    EXPECT_TRUE(contains(read.error().message, "gdal_edit.py -a_srs")) << read.error().message;
    EXPECT_FALSE(contains(read.error().message, "gdalwarp")) << "there is nothing to transform from";
    RasterReadOptions options;
    options.crs = "EPSG:32611";
    EXPECT_TRUE(readRasters(files, options));
  }
}

}  // namespace
}  // namespace arete
