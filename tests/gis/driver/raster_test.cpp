// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "gis/driver/driver_fixture.h"

namespace arete {
namespace {

using test::Dataset;

class RasterDriver : public test::DriverFixture {
 protected:
  struct Window {
    double left, top, width, height;
    int columns, rows;
    GDALRIOResampleAlg how = GRIORA_NearestNeighbour;
  };
  static std::vector<double> read(GDALRasterBand& band, const Window& w) {
    std::vector<double> heights(std::size_t(w.columns) * std::size_t(w.rows), -1);
    GDALRasterIOExtraArg extra;
    INIT_RASTERIO_EXTRA_ARG(extra);
    extra.eResampleAlg = w.how;
    extra.bFloatingPointWindowValidity = TRUE;
    extra.dfXOff = w.left;
    extra.dfYOff = w.top;
    extra.dfXSize = w.width;
    extra.dfYSize = w.height;
    EXPECT_EQ(
        band.RasterIO(GF_Read, int(w.left), int(w.top), std::max(1, int(w.width)), std::max(1, int(w.height)),
                      heights.data(), w.columns, w.rows, GDT_Float64, 0, 0, &extra),
        CE_None);
    return heights;
  }
  static std::vector<double> readAll(GDALRasterBand& band) {
    return read(band,
                {0, 0, double(band.GetXSize()), double(band.GetYSize()), band.GetXSize(), band.GetYSize()});
  }

  /// That each pixel of a window is the plane at its middle, or nothing beyond the middles of the source's
  /// rim.
  static void expectPlane(GDALDataset& dataset, GDALRasterBand& band, const Window& w, const Box2& domain) {
    std::array<double, 6> g{};
    ASSERT_EQ(dataset.GetGeoTransform(g.data()), CE_None);
    const double across = double(dataset.GetRasterXSize()) / band.GetXSize(),
                 down = double(dataset.GetRasterYSize()) / band.GetYSize();
    const std::vector<double> heights = read(band, w);
    int known = 0;
    for (int row = 0; row < w.rows; ++row)
      for (int column = 0; column < w.columns; ++column) {
        const double pixel = across * (w.left + (column + 0.5) * w.width / w.columns),
                     line = down * (w.top + (row + 0.5) * w.height / w.rows);
        const double x = g[0] + g[1] * pixel + g[2] * line, y = g[3] + g[4] * pixel + g[5] * line;
        const double height = heights[std::size_t(row) * std::size_t(w.columns) + std::size_t(column)];
        const double slack = 1e-6;
        if (x > domain.xMin + slack && x < domain.xMax - slack && y > domain.yMin + slack &&
            y < domain.yMax - slack) {
          ASSERT_NEAR(height, plane(x, y), 1e-6) << x << ", " << y;
          ++known;
        } else if (x < domain.xMin - slack || x > domain.xMax + slack || y < domain.yMin - slack ||
                   y > domain.yMax + slack) {
          ASSERT_TRUE(std::isnan(height)) << x << ", " << y;
        }
      }
    EXPECT_GT(known, 0);
  }
};

TEST_F(RasterDriver, GivesThePlaneAtThePixelsMiddleInWindowsOverviewsAndResampledReads) {
  const std::string path = terrain("plane.amt", 700, 500, plane);
  const Box2 domain{500015, 4000000 - 499.5 * 30, 500000 + 699.5 * 30, 3999985};
  for (const auto& options : {std::vector<const char*>{}, {"TOLERANCE=2"}, {"CELL=7.3"}, {"CELL=100"}}) {
    const Dataset dataset = options.empty() ? open(path) : open(path, {options[0]});
    ASSERT_TRUE(dataset) << message();
    SCOPED_TRACE(options.empty() ? "no option" : options[0]);
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    const double across = band.GetXSize(), down = band.GetYSize();
    for (const auto how : {GRIORA_NearestNeighbour, GRIORA_Bilinear, GRIORA_Average, GRIORA_Cubic}) {
      expectPlane(*dataset, band, {0, 0, across, down, 300, 240, how}, domain);
      expectPlane(*dataset, band, {across / 3, down / 4, across / 5, down / 3, 77, 31, how}, domain);
      expectPlane(*dataset, band, {10.25, 17.75, 40.5, 33.25, 162, 133, how}, domain);
      expectPlane(*dataset, band, {across / 2 + 0.5, down / 2 + 0.5, 20, 20, 20, 20, how}, domain);
    }
    EXPECT_EQ(band.GetOverviewCount() > 0, across > 255);
    for (int k = 0; k < band.GetOverviewCount(); ++k) {
      GDALRasterBand& overview = *band.GetOverview(k);
      EXPECT_EQ(overview.GetXSize(), int(std::ceil(band.GetXSize() / std::exp2(k + 1))));
      expectPlane(*dataset, overview,
                  {0, 0, double(overview.GetXSize()), double(overview.GetYSize()), overview.GetXSize(),
                   overview.GetYSize()},
                  domain);
      expectPlane(*dataset, overview, {5, 6, 40, 30, 33, 77}, domain);
    }
  }
}

TEST_F(RasterDriver, ReadsTheSamplesToTheBitAndNothingWhereTheSourceHasNone) {
  const auto height = [](double x, double y) {
    return x > 502000 && x < 502400 && y > 3998000 ? std::numeric_limits<double>::quiet_NaN() : hills(x, y);
  };
  const std::string path = terrain("hills.amt", 300, 200, height);
  const Dataset dataset = open(path);
  ASSERT_TRUE(dataset) << message();
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  int isKnown = FALSE;
  EXPECT_TRUE(std::isnan(band.GetNoDataValue(&isKnown)));
  EXPECT_TRUE(isKnown);
  EXPECT_STREQ(band.GetUnitType(), "metre");
  const std::vector<double> heights = readAll(band);
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 300; ++column) {
      const double wanted = height(500000 + 30 * (column + 0.5), 4000000 - 30 * (row + 0.5)),
                   found = heights[std::size_t(row * 300 + column)];
      if (std::isnan(wanted))
        ASSERT_TRUE(std::isnan(found)) << column << ", " << row;
      else
        ASSERT_EQ(found, wanted) << column << ", " << row;
    }
  // By blocks, which is another way through GDAL.
  int width = 0, blockHeight = 0;
  band.GetBlockSize(&width, &blockHeight);
  std::vector<double> block(std::size_t(width) * std::size_t(blockHeight));
  ASSERT_EQ(band.ReadBlock(1, 0, block.data()), CE_None);
  EXPECT_EQ(block[3], heights[std::size_t(width + 3)]);
}

TEST_F(RasterDriver, KeepsTheToleranceAndGivesTheSameInEveryWindow) {
  const std::string path = terrain("hills.amt", 400, 300, hills);
  const Dataset dataset = open(path, {"TOLERANCE=5"});
  ASSERT_TRUE(dataset) << message();
  EXPECT_STREQ(dataset->GetMetadataItem("TOLERANCE"), "5");
  EXPECT_STREQ(dataset->GetMetadataItem("SOURCE"), "dem.tif");
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  const std::vector<double> whole = readAll(band);
  double most = 0;
  for (int row = 0; row < 300; ++row)
    for (int column = 0; column < 400; ++column)
      most = std::max(most, std::abs(whole[std::size_t(row * 400 + column)] -
                                     hills(500000 + 30 * (column + 0.5), 4000000 - 30 * (row + 0.5))));
  EXPECT_LE(most, 5);
  EXPECT_GT(most, 1);
  const std::vector<double> part = read(band, {101, 57, 90, 40, 90, 40});
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 90; ++column)
      ASSERT_NEAR(part[std::size_t(row * 90 + column)], whole[std::size_t((row + 57) * 400 + column + 101)],
                  1e-9);
}

TEST_F(RasterDriver, OverviewsKeepTheErrorThatTheyState) {
  const std::string path = terrain("hills.amt", 600, 500, hills);
  for (const bool isPacked : {false, true}) {
    const std::string packed = folder().file("packed.amt");
    if (isPacked) {
      ASSERT_TRUE(writeAmt(packed, *loadAmt(path), {}, {.isPacked = true}));
    }
    const Dataset dataset = open(isPacked ? packed : path);
    ASSERT_TRUE(dataset) << message();
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    ASSERT_EQ(band.GetOverviewCount(), 2);
    double before = 0;
    for (int k = 0; k < 2; ++k) {
      GDALRasterBand& overview = *band.GetOverview(k);
      const double error = CPLAtof(overview.GetMetadataItem("ERROR"));
      EXPECT_GT(error, before);
      before = error;
      const std::vector<double> heights = readAll(overview);
      const double across = 600.0 / overview.GetXSize(), down = 500.0 / overview.GetYSize();
      for (int row = 0; row < overview.GetYSize(); ++row)
        for (int column = 0; column < overview.GetXSize(); ++column) {
          const double x = 500000 + 30 * across * (column + 0.5), y = 4000000 - 30 * down * (row + 0.5);
          // Beside the cut's error that of the finest triangles between the samples.
          ASSERT_NEAR(heights[std::size_t(row * overview.GetXSize() + column)], hills(x, y), error + 0.5);
        }
    }
  }
}

TEST_F(RasterDriver, ShowsNoStatisticsOfAnotherTolerance) {
  const std::string path = terrain("hills.amt", 200, 200, hills);
  double low = 0, high = 0;
  {
    const Dataset dataset = open(path, {"TOLERANCE=60"});
    ASSERT_TRUE(dataset) << message();
    ASSERT_EQ(
        dataset->GetRasterBand(1)->ComputeStatistics(FALSE, &low, &high, nullptr, nullptr, nullptr, nullptr),
        CE_None);
    EXPECT_NE(dataset->GetRasterBand(1)->GetMetadataItem("STATISTICS_MAXIMUM"), nullptr);
  }
  EXPECT_EQ(folder().count(), 1u) << "nothing beside the file";
  std::ofstream(path + ".aux.xml")
      << "<PAMDataset><Metadata><MDI key=\"TOLERANCE\">7</MDI></Metadata>"
         "<PAMRasterBand band=\"1\"><Metadata><MDI key=\"STATISTICS_MAXIMUM\">7</MDI>"
         "</Metadata></PAMRasterBand></PAMDataset>";
  const Dataset dataset = open(path);
  ASSERT_TRUE(dataset) << message();
  EXPECT_STREQ(dataset->GetMetadataItem("TOLERANCE"), "0");
  EXPECT_EQ(dataset->GetRasterBand(1)->GetMetadataItem("STATISTICS_MAXIMUM"), nullptr);
  double finest = 0;
  ASSERT_EQ(dataset->GetRasterBand(1)->ComputeStatistics(FALSE, nullptr, &finest, nullptr, nullptr, nullptr,
                                                         nullptr),
            CE_None);
  EXPECT_NE(finest, high);
}

TEST_F(RasterDriver, KeepsARotatedGrid) {
  const std::array<double, 6> turned = {500000, 20, 5, 4000000, 6, -25};
  const std::string path = terrain("turned.amt", 150, 120, plane, turned);
  const Dataset dataset = open(path);
  ASSERT_TRUE(dataset) << message();
  std::array<double, 6> found{};
  ASSERT_EQ(dataset->GetGeoTransform(found.data()), CE_None);
  EXPECT_EQ(found, turned);
  const std::vector<double> heights = readAll(*dataset->GetRasterBand(1));
  EXPECT_NEAR(heights[150 * 60 + 70], plane(500000 + 20 * 70.5 + 5 * 60.5, 4000000 + 6 * 70.5 - 25 * 60.5),
              1e-9);
  // North up over its extent.
  const Dataset straight = open(path, {"CELL=15"});
  ASSERT_TRUE(straight) << message();
  ASSERT_EQ(straight->GetGeoTransform(found.data()), CE_None);
  const int columns = straight->GetRasterXSize(), rows = straight->GetRasterYSize();
  const std::vector<double> again = readAll(*straight->GetRasterBand(1));
  int known = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double height = again[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
      if (std::isnan(height)) continue;
      ++known;
      ASSERT_NEAR(height, plane(found[0] + 15 * (column + 0.5), found[3] - 15 * (row + 0.5)), 1e-6);
    }
  EXPECT_GT(known, columns * rows / 2);
}

TEST_F(RasterDriver, OpensScatteredPointsOnAGridOfTheirSpacing) {
  PointHeightfield points;
  for (int i = 0; i < 400; ++i) {
    const double x = 500000 + (i * 37 % 400) * 2.5, y = 4000000 - (i * 91 % 400) * 2.5;
    points.positions.push_back({x, y});
    points.heights.push_back(plane(x, y));
  }
  const std::string path = written("points.amt", build(points));
  const Dataset dataset = open(path);
  ASSERT_TRUE(dataset) << message();
  EXPECT_NEAR(dataset->GetRasterXSize(), 20, 3);
  const Dataset fine = open(path, {"CELL=5"});
  ASSERT_TRUE(fine) << message();
  std::array<double, 6> g{};
  ASSERT_EQ(fine->GetGeoTransform(g.data()), CE_None);
  const std::vector<double> heights = readAll(*fine->GetRasterBand(1));
  const int columns = fine->GetRasterXSize();
  int known = 0;
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (!std::isnan(heights[i])) {
      ++known;
      ASSERT_NEAR(
          heights[i],
          plane(g[0] + 5 * (double(int(i) % columns) + 0.5), g[3] - 5 * (double(int(i) / columns) + 0.5)),
          1e-6);
    }
  EXPECT_GT(known, 10000);
}

/// Rough ground: a sample has nothing to do with the next.
double rough(double x, double y) {
  return std::round(std::fmod(std::fabs(std::sin(x * 12.9898 + y * 78.233) * 43758.5453), 1) * 400);
}

TEST_F(RasterDriver, IsTheFinestSurfaceBetweenTheSamplesToo) {
  const std::string path = terrain("rough.amt", 60, 50, rough);
  for (const char* cell : {"CELL=7", "CELL=12.5", "CELL=20", "CELL=30", "CELL=31", "CELL=45"}) {
    SCOPED_TRACE(cell);
    const Dataset dataset = open(path, {cell});
    ASSERT_TRUE(dataset) << message();
    std::array<double, 6> g{};
    ASSERT_EQ(dataset->GetGeoTransform(g.data()), CE_None);
    const std::vector<double> found = readAll(*dataset->GetRasterBand(1));
    const int columns = dataset->GetRasterXSize(), rows = dataset->GetRasterYSize();
    int known = 0;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        // In cells between samples, of which the diagonal joins the upper left and the lower right.
        const double x = (g[0] + (column + 0.5) * g[1] - 500000) / 30 - 0.5,
                     y = (4000000 - g[3] - (row + 0.5) * g[5]) / 30 - 0.5;
        const double u = x - std::floor(x), v = y - std::floor(y);
        if (x < 0 || y < 0 || x > 59 || y > 49) continue;
        const auto at = [&](double right, double down) {
          return rough(500000 + 30 * (std::floor(x) + right + 0.5),
                       4000000 - 30 * (std::floor(y) + down + 0.5));
        };
        const double wanted = u >= v ? at(0, 0) + (at(1, 0) - at(0, 0)) * u + (at(1, 1) - at(1, 0)) * v
                                     : at(0, 0) + (at(0, 1) - at(0, 0)) * v + (at(1, 1) - at(0, 1)) * u;
        ASSERT_NEAR(found[std::size_t(row) * std::size_t(columns) + std::size_t(column)], wanted, 1e-6);
        ++known;
      }
    EXPECT_GT(known, columns * rows / 2);
  }
}

TEST_F(RasterDriver, GivesInRowsColumnsAndSmallWindowsWhatItGivesAsAWhole) {
  const std::string plain = terrain("rough.amt", 530, 270, rough), packed = folder().file("packed.amt");
  ASSERT_TRUE(writeAmt(packed, *loadAmt(plain), {}, {.isPacked = true}));
  for (const std::string& path : {plain, packed})
    for (const char* const option : {"TOLERANCE=0", "TOLERANCE=20", "CELL=21"}) {
      SCOPED_TRACE(path + " " + option);
      const Dataset all = open(path, {option}), parts = open(path, {option});
      ASSERT_TRUE(all && parts) << message();
      const std::vector<double> whole = readAll(*all->GetRasterBand(1));
      GDALRasterBand& band = *parts->GetRasterBand(1);
      const int columns = band.GetXSize(), rows = band.GetYSize();
      const auto expectPart = [&](int left, int top, int width, int height) {
        std::vector<double> part(std::size_t(width) * std::size_t(height));
        ASSERT_EQ(band.RasterIO(GF_Read, left, top, width, height, part.data(), width, height, GDT_Float64, 0,
                                0, nullptr),
                  CE_None);
        for (int row = 0; row < height; ++row)
          for (int column = 0; column < width; ++column) {
            const double
                x = part[std::size_t(row) * std::size_t(width) + std::size_t(column)],
                y = whole[std::size_t(top + row) * std::size_t(columns) + std::size_t(left + column)];
            ASSERT_TRUE(std::isnan(x) ? std::isnan(y) : std::fabs(x - y) < 1e-9)
                << left + column << ", " << top + row;
          }
      };
      for (int row = 0; row < rows; row += 30) expectPart(0, row, columns, 1);
      for (int column = 0; column < columns; column += 200) expectPart(column, 0, 1, rows);
      expectPart(250, 250, 11, 11);
      expectPart(columns - 1, rows - 1, 1, 1);
    }
}

TEST_F(RasterDriver, GivesIsolatedSamplesAtTheirOwnPixels) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    // Sparse samples around a patch: many are in no cell of three.
    const auto height = [&](double x, double y) {
      const bool isPatch = x > 500300 && x < 500500 && y < 3999700 && y > 3999500;
      return isPatch || rough(x + 31 * seed, y) < 60 ? rough(x, y) : nan;
    };
    const std::string path = terrain("sparse.amt", 40, 30, height);
    const auto model = loadAmt(path);
    ASSERT_TRUE(model);
    ASSERT_GT(model->isolated.size(), 10u);
    const Dataset dataset = open(path);
    ASSERT_TRUE(dataset) << message();
    EXPECT_EQ(dataset->GetMetadataItem("ISOLATED_SAMPLES"), std::to_string(model->isolated.size()));
    const std::vector<double> found = readAll(*dataset->GetRasterBand(1));
    for (int row = 0; row < 30; ++row)
      for (int column = 0; column < 40; ++column) {
        const double wanted = height(500000 + 30 * (column + 0.5), 4000000 - 30 * (row + 0.5)),
                     is = found[std::size_t(row * 40 + column)];
        ASSERT_TRUE(std::isnan(wanted) ? std::isnan(is) : is == wanted) << column << ", " << row;
      }
    const std::vector<double> one = read(*dataset->GetRasterBand(1), {7, 5, 20, 1, 20, 1});
    for (int column = 0; column < 20; ++column) {
      const double x = one[std::size_t(column)], y = found[std::size_t(5 * 40 + 7 + column)];
      ASSERT_TRUE(std::isnan(x) ? std::isnan(y) : x == y);
    }
  }
}

TEST_F(RasterDriver, GoesRoundTheEarthOnAGridOfCells) {
  const auto height = [](double x, double y) { return 100 * std::cos(x / 57.29577951) + y; };
  RasterHeightfield field;
  field.columns = 73;  // the first one again
  field.rows = 9;
  field.source = "world.tif";
  field.georeference.geoTransform = {-182.5, 5, 0, 22.5, 0, -5};
  field.georeference.hasGeoTransform = field.georeference.isGeographic =
      field.georeference.repeatsFirstColumn = true;
  for (std::uint32_t row = 0; row < 9; ++row)
    for (std::uint32_t column = 0; column < 73; ++column)
      field.heights.push_back(height(-180 + 5.0 * (column % 72), 20 - 5.0 * row));
  const std::string path = written("world.amt", build(field));
  for (const char* const option : {"CELL=5", "CELL=1", "CELL=2.5", "CELL=0.7"})
    for (const bool hasTolerance : {false, true}) {
      SCOPED_TRACE(option);
      const Dataset dataset = hasTolerance ? open(path, {option, "TOLERANCE=0.001"}) : open(path, {option});
      ASSERT_TRUE(dataset) << message();
      std::array<double, 6> g{};
      ASSERT_EQ(dataset->GetGeoTransform(g.data()), CE_None);
      EXPECT_DOUBLE_EQ(g[0], -182.5);
      EXPECT_NEAR(dataset->GetRasterXSize() * g[1], 360, g[1]);
      const std::vector<double> found = readAll(*dataset->GetRasterBand(1));
      const int columns = dataset->GetRasterXSize();
      const int middle = dataset->GetRasterYSize() / 2;
      for (int column = 0; column < columns; ++column) {
        const double x = g[0] + (column + 0.5) * g[1];
        if (x > 177.5) continue;  // the last pixel may reach beyond
        ASSERT_NEAR(found[std::size_t(middle) * std::size_t(columns) + std::size_t(column)],
                    height(x, g[3] + (middle + 0.5) * g[5]), 0.2)
            << x;
      }
    }
}

TEST_F(RasterDriver, ReadsFilesOfGdalsFileSystems) {
  const std::string path = terrain("hills.amt", 60, 50, hills);
  std::ifstream from(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(from)), {});
  const std::string names[] = {"/vsimem/driver_test.amt", "/vsimem/driver_test_without_a_suffix",
                               "/vsizip/" + folder().file("m.zip") + "/a folder/hills.amt",
                               "/vsigzip/" + folder().file("hills.amt.gz")};
  const Dataset plain = open(path);
  ASSERT_TRUE(plain) << message();
  const std::vector<double> wanted = readAll(*plain->GetRasterBand(1));
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    VSILFILE* const file = VSIFOpenL(name.c_str(), "wb");
    ASSERT_NE(file, nullptr);
    ASSERT_EQ(VSIFWriteL(bytes.data(), 1, bytes.size(), file), bytes.size());
    ASSERT_EQ(VSIFCloseL(file), 0);
    const Dataset dataset = open(name);
    ASSERT_TRUE(dataset) << message();
    EXPECT_EQ(readAll(*dataset->GetRasterBand(1)), wanted);
    EXPECT_EQ(dataset->GetLayer(0)->GetFeatureCount(), plain->GetLayer(0)->GetFeatureCount());
  }
  const std::string name = "/vsisubfile/0_" + std::to_string(bytes.size()) + "," + path;
  const Dataset part = open(name);
  ASSERT_TRUE(part) << message();
  EXPECT_EQ(readAll(*part->GetRasterBand(1)), wanted);
}

TEST_F(RasterDriver, AFileThatIsChangedWhileItIsOpenIsAnErrorNotTheEndOfTheProgram) {
  const auto failsToRead = [](GDALDataset& dataset) {
    std::vector<double> heights(250 * 200);
    CPLErrorReset();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    const CPLErr read = dataset.GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 250, 200, heights.data(), 250, 200,
                                                           GDT_Float64, 0, 0, nullptr);
    CPLPopErrorHandler();
    return read == CE_Failure;
  };
  const std::string plain = terrain("hills.amt", 250, 200, hills), packed = folder().file("packed.amt"),
                    path = folder().file("open.amt");
  ASSERT_TRUE(writeAmt(packed, *loadAmt(plain), {}, {.isPacked = true}));
  for (const std::string& from : {plain, packed})
    for (const char* const option : {"TOLERANCE=0", "TOLERANCE=1", "TOLERANCE=5", "CELL=15"})
      for (const std::uintmax_t size : {std::uintmax_t{0}, std::uintmax_t{100}, std::uintmax_t{100000}}) {
        SCOPED_TRACE(from + " " + option + " to " + std::to_string(size));
        std::filesystem::copy_file(from, path, std::filesystem::copy_options::overwrite_existing);
        const Dataset dataset = open(path, {option});
        ASSERT_TRUE(dataset) << message();
        std::filesystem::resize_file(path, size);
        EXPECT_TRUE(failsToRead(*dataset));
        EXPECT_NE(std::string(CPLGetLastErrorMsg()).find("while it was open"), std::string::npos)
            << CPLGetLastErrorMsg();
      }
}

TEST_F(RasterDriver, CallsTheErrorAsTheCommandDoesAndByItsOlderName) {
  const std::string path = terrain("hills.amt", 40, 30, hills);
  const Dataset named = open(path, {"MAX_ERROR=5"}), older = open(path, {"TOLERANCE=5"});
  ASSERT_TRUE(named && older) << message();
  EXPECT_STREQ(named->GetMetadataItem("TOLERANCE"), "5");
  EXPECT_STREQ(named->GetMetadataItem("ERROR"), older->GetMetadataItem("ERROR"));
  EXPECT_TRUE(open(path, {"MAX_ERROR=5", "TOLERANCE=5"}));
  EXPECT_FALSE(open(path, {"MAX_ERROR=5", "TOLERANCE=6"}));
  EXPECT_NE(message().find("MAX_ERROR=5"), std::string::npos) << message();
  EXPECT_FALSE(open(path, {"MAX_ERROR=-1"}));
  EXPECT_NE(message().find("MAX_ERROR=-1"), std::string::npos) << message();
}

TEST_F(RasterDriver, NamesWhatMakesNoSense) {
  const std::string path = terrain("hills.amt", 40, 30, hills);
  EXPECT_FALSE(open(path, {"TOLERANCE=-1"}));
  EXPECT_NE(message().find("TOLERANCE=-1"), std::string::npos) << message();
  EXPECT_FALSE(open(path, {"TOLERANCE=2m"}));
  EXPECT_NE(message().find("TOLERANCE=2m"), std::string::npos) << message();
  EXPECT_FALSE(open(path, {"CELL=0"}));
  EXPECT_NE(message().find("CELL=0"), std::string::npos) << message();
  EXPECT_FALSE(open(path, {"CELL=1e-9"}));
  EXPECT_NE(message().find("more than GDAL can number"), std::string::npos) << message();
  EXPECT_FALSE(open(path, {}, GDAL_OF_RASTER | GDAL_OF_UPDATE | GDAL_OF_VERBOSE_ERROR));
  EXPECT_NE(message().find("only read"), std::string::npos) << message();
  // QGIS asks for an update first, quietly, and would show what is said of it as an error.
  EXPECT_FALSE(open(path, {}, GDAL_OF_VECTOR | GDAL_OF_UPDATE));
  EXPECT_EQ(message(), "");
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_FALSE(open(path));
  EXPECT_NE(message().find("hills.amt"), std::string::npos) << message();
}

TEST_F(RasterDriver, ADamagedFileIsAnErrorWhereItIsRead) {
  const std::string path = terrain("hills.amt", 300, 300, hills);
  {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(std::streamoff(std::filesystem::file_size(path) * 2 / 3));
    file.write("\x55\xaa\x55\xaa\x55\xaa\x55\xaa", 8);
  }
  const Dataset dataset = open(path);
  if (!dataset) return;
  std::vector<double> heights(90000);
  CPLPushErrorHandler(CPLQuietErrorHandler);
  EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 300, 300, heights.data(), 300, 300,
                                                GDT_Float64, 0, 0, nullptr),
            CE_Failure);
  CPLPopErrorHandler();
}

}  // namespace
}  // namespace arete
