// SPDX-License-Identifier: GPL-3.0-or-later
//
// The promise, on real terrain: whatever the DEM and the tolerance, the exported TIN measured against every
// sample keeps it, leaves no sample uncovered and covers no NODATA; the laws hold and the bytes do not depend
// on the threads. ARETE_BRIEF=1 takes the small DEMs alone, ARETE_FULL=1 adds the largest tile, the fidelity
// shape on every DEM, and the law and thread checks on all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "engine/cut/cut.h"
#include "full_run.h"
#include "io/formats/exchange/export_tin.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"
#include "terrain/fit/fit.h"
#include "terrain/laws/validate_model.h"
#include "terrain/measure/measure.h"

namespace arete {
namespace {

using test::isFull;

struct RealDem {
  const char* name;
  const char* path;                     ///< below the data folder
  std::vector<double> tolerances = {};  ///< of BASELINES.md; else three from the relief
};

const std::vector<RealDem>& realDems() {
  static const std::vector<RealDem> all = {
      {"dted0_n43_dt0", "dem/dted0_n43.dt0"},
      {"dted0_n43_tif", "dem/dted0_n43.tif"},
      {"lidar2m_maungawhau", "dem/lidar2m_maungawhau_nztm.tif"},
      {"lidar_dsm_edinburgh", "dem/lidar_dsm2.5m_edinburgh_bng.tif"},
      {"moon_lola", "dem/moon_lola_ldem4.cub"},
      {"ned13_colorado", "dem/ned13_colorado_roi_nad83.tif"},
      {"juan_de_fuca", "dem/srtm1_N48W125_juan_de_fuca.hgt.zip"},
      {"bigtujunga", "dem/srtm1_bigtujunga_utm11.tif", {1, 5, 10, 20, 50}},
      {"nice", "dem/srtm3_N43E007_nice.hgt.zip"},
      {"bernese_alps", "dem/srtm3_N46E008_bernese_alps.tif"},
      {"thames_E000", "dem/srtm3_N51E000_thames.hgt.zip"},
      {"thames_E001", "dem/srtm3_N51E001_thames.hgt.zip"},
      {"aconcagua", "dem/srtm3_S33W071_aconcagua.tif", {5, 10, 20, 50, 100}},
      {"zion", "dem/srtm3_zion_cc0.tif"},
      {"tiny_compound", "dem/tiny_compound_utm32_egm08.tif"},
      {"mt_st_helens", "dem/usgsdem_mt_st_helens.dem"},
      {"olinda", "drape/olinda_dem_utm25s.tif"},
      {"sba_elev32", "drape/sba_elev32_wgs84_512x512.tif"},
      {"zion_nlcd", "drape/zion_nlcd_landcover_utm12.tif"},
  };
  return all;
}

constexpr std::size_t kLarge = 4'000'000, kMedium = 400'000, kSmall = 130'000;

struct Case {
  RealDem dem;
  HoleShape shape;
};

void PrintTo(const Case& made, std::ostream* out) {
  *out << made.dem.path << ", " << toString(made.shape);
}

class Promise : public testing::TestWithParam<Case> {
 protected:
  /// Empty when the test is to be skipped.
  std::optional<RasterHeightfield> read() {
    const std::filesystem::path path = test::realData(GetParam().dem.path);
    if (path.empty()) {
      skip_ = "the real DEMs are not here (../shared/data or $ARETE_DATA)";
      return {};
    }
    SourceReading reading;
    if (path.extension() == ".tif" || path.extension() == ".png") reading.band = 1;
    const auto dem = readDem(path.string(), reading);
    EXPECT_TRUE(dem) << dem.error().describe();
    if (!dem) return {};
    RasterHeightfield field = std::get<RasterHeightfield>(dem->heightfield);
    if (test::isBrief() && field.size() > kSmall) {
      skip_ = "a DEM of more than 130 000 samples runs without sanitizers";
      return {};
    }
    if (!isFull() && field.size() > kLarge) {
      skip_ = "a DEM of more than 4 million samples runs with ./dev test --full";
      return {};
    }
    return field;
  }
  std::string skip_;
};

std::vector<double> tolerancesOf(const RealDem& dem, const RasterHeightfield& field) {
  if (!dem.tolerances.empty()) return dem.tolerances;
  double low = INFINITY, high = -INFINITY;
  for (const double z : field.heights) {
    if (std::isnan(z)) continue;
    low = std::min(low, z);
    high = std::max(high, z);
  }
  std::vector<double> tolerances;
  for (const double part : {0.001, 0.01, 0.05}) tolerances.push_back(part * (high - low));
  return tolerances;
}

TEST_P(Promise, IsKeptAtEveryToleranceForBothCuts) {
  const auto field = read();
  if (!field) {
    if (!skip_.empty()) GTEST_SKIP() << skip_;
    return;
  }
  BuildOptions options;
  options.shape = GetParam().shape;
  const auto model = build(*field, options);
  ASSERT_TRUE(model) << model.error().describe();
  const test::TemporaryFolder folder;
  for (const double tolerance : tolerancesOf(GetParam().dem, *field))
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
      const auto cut = takeCut(model->mt, UniformError(tolerance), {.method = method});
      ASSERT_TRUE(cut) << cut.error().describe();
      const TinExport tin = exportTin(*model, *cut).value();
      // Through the file, as a user would.
      const std::string path = folder.file("tin.ply");
      const auto written = writeMesh(tin.mesh, path);
      ASSERT_TRUE(written) << written.error().describe();
      const auto back = readMesh(path);
      ASSERT_TRUE(back) << back.error().describe();
      const auto report = measure(back->mesh, *field);
      ASSERT_TRUE(report) << report.error().describe();
      const Status kept = checkPromise(*report, tolerance);
      EXPECT_TRUE(kept) << "tolerance " << tolerance << ": " << kept.error().describe();
      EXPECT_LE(report->errorBeyondRounding, cut->achievedError) << "the stored error is a bound too";
      EXPECT_EQ(report->isolated, model->isolated.size());
    }
}

TEST_P(Promise, IsKeptByFittedHeights) {
  const auto field = read();
  if (!field) {
    if (!skip_.empty()) GTEST_SKIP() << skip_;
    return;
  }
  if (!isFull() && field->size() > kMedium)
    GTEST_SKIP() << "fits on a DEM of more than 400 000 samples run with ./dev test --full";
  BuildOptions options;
  options.shape = GetParam().shape;
  const auto model = build(*field, options);
  ASSERT_TRUE(model) << model.error().describe();
  const double tolerance = tolerancesOf(GetParam().dem, *field)[1];
  const auto fitted = fitFewestTriangles(*model, {.maxError = tolerance});
  ASSERT_TRUE(fitted) << fitted.error().describe();
  const auto report = measure(exportTin(*model, *fitted)->mesh, *field);
  ASSERT_TRUE(report) << report.error().describe();
  const Status kept = checkPromise(*report, tolerance);
  EXPECT_TRUE(kept) << "tolerance " << tolerance << ": " << kept.error().describe();
  EXPECT_LE(report->errorBeyondRounding, fitted->cut.achievedError);
  // What is flat, or has steps of whole units, leaves less to fit.
  EXPECT_LE(fitted->cut.triangles.size(), fitted->trianglesBefore);
  RecordProperty("triangles", std::to_string(fitted->cut.triangles.size()) + " of " +
                                  std::to_string(fitted->trianglesBefore));
}

TEST_P(Promise, RestsOnAModelThatKeepsEveryLawAndIsTheSameForAnyThreads) {
  const auto field = read();
  if (!field) {
    if (!skip_.empty()) GTEST_SKIP() << skip_;
    return;
  }
  if (!isFull() && field->size() > kMedium)
    GTEST_SKIP() << "laws and threads on a DEM of more than 400 000 samples run with ./dev test --full";
  BuildOptions options;
  options.shape = GetParam().shape;
  const test::TemporaryFolder folder;
  std::string first;
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    const auto model = build(*field, options, context);
    ASSERT_TRUE(model) << model.error().describe();
    const std::string path = folder.file("model.amt");
    const Status written = writeAmt(path, *model);
    ASSERT_TRUE(written) << written.error().describe();
    std::ifstream file(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (threads == 1) {
      first = std::move(bytes);
      const Status lawful = validateModel(*model, {.randomFronts = isFull() ? 12u : 3u, .seed = 1});
      EXPECT_TRUE(lawful) << lawful.error().describe();
    } else {
      EXPECT_TRUE(bytes == first) << threads << " threads give other bytes than one";
    }
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const RealDem& dem : realDems())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) all.push_back({dem, shape});
  return all;
}

INSTANTIATE_TEST_SUITE_P(RealTerrain, Promise, testing::ValuesIn(cases()), [](const auto& made) {
  return std::string(made.param.dem.name) + "_" + std::string(toString(made.param.shape));
});

}  // namespace
}  // namespace arete
