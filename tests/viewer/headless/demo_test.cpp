// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/headless/demo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/dem/raster_writer.h"
#include "io/store/amt/file.h"
#include "terrain/measure/measure.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

class Demo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("arete_demo_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Hills with a pond of NODATA.
  static RasterHeightfield hills(std::uint32_t columns, std::uint32_t rows) {
    RasterHeightfield h;
    h.columns = columns;
    h.rows = rows;
    for (std::uint32_t r = 0; r < rows; ++r) {
      for (std::uint32_t c = 0; c < columns; ++c) {
        const bool isPond = std::hypot(c - 30.0, r - 20.0) < 6;
        const double height = 500 + 180 * std::sin(c / 7.0) * std::cos(r / 9.0) + 9 * std::sin(c * r / 31.0);
        h.heights.push_back(isPond ? std::numeric_limits<double>::quiet_NaN() : std::round(height * 4) / 4);
      }
    }
    h.georeference.hasGeoTransform = true;
    h.georeference.geoTransform = {1000, 30, 0, 5000, 0, -30};
    return h;
  }

  std::string save(const RasterHeightfield& h) const {
    const std::string file = path("dem.tif");
    EXPECT_TRUE(writeGeoTiff(file, h.columns, h.rows, h.heights, h.georeference));
    return file;
  }

  DemoOptions options() const {
    DemoOptions result;
    result.folder = path("out/deep");
    result.pictureWidth = 700;
    return result;
  }

  fs::path folder_;
};

TEST_F(Demo, WritesEveryFileItListsAndNoOther) {
  const Result<DemoReport> report = runDemo(save(hills(120, 90)), options());
  ASSERT_TRUE(report) << report.error().describe();
  std::vector<std::string> kinds;
  for (const std::string& file : report->files) {
    EXPECT_GT(fs::file_size(file), 100u) << file;
    kinds.push_back(fs::path(file).extension().string());
  }
  const auto count = [&](const char* kind) { return std::count(kinds.begin(), kinds.end(), kind); };
  EXPECT_EQ(count(".amt"), 1);
  EXPECT_EQ(count(".ply"), std::ptrdiff_t(report->results.size()));
  EXPECT_EQ(count(".json"), std::ptrdiff_t(report->results.size()));
  EXPECT_GE(count(".png"), 3);
  EXPECT_EQ(std::distance(fs::directory_iterator(path("out/deep")), fs::directory_iterator()),
            std::ptrdiff_t(report->files.size()));
}

TEST_F(Demo, KeepsItsTolerancesWhenTheFilesAreMeasuredAgain) {
  const RasterHeightfield field = hills(120, 90);
  const Result<DemoReport> report = runDemo(save(field), options());
  ASSERT_TRUE(report) << report.error().describe();
  ASSERT_GE(report->results.size(), 2u);
  for (const DemoResult& r : report->results) {
    const auto mesh = readMesh(path("out/deep") + "/" + [&] {
      std::ostringstream name;
      name << "tin-" << r.maxError << ".ply";
      return name.str();
    }());
    ASSERT_TRUE(mesh) << mesh.error().describe();
    EXPECT_EQ(mesh->mesh.triangles.size(), r.triangles);
    const auto measured = measure(mesh->mesh, field);
    ASSERT_TRUE(measured);
    EXPECT_TRUE(checkPromise(*measured, r.maxError))
        << checkPromise(*measured, r.maxError).error().describe();
    EXPECT_DOUBLE_EQ(measured->maxAbsError, r.measuredMax);
    EXPECT_DOUBLE_EQ(measured->meanError, r.measuredMean);
    EXPECT_TRUE(r.isKept);
  }
  EXPECT_TRUE(loadAmt(path("out/deep/dem.amt")));
}

TEST_F(Demo, ChoosesTolerancesThatShowSomething) {
  const Result<DemoReport> report = runDemo(save(hills(160, 160)), options());
  ASSERT_TRUE(report) << report.error().describe();
  ASSERT_GE(report->results.size(), 2u);
  ASSERT_LE(report->results.size(), 5u);
  for (std::size_t i = 0; i < report->results.size(); ++i) {
    EXPECT_LE(report->results[i].percentOfFinest, 30);
    if (i == 0) continue;
    EXPECT_GT(report->results[i].maxError, report->results[i - 1].maxError);
    EXPECT_LT(report->results[i].triangles, report->results[i - 1].triangles);
  }
  EXPECT_GE(report->curve.size(), report->results.size());
}

TEST_F(Demo, TakesTheTolerancesItIsTold) {
  DemoOptions told = options();
  told.maxErrors = {40, 5, 40};
  const Result<DemoReport> report = runDemo(save(hills(90, 70)), told);
  ASSERT_TRUE(report) << report.error().describe();
  ASSERT_EQ(report->results.size(), 2u);
  EXPECT_EQ(report->results[0].maxError, 5);
  EXPECT_EQ(report->results[1].maxError, 40);
}

TEST_F(Demo, PrintsATableThatParses) {
  DemoReport report;
  report.unit = "m";
  DemoResult coarse, fine;
  fine = {.maxError = 0.5,
          .triangles = 123456,
          .percentOfFinest = 12.3456,
          .measuredMax = 0.499,
          .measuredRms = 0.1,
          .measuredMean = -0.03,
          .uncovered = 0,
          .cutSeconds = 0.25,
          .isKept = true};
  coarse = fine;
  coarse.maxError = 100;
  coarse.triangles = 12;
  report.results = {fine, coarse};
  std::istringstream lines(demoTable(report));
  std::string heading, line;
  ASSERT_TRUE(std::getline(lines, heading));
  EXPECT_NE(heading.find("tolerance, m"), std::string::npos);
  for (const DemoResult& expected : report.results) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line.size(), heading.size());
    std::istringstream numbers(line);
    double tolerance = 0, triangles = 0, percent = 0, most = 0, rms = 0, mean = 0, uncovered = -1,
           seconds = 0;
    ASSERT_TRUE(numbers >> tolerance >> triangles >> percent >> most >> rms >> mean >> uncovered >> seconds)
        << line;
    EXPECT_EQ(tolerance, expected.maxError);
    EXPECT_EQ(triangles, expected.triangles);
    EXPECT_NEAR(percent, expected.percentOfFinest, 0.1);
    EXPECT_NEAR(mean, expected.measuredMean, 1e-3);
    EXPECT_EQ(uncovered, 0);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(Demo, DrawsFlatGround) {
  RasterHeightfield flat = hills(40, 40);
  for (double& h : flat.heights) h = 7;
  const Result<DemoReport> report = runDemo(save(flat), options());
  ASSERT_TRUE(report) << report.error().describe();
  EXPECT_EQ(report->results.size(), 1u);
  EXPECT_EQ(report->results[0].measuredMax, 0);
}

TEST_F(Demo, SaysWhatItCannotDo) {
  DemoOptions wrong = options();
  wrong.maxErrors = {-1};
  EXPECT_EQ(runDemo(save(hills(40, 40)), wrong).error().code, ErrorCode::usage);
  EXPECT_EQ(runDemo(path("missing.tif"), options()).error().code, ErrorCode::notFound);
  std::ofstream(path("points.csv")) << "x,y,z\n0,0,1\n3.5,0,2\n0,2.25,3\n4,7,5\n1,9,2\n";
  EXPECT_EQ(runDemo(path("points.csv"), options()).error().code, ErrorCode::unsupported);
}

TEST_F(Demo, StopsWhenToldTo) {
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  EXPECT_EQ(runDemo(save(hills(40, 40)), options(), context).error().code, ErrorCode::interrupted);
  EXPECT_FALSE(fs::exists(path("out/deep/dem.amt")));
}

}  // namespace
}  // namespace arete
