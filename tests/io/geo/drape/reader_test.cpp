// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures brought onto a terrain, against a look-up of each pixel's place on the map.
#include "io/geo/drape/reader.h"

#include <gdal_rat.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

#include "datasets/random.h"
#include "io/drape_fixture.h"

namespace arete {
namespace {

using test::PictureSpec;
using test::TemporaryFolder;
using test::terrainAt;
using test::Transform;
using test::writePicture;

using Pixel = DrapeReader::Pixel;

constexpr const char* kUtmCode = "EPSG:32611";
const Transform kGround = {500000, 30, 0, 4000000, 0, -30};

struct Whole {
  std::uint32_t columns = 0, rows = 0;
  std::vector<Pixel> pixels;
  const Pixel& at(std::uint32_t c, std::uint32_t r) const { return pixels[std::size_t(r) * columns + c]; }
};

/// In windows of odd sizes.
Whole readAll(DrapeReader& reader) {
  Whole all{reader.columns(), reader.rows(), {}};
  all.pixels.resize(std::size_t(all.columns) * all.rows);
  const std::uint32_t side = 37;
  std::vector<Pixel> window(side * side);
  for (std::uint32_t r = 0; r < all.rows; r += side)
    for (std::uint32_t c = 0; c < all.columns; c += side) {
      const std::uint32_t w = std::min(side, all.columns - c), h = std::min(side, all.rows - r);
      const Status ok = reader.read(c, r, w, h, std::span(window).first(std::size_t(w) * h));
      EXPECT_TRUE(ok) << ok.error().describe();
      for (std::uint32_t y = 0; y < h; ++y)
        std::copy_n(&window[std::size_t(y) * w], w, &all.pixels[std::size_t(r + y) * all.columns + c]);
    }
  return all;
}

/// The place on the terrain's map of the middle of a pixel.
Vec2 placeOf(const DrapeReader& reader, const TerrainModel& model, double c, double r) {
  return model.toSource(
      {(c + 0.5 - reader.shift().x) / reader.scale().x, (r + 0.5 - reader.shift().y) / reader.scale().y});
}

/// Where a place lies in a picture, in pixels.
Vec2 inPicture(const Transform& t, Vec2 p) {
  const double det = t[1] * t[5] - t[2] * t[4], x = p.x - t[0], y = p.y - t[3];
  return {(x * t[5] - y * t[2]) / det, (y * t[1] - x * t[4]) / det};
}

double anyByte(int c, int r, int b) {
  return (c * 37 + r * 101 + b * 53 + c * r * 7) % 256;
}

/// Cells of 16 pixels.
double checker(int c, int r, int b) {
  const int cell = (c / 16) * 7 + (r / 16) * 13;
  return 40 + (cell * (b + 3) * 29) % 200;
}

TEST(DrapeReader, InTheTerrainsCrsThePixelsAreThoseOfTheFile) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtmCode, kGround);
  // Finer, coarser, beside each other, on their heads.
  const Transform places[] = {{500000, 10, 0, 4000000, 0, -10},
                              {500203.3, 7.3, 0, 3999811.7, 0, -4.1},
                              {499000, 45, 0, 4000500, 0, -45},
                              {500100, 12, 0, 3999100, 0, 12}};
  for (const Transform& t : places) {
    SCOPED_TRACE(t[0]);
    const std::string path =
        writePicture(folder.file("picture.tif"),
                     {.columns = 90, .rows = 70, .transform = t, .crs = kUtmCode, .value = anyByte});
    Result<DrapeReader> reader = DrapeReader::open(path, model);
    ASSERT_TRUE(reader) << reader.error().describe();
    EXPECT_TRUE(reader->warnings().empty());
    const Whole all = readAll(*reader);
    std::size_t compared = 0;
    for (std::uint32_t r = 0; r < all.rows; ++r)
      for (std::uint32_t c = 0; c < all.columns; ++c) {
        const Vec2 p = inPicture(t, placeOf(*reader, model, c, r));
        const int col = int(std::floor(p.x)), row = int(std::floor(p.y));
        ASSERT_NEAR(p.x - col, 0.5, 1e-6);
        ASSERT_NEAR(p.y - row, 0.5, 1e-6);
        for (int b = 0; b < 3; ++b)
          ASSERT_EQ(all.at(c, r)[std::size_t(b)], anyByte(col, row, b)) << c << ", " << r;
        ASSERT_EQ(all.at(c, r)[3], 255);
        ++compared;
      }
    EXPECT_GT(compared, 400u);
    // Every pixel of the file over the terrain is there.
    std::size_t expected = 0;
    for (int row = 0; row < 70; ++row)
      for (int col = 0; col < 90; ++col) {
        const Vec2 xy{t[0] + t[1] * (col + 0.5), t[3] + t[5] * (row + 0.5)}, plan = model.toPlan(xy);
        if (plan.x > -0.5 && plan.x < model.columns - 0.5 && plan.y > -0.5 && plan.y < model.rows - 0.5)
          ++expected;
      }
    EXPECT_GE(compared, expected);
    EXPECT_LE(compared, expected + 2 * (90 + 70));
  }
}

/// Every pixel against the colour of the cell that its place falls into; those beside a cell's edge are left
/// out.
void expectCells(DrapeReader& reader, const TerrainModel& model, const PictureSpec& spec,
                 const std::string& terrainCrs) {
  OGRSpatialReference from, to;
  from.SetFromUserInput(terrainCrs.c_str());
  to.SetFromUserInput(spec.crs.c_str());
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> way(OGRCreateCoordinateTransformation(&from, &to));
  const Whole all = readAll(reader);
  std::size_t compared = 0, hidden = 0;
  for (std::uint32_t r = 0; r < all.rows; ++r)
    for (std::uint32_t c = 0; c < all.columns; ++c) {
      Vec2 xy = placeOf(reader, model, c, r);
      ASSERT_TRUE(way->Transform(1, &xy.x, &xy.y));
      const Vec2 p = inPicture(spec.transform, xy);
      const auto isNear = [](double at, double every) {
        return std::abs(at / every - std::round(at / every)) * every < 1.7;
      };
      const bool isOut = p.x < -1.7 || p.y < -1.7 || p.x > spec.columns + 1.7 || p.y > spec.rows + 1.7;
      if (isOut) {
        ASSERT_EQ(all.at(c, r), (Pixel{0, 0, 0, 0})) << c << ", " << r;
        ++hidden;
        continue;
      }
      if (isNear(p.x, 16) || isNear(p.y, 16) || isNear(p.x, spec.columns) || isNear(p.y, spec.rows)) continue;
      for (int b = 0; b < 3; ++b)
        ASSERT_NEAR(all.at(c, r)[std::size_t(b)], spec.value(int(p.x), int(p.y), b), 1) << c << ", " << r;
      ASSERT_EQ(all.at(c, r)[3], 255);
      ++compared;
    }
  EXPECT_GT(compared, 2000u);
  std::cout << compared << " pixels compared, " << hidden << " outside\n";
}

TEST(DrapeReader, APictureInAnotherCrsOrTurnedLiesWhereItsMapSays) {
  const TemporaryFolder folder;
  const double a = 25 * std::numbers::pi / 180;
  struct Case {
    const char* name;
    const char* terrainCrs;
    Transform terrain;
    const char* crs;
    Transform picture;
  };
  // 500000, 4000000 of UTM 11 is 117 W, 36.1447 N.
  const Case cases[] = {
      {"longitude and latitude on UTM",
       kUtmCode,
       kGround,
       "EPSG:4326",
       {-117.002, 0.00008, 0, 36.147, 0, -0.00006}},
      {"its half only", kUtmCode, kGround, "EPSG:4326", {-116.994, 0.00008, 0, 36.141, 0, -0.00006}},
      {"UTM on longitude and latitude",
       "EPSG:4326",
       {-117.002, 0.0003, 0, 36.147, 0, -0.0003},
       kUtmCode,
       {499900, 7, 0, 4000300, 0, -7}},
      {"a neighbouring zone", kUtmCode, kGround, "EPSG:32612", {-39600, 6, 0, 4016900, 0, -6}},
      {"a turned picture",
       kUtmCode,
       kGround,
       kUtmCode,
       {500300, 6 * std::cos(a), 6 * std::sin(a), 3999700, 6 * std::sin(a), -6 * std::cos(a)}},
      {"a turned terrain",
       kUtmCode,
       {500000, 30 * std::cos(a), 30 * std::sin(a), 4000000, 30 * std::sin(a), -30 * std::cos(a)},
       kUtmCode,
       {500100, 7, 0, 4000100, 0, -7}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const TerrainModel model = terrainAt(folder, c.terrainCrs, c.terrain);
    PictureSpec spec{.columns = 200, .rows = 170, .transform = c.picture, .crs = c.crs, .value = checker};
    const std::string path = writePicture(folder.file("picture.tif"), spec);
    Result<DrapeReader> reader = DrapeReader::open(path, model);
    ASSERT_TRUE(reader) << reader.error().describe();
    expectCells(*reader, model, spec, c.terrainCrs);
  }
}

TEST(DrapeReader, WhatIsNoDataOrMaskedIsTransparent) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtmCode, kGround);
  const Transform t = {500000, 10, 0, 4000000, 0, -10};
  struct Case {
    const char* name;
    int bands;
    std::function<double(int, int, int)> value;
    std::function<void(GDALDataset&)> adjust;
    std::function<Pixel(int, int)> expected;
  };
  const auto isHole = [](int c, int r) { return (c / 10 + r / 10) % 3 == 0; };
  const Case cases[] = {
      {"grey",
       1,
       [](int c, int r, int) { return anyByte(c, r, 0); },
       {},
       [](int c, int r) {
         const auto g = std::uint8_t(anyByte(c, r, 0));
         return Pixel{g, g, g, 255};
       }},
      {"an alpha band", 4,
       [&](int c, int r, int b) { return b < 3          ? anyByte(c, r, b)
                                         : isHole(c, r) ? 0
                                                        : 128; },
       [](GDALDataset& d) { d.GetRasterBand(4)->SetColorInterpretation(GCI_AlphaBand); },
       [&](int c, int r) {
         Pixel p{0, 0, 0, 0};
         if (isHole(c, r)) return p;
         for (int b = 0; b < 3; ++b) p[std::size_t(b)] = std::uint8_t((anyByte(c, r, b) * 128 + 127) / 255);
         p[3] = 128;
         return p;
       }},
      {"no data in all of three bands", 3,
       [&](int c, int r, int b) {
         return isHole(c, r) || (c % 7 == 0 && b == 1) ? 255 : std::fmod(anyByte(c, r, b), 250);
       },
       [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(255); },
       [&](int c, int r) {
         if (isHole(c, r)) return Pixel{0, 0, 0, 0};
         Pixel p{0, 0, 0, 255};
         for (int b = 0; b < 3; ++b)
           p[std::size_t(b)] = std::uint8_t(c % 7 == 0 && b == 1 ? 255 : std::fmod(anyByte(c, r, b), 250));
         return p;
       }},
      {"a colour table with no data", 1,
       [&](int c, int r, int) { return isHole(c, r) ? 255 : (c / 5 + r / 5) % 3; },
       [](GDALDataset& d) {
         GDALColorTable table;
         const GDALColorEntry colors[] = {
             {200, 10, 20, 255}, {30, 210, 40, 255}, {50, 60, 220, 255}, {255, 255, 255, 255}};
         for (int i = 0; i < 3; ++i) table.SetColorEntry(i, &colors[i]);
         table.SetColorEntry(255, &colors[3]);
         d.GetRasterBand(1)->SetColorTable(&table);
         d.GetRasterBand(1)->SetNoDataValue(255);
       },
       [&](int c, int r) {
         const Pixel colors[] = {{200, 10, 20, 255}, {30, 210, 40, 255}, {50, 60, 220, 255}};
         return isHole(c, r) ? Pixel{0, 0, 0, 0} : colors[(c / 5 + r / 5) % 3];
       }},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const std::string path = writePicture(folder.file("picture.tif"), {.columns = 123,
                                                                       .rows = 99,
                                                                       .transform = t,
                                                                       .crs = kUtmCode,
                                                                       .bands = c.bands,
                                                                       .value = c.value,
                                                                       .adjust = c.adjust});
    Result<DrapeReader> reader = DrapeReader::open(path, model);
    ASSERT_TRUE(reader) << reader.error().describe();
    const Whole all = readAll(*reader);
    for (std::uint32_t r = 0; r < all.rows; ++r)
      for (std::uint32_t col = 0; col < all.columns; ++col) {
        const Vec2 p = inPicture(t, placeOf(*reader, model, col, r));
        ASSERT_EQ(all.at(col, r), c.expected(int(p.x), int(p.y))) << col << ", " << r;
      }
  }
}

constexpr Pixel kLandCover[] = {
    {20, 90, 40, 255}, {230, 200, 60, 255}, {190, 30, 30, 255}, {40, 80, 200, 255}};

void addLandCover(GDALDataset& d) {
  GDALColorTable table;
  for (int i = 0; i < 4; ++i) {
    const Pixel& p = kLandCover[i];
    const GDALColorEntry entry{p[0], p[1], p[2], 255};
    table.SetColorEntry(i, &entry);
  }
  d.GetRasterBand(1)->SetColorTable(&table);
  d.GetRasterBand(1)->SetNoDataValue(9);
}

/// 60 of 100 pixels are of class 1, however they are grouped; some are NODATA.
int landCover(int c, int r) {
  if (c > 150 && r > 110) return 9;
  return Random::at(7, c, r) % 100 < 60 ? 1 : int(Random::at(8, c, r) % 4);
}

TEST(DrapeReader, MixesNoColoursOfClassesInWhateverCrsAndResolution) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtmCode, kGround);
  const Transform turned = {500100, 6, 2, 3999900, 2, -6},
                  degrees = {-117.0005, 0.00007, 0, 36.146, 0, -0.00006};
  for (const auto& [transform, crs, most] : {std::tuple{turned, kUtmCode, std::uint64_t(1) << 28},
                                             {degrees, "EPSG:4326", std::uint64_t(1) << 28},
                                             {turned, kUtmCode, std::uint64_t(900)},
                                             {degrees, "EPSG:4326", std::uint64_t(1200)}}) {
    SCOPED_TRACE(std::string(crs) + ", at most " + std::to_string(most));
    const std::string path =
        writePicture(folder.file("cover.tif"), {.columns = 180,
                                                .rows = 140,
                                                .transform = transform,
                                                .crs = crs,
                                                .bands = 1,
                                                .value = [](int c, int r, int) { return landCover(c, r); },
                                                .adjust = addLandCover});
    {
      // Means of the numbers of classes are no classes.
      const GdalDatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
      const int levels[] = {2, 4};
      ASSERT_EQ(dataset->BuildOverviews("AVERAGE", 2, const_cast<int*>(levels), 0, nullptr, nullptr, nullptr),
                CE_None);
    }
    Result<DrapeReader> reader = DrapeReader::open(path, model, {.bands = {}, .maxPixels = most});
    ASSERT_TRUE(reader) << reader.error().describe();
    EXPECT_TRUE(reader->hasClasses());
    const Whole all = readAll(*reader);
    std::size_t ofMost = 0, seen = 0;
    for (const Pixel& p : all.pixels) {
      if (p == Pixel{}) continue;
      ASSERT_NE(std::ranges::find(kLandCover, p), std::end(kLandCover))
          << int(p[0]) << " " << int(p[1]) << " " << int(p[2]) << " " << int(p[3]);
      ++seen;
      ofMost += p == kLandCover[1] ? 1 : 0;
    }
    EXPECT_GT(seen, 300u);
    // Nearest keeps the shares of 70 %; the majority of many pixels is nearly always class 1.
    if (most > 10000) {
      EXPECT_NEAR(double(ofMost) / double(seen), 0.7, 0.05);
    } else {
      EXPECT_GT(double(ofMost) / double(seen), 0.97);
    }
  }
}

TEST(DrapeReader, TakesTheColoursOfAnAttributeTableAndOfNumbersOfMoreThanAByte) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtmCode, kGround);
  const Transform t = {500000, 10, 0, 4000000, 0, -10};
  const std::string path = folder.file("attributes.tif");
  writePicture(path, {.columns = 90,
                      .rows = 90,
                      .transform = t,
                      .crs = kUtmCode,
                      .bands = 1,
                      .type = GDT_Int16,
                      .value = [](int c, int, int) { return c % 3 == 0   ? 300
                                                            : c % 3 == 1 ? 2
                                                                         : -7; },
                      .adjust =
                          [](GDALDataset& d) {
                            GDALDefaultRasterAttributeTable table;
                            table.CreateColumn("Value", GFT_Integer, GFU_MinMax);
                            table.CreateColumn("Red", GFT_Integer, GFU_Red);
                            table.CreateColumn("Green", GFT_Integer, GFU_Green);
                            table.CreateColumn("Blue", GFT_Integer, GFU_Blue);
                            int row = 0;
                            for (const auto& [value, red] : {std::pair{2, 10}, {300, 250}}) {
                              const int cells[] = {value, red, 20, 30};
                              for (int i = 0; i < 4; ++i) table.SetValue(row, i, cells[i]);
                              ++row;
                            }
                            d.GetRasterBand(1)->SetDefaultRAT(&table);
                          }});
  Result<DrapeReader> reader = DrapeReader::open(path, model);
  ASSERT_TRUE(reader) << reader.error().describe();
  EXPECT_TRUE(reader->hasClasses());
  const Whole all = readAll(*reader);
  EXPECT_EQ(all.at(0, 5), (Pixel{250, 20, 30, 255}));
  EXPECT_EQ(all.at(1, 5), (Pixel{10, 20, 30, 255}));
  EXPECT_EQ(all.at(2, 5), (Pixel{0, 0, 0, 0})) << "a class without a colour";
}

TEST(DrapeReader, OtherNumbersAreStretchedBetweenTheirPercentiles) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtmCode, kGround);
  const Transform t = {500000, 10, 0, 4000000, 0, -10};
  // 100 columns of rising values and a few wild ones.
  const auto value = [](int c, int r, int) { return r == 0 ? 60000.0 : 1000 + 10.0 * (c % 100); };
  for (const GDALDataType type : {GDT_UInt16, GDT_Float32}) {
    const std::string path = writePicture(folder.file("picture.tif"), {.columns = 100,
                                                                       .rows = 99,
                                                                       .transform = t,
                                                                       .crs = kUtmCode,
                                                                       .bands = 1,
                                                                       .type = type,
                                                                       .value = value});
    Result<DrapeReader> reader = DrapeReader::open(path, model);
    ASSERT_TRUE(reader) << reader.error().describe();
    const Whole all = readAll(*reader);
    ASSERT_EQ(all.columns, 100u);
    for (std::uint32_t c = 0; c < 100; ++c) {
      const double expected = std::clamp((value(int(c), 1, 0) - 1015) / (1985 - 1015), 0.0, 1.0) * 255;
      EXPECT_NEAR(all.at(c, 50)[0], expected, 5) << "column " << c;
      EXPECT_EQ(all.at(c, 0)[0], 255);
      EXPECT_EQ(all.at(c, 50)[3], 255);
    }
  }
}

TEST(DrapeReader, ALargerPictureIsReadCoarserAndSaysSo) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtmCode, kGround);
  const Transform t = {500000, 2, 0, 4000000, 0, -2};
  const auto smooth = [](int c, int r, int b) {
    return b == 0 ? c * 255.0 / 614 : b == 1 ? r * 255.0 / 494 : 255 - c * 255.0 / 614;
  };
  const std::string path =
      writePicture(folder.file("picture.tif"),
                   {.columns = 615, .rows = 495, .transform = t, .crs = kUtmCode, .value = smooth});
  for (const bool hasOverviews : {false, true}) {
    SCOPED_TRACE(hasOverviews);
    if (hasOverviews) {
      GDALDataset* d = GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE);
      const int factors[] = {2, 4};
      EXPECT_EQ(d->BuildOverviews("AVERAGE", 2, factors, 0, nullptr, nullptr, nullptr), CE_None);
      GDALClose(GDALDataset::ToHandle(d));
    }
    Result<DrapeReader> reader = DrapeReader::open(path, model, {.bands = {}, .maxPixels = 15000});
    ASSERT_TRUE(reader) << reader.error().describe();
    EXPECT_LE(std::uint64_t(reader->columns()) * reader->rows(), 15000u);
    EXPECT_GT(std::uint64_t(reader->columns()) * reader->rows(), 14000u);
    ASSERT_EQ(reader->warnings().size(), 1u);
    EXPECT_NE(reader->warnings()[0].sentence.find("coarse"), std::string::npos);
    const Whole all = readAll(*reader);
    // The file, two overviews and the warp round to whole numbers, halves upwards; red rises where blue
    // falls, so that a shift shows in their difference and rounding does not.
    double sum = 0, rounded = 0;
    std::size_t count = 0;
    for (std::uint32_t r = 1; r + 1 < all.rows; ++r)
      for (std::uint32_t c = 1; c + 1 < all.columns; ++c) {
        const Vec2 p = inPicture(t, placeOf(*reader, model, c, r));
        const double red = all.at(c, r)[0] - (p.x - 0.5) * 255 / 614,
                     green = all.at(c, r)[1] - (p.y - 0.5) * 255 / 494;
        const double blue = all.at(c, r)[2] - 255 + (p.x - 0.5) * 255 / 614;
        for (const double off : {red, green, blue}) ASSERT_NEAR(off, 0, 2.5) << c << ", " << r;
        sum += (red - blue) / 2;
        rounded += (red + blue) / 2;
        ++count;
      }
    const double shift = sum / double(count) / 255 * 614;
    std::cout << "shifted by " << shift << " pixels of the file, brightened by " << rounded / double(count)
              << "\n";
    EXPECT_NEAR(shift, 0, 0.5);
  }
}

TEST(DrapeReader, WhatCannotBeLaidOverTheTerrainIsToldWhy) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtmCode, kGround);
  const auto picture = [&](const char* name, const char* crs, const Transform& t,
                           GDALDataType type = GDT_Byte) {
    return writePicture(
        folder.file(name),
        {.columns = 20, .rows = 20, .transform = t, .crs = crs, .type = type, .value = [](int, int, int) {
           return 1.0;
         }});
  };
  struct Case {
    std::string path;
    std::vector<int> bands;
    ErrorCode code;
    std::vector<const char*> words;
  };
  const Case cases[] = {
      {folder.file("none.tif"), {}, ErrorCode::notFound, {"no such file"}},
      {folder.write("text.tif", "this is no picture"), {}, ErrorCode::unsupported, {"not a raster"}},
      {picture("bare.tif", kUtmCode, {}), {}, ErrorCode::invalidData, {"no georeference"}},
      {picture("nocrs.tif", "", kGround), {}, ErrorCode::invalidData, {"no CRS"}},
      {picture("away.tif", kUtmCode, {600000, 30, 0, 4000000, 0, -30}),
       {},
       ErrorCode::invalidData,
       {"does not overlap", "600000", "500000"}},
      {picture("far.tif", "EPSG:4326", {8, 0.001, 0, 47, 0, -0.001}),
       {},
       ErrorCode::invalidData,
       {"overlap"}},
      {picture("bands.tif", kUtmCode, kGround), {1, 2, 7}, ErrorCode::usage, {"no band 7"}},
      {picture("two.tif", kUtmCode, kGround), {1, 2}, ErrorCode::usage, {"three"}},
      {picture("complex.tif", kUtmCode, kGround, GDT_CFloat32), {}, ErrorCode::unsupported, {"complex"}},
  };
  for (const Case& c : cases) {
    const Result<DrapeReader> reader = DrapeReader::open(c.path, model, {.bands = c.bands});
    ASSERT_FALSE(reader) << c.path;
    EXPECT_EQ(reader.error().code, c.code) << reader.error().describe();
    EXPECT_EQ(reader.error().culprit, c.path);
    for (const char* word : c.words)
      EXPECT_NE(reader.error().message.find(word), std::string::npos) << reader.error().describe();
  }
  const std::atomic<bool> stop = true;
  const auto stopped =
      DrapeReader::open(picture("ok.tif", kUtmCode, kGround), model, {}, {.progress = {}, .cancel = &stop});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

TEST(DrapeReader, LiesOnADemThatIsAWholeTurnAway) {
  const TemporaryFolder folder;
  struct Case {
    Transform dem;
    int demColumns;
    Transform picture;
    int columns;
    bool goesRound;
  };
  for (const Case& c : {Case{{179, .05, 0, -16, 0, -.05}, 41, {-180, .5, 0, 90, 0, -.5}, 720, true},
                        Case{{179, .05, 0, -16, 0, -.05}, 41, {0, .5, 0, 90, 0, -.5}, 720, true},
                        Case{{0, 10, 0, 80, 0, -5}, 36, {-180, .5, 0, 90, 0, -.5}, 720, true},
                        Case{{179, .05, 0, -16, 0, -.05}, 41, {-181.5, .1, 0, -15, 0, -.1}, 40, false},
                        Case{{-181, .05, 0, -16, 0, -.05}, 41, {178, .1, 0, -15, 0, -.1}, 40, false}}) {
    SCOPED_TRACE(testing::Message() << c.dem[0] << ", " << c.picture[0]);
    const TerrainModel model = terrainAt(folder, "EPSG:4326", c.dem, c.demColumns);
    const std::string path = writePicture(
        folder.file("picture.tif"),
        {.columns = c.columns, .rows = 360, .transform = c.picture, .crs = "EPSG:4326", .value = anyByte});
    Result<DrapeReader> reader = DrapeReader::open(path, model);
    ASSERT_TRUE(reader) << reader.error().describe();
    EXPECT_TRUE(reader->warnings().empty());
    const Whole all = readAll(*reader);
    std::size_t compared = 0;
    for (std::uint32_t r = 0; r < all.rows; ++r)
      for (std::uint32_t col = 0; col < all.columns; ++col) {
        Vec2 xy = placeOf(*reader, model, col, r);
        const double middle = c.picture[0] + c.picture[1] * c.columns / 2;
        xy.x -= 360 * std::round((xy.x - middle) / 360);
        const Vec2 p = inPicture(c.picture, xy);
        if (p.x < 0 || p.x >= c.columns || p.y < 0 || p.y >= 360) continue;
        ++compared;
        for (int b = 0; b < 3; ++b)
          ASSERT_EQ(all.at(col, r)[std::size_t(b)], anyByte(int(p.x), int(p.y), b)) << xy.x << ", " << xy.y;
        ASSERT_EQ(all.at(col, r)[3], 255);
      }
    // All of the DEM where the picture goes round, from edge to edge.
    const double across = reader->scale().x * c.demColumns;
    if (c.goesRound) {
      EXPECT_GE(all.columns, std::floor(across));
    }
    EXPECT_EQ(compared, std::size_t{all.columns} * all.rows);
  }
}

TEST(DrapeReader, OfTwoPartsAWholeTurnApartTheLargerIsDrawn) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, "EPSG:4326", {-180, 10, 0, 80, 0, -5}, 36);
  const std::string path = writePicture(folder.file("picture.tif"), {.columns = 100,
                                                                     .rows = 20,
                                                                     .transform = {160, .5, 0, 20, 0, -.5},
                                                                     .crs = "EPSG:4326",
                                                                     .value = anyByte});
  Result<DrapeReader> reader = DrapeReader::open(path, model);
  ASSERT_TRUE(reader) << reader.error().describe();
  ASSERT_EQ(reader->warnings().size(), 1u);
  EXPECT_NE(reader->warnings()[0].sentence.find("whole turns apart"), std::string::npos)
      << reader->warnings()[0].sentence;
  EXPECT_LT(placeOf(*reader, model, 0, 0).x, -150) << "30 of its 50 degrees";
}

TEST(DrapeReader, FromAMapAcrossTheAntimeridianCoversBothSides) {
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, "EPSG:4326", {179, .05, 0, -16, 0, -.05});
  const PictureSpec spec{.columns = 400,
                         .rows = 300,
                         .transform = {-150000 + 820000, 1000, 0, 8300000, 0, -1000},
                         .crs = "EPSG:32760",
                         .value = checker};
  Result<DrapeReader> reader = DrapeReader::open(writePicture(folder.file("picture.tif"), spec), model);
  ASSERT_TRUE(reader) << reader.error().describe();
  expectCells(*reader, model, spec, "EPSG:4326");
  EXPECT_GT(placeOf(*reader, model, reader->columns() - 1, 0).x, 180.9);
}

}  // namespace
}  // namespace arete
