// SPDX-License-Identifier: GPL-3.0-or-later
// arete extract: names, budgets, cameras, fits, rasters and certificates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using ExtractCommand = Cli;

/// Where the terrain of makeRaster() lies.
std::string place(const RasterHeightfield& field, double column, double row, const std::string& height) {
  const Vec2 p = field.georeference.toSource(column, row);
  return fmt::format("{},{}{}", p.x, p.y, height);
}

TEST_F(ExtractCommand, FitsHeightsForFewerTrianglesOrASmallerError) {
  for (const char* family : {"fractal", "nodata holes", "geographic"}) {
    SCOPED_TRACE(family);
    makeRaster("dem.tif", family, 90, 70);
    ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
    const Json plain =
        run({"extract", "dem.amt", "-o", "plain.ply", "--max-error", "3", "--json"}).json()["exports"][0];
    const Outcome fewer = run({"extract", "dem.amt", "-o", "fewer.ply", "--max-error", "3", "--fit",
                               "triangles", "--certificate", "--json"});
    ASSERT_EQ(fewer.code, 0) << fewer.err;
    const Json tin = fewer.json()["exports"][0];
    EXPECT_EQ(tin["fit"]["for"], "triangles");
    EXPECT_EQ(tin["fit"]["trianglesBefore"], plain["triangles"]);
    EXPECT_LT(double(tin["triangles"]), 0.95 * double(plain["triangles"]));
    EXPECT_EQ(tin["kept"], true);
    EXPECT_EQ(run({"measure", "fewer.ply", "dem.tif", "--expect", "3"}).code, 0);
    EXPECT_NE(read("fewer.ply").find("heights fitted"), std::string::npos);

    const Outcome level = run({"extract", "dem.amt", "-o", "level.ply", "--max-error", "3", "--fit",
                               "unbiased", "--certificate", "--json"});
    ASSERT_EQ(level.code, 0) << level.err;
    const Json unbiased = level.json()["exports"][0];
    EXPECT_EQ(unbiased["fit"]["for"], "unbiased");
    EXPECT_EQ(unbiased["triangles"], plain["triangles"]);
    EXPECT_EQ(unbiased["kept"], true);
    const Json measured = run({"measure", "level.ply", "dem.tif", "--expect", "3", "--json"}).json();
    EXPECT_LT(std::abs(double(measured["error"]["mean"])), 0.02 * 3);
    const Json certificate = Json::parse(read("level.certificate.json"));
    EXPECT_EQ(certificate["measured"]["error"]["mean"], measured["error"]["mean"]);
    EXPECT_EQ(certificate["fit"]["meanBefore"], unbiased["fit"]["meanBefore"]);
    const Json before = run({"measure", "plain.ply", "dem.tif", "--json"}).json();
    EXPECT_NEAR(double(before["error"]["mean"]), double(unbiased["fit"]["meanBefore"]), 1e-9);
    EXPECT_NE(run({"measure", "level.ply", "dem.tif"}).out.find("(TIN minus DEM)"), std::string::npos);

    const std::string budget = std::to_string(int(plain["triangles"]));
    const Outcome closer = run(
        {"extract", "dem.amt", "-o", "closer.ply", "--max-triangles", budget, "--fit", "error", "--json"});
    ASSERT_EQ(closer.code, 0) << closer.err;
    const Json same = closer.json()["exports"][0];
    EXPECT_LT(same["promisedError"], same["fit"]["errorBefore"]);
    const Json promised = same["promisedError"];
    EXPECT_EQ(run({"measure", "closer.ply", "dem.tif", "--expect", promised.dump()}).code, 0);
  }
}

TEST_F(ExtractCommand, FitsHeightsInARegionAndOnTheGrid) {
  makeRaster("dem.tif", "fractal", 80, 80);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const auto raster = readRaster(path("dem.tif"));
  ASSERT_TRUE(raster);
  const Vec2 low = raster->heightfield.georeference.toSource(20, 55),
             high = raster->heightfield.georeference.toSource(60, 25);
  const std::string box = fmt::format("{},{},{},{}", low.x, low.y, high.x, high.y);
  const Outcome region = run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "1", "--region", box,
                              "--outside-error", "20", "--fit", "triangles", "--json"});
  ASSERT_EQ(region.code, 0) << region.err;
  EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--expect", "1", "--region", box}).code, 0);
  EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--expect", "20"}).code, 0);

  const Outcome grid = run({"extract", "dem.amt", "-o", "smooth.tif", "--max-error", "2", "--fit",
                            "triangles", "--certificate", "--json"});
  ASSERT_EQ(grid.code, 0) << grid.err;
  EXPECT_EQ(grid.json()["exports"][0]["kept"], true);
  const std::string check = readJson("smooth.certificate.json")["check"];
  EXPECT_NE(check.find("--fit triangles"), std::string::npos) << check;
}

TEST_F(ExtractCommand, NamesTheOutputsOfSeveralTolerances) {
  makeRaster("dem.tif", "fractal", 40, 40);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Outcome outcome = run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "1,2.5,20",
                               "--certificate", "--error-raster", "e{}.tif", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"tin_1.ply", "tin_2.5.ply", "tin_20.ply", "tin_1.certificate.json", "e1.tif",
                           "e2.5.tif", "tin_2.5.certificate.json"})
    EXPECT_TRUE(exists(name)) << name;
  const Json exports = outcome.json()["exports"];
  ASSERT_EQ(exports.size(), 3u);
  EXPECT_EQ(exports[1]["file"], "tin_2.5.ply");
  EXPECT_GT(exports[0]["triangles"], exports[1]["triangles"]);
  EXPECT_GE(exports[1]["triangles"], exports[2]["triangles"]);
}

TEST_F(ExtractCommand, WritesToStdoutInTheFormatStated) {
  makeRaster("dem.tif", "fractal", 40, 40);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  for (const std::string format : {"ply", "stl", "off"}) {
    ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin." + format, "--max-error", "2"}).code, 0);
    const Outcome piped = run(
        {"extract", "dem.amt", "-o", "-", "--format", format, "--max-error", "2", "--certificate", "c.json"});
    EXPECT_EQ(piped.code, 0) << piped.err;
    EXPECT_TRUE(piped.out == read("tin." + format)) << format;
    EXPECT_NE(piped.err.find("triangles"), std::string::npos) << piped.err;
    EXPECT_FALSE(readJson("c.json").is_discarded());
  }
  const Outcome json =
      run({"extract", "dem.amt", "-o", "-", "--format", "off", "--max-error", "2", "--json"});
  EXPECT_TRUE(json.out == read("tin.off"));
  EXPECT_FALSE(Json::parse(json.err, nullptr, false).is_discarded());
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "-", "--format", "ply", "--max-error", "1,2"}).code, 2);
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "-", "--max-error", "1"}).code, 2);
  EXPECT_EQ(
      run({"extract", "dem.amt", "-o", "-", "--format", "ply", "--max-error", "2", "--certificate"}).code, 2);
}

TEST_F(ExtractCommand, PutsTheToleranceWhereverTheNameAsksForIt) {
  makeRaster("dem.tif", "fractal", 30, 30);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  std::filesystem::create_directory(path("5"));
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "{}/{}m.obj", "--max-error", "5"}).code, 0);
  EXPECT_TRUE(exists("5/5m.obj"));
}

TEST_F(ExtractCommand, CertificateAgreesWithMeasure) {
  makeRaster("dem.tif", "nodata holes", 60, 50);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Outcome extracted =
      run({"extract", "dem.amt", "-o", "tin.obj", "--max-error", "3", "--certificate", "proof.json"});
  ASSERT_EQ(extracted.code, 0) << extracted.err;
  const Json certificate = readJson("proof.json");
  ASSERT_FALSE(certificate.is_discarded()) << read("proof.json");
  const Outcome measured = run({"measure", "tin.obj", "dem.tif", "--expect", "3", "--json"});
  ASSERT_EQ(measured.code, 0) << measured.err;
  const Json report = measured.json();
  EXPECT_EQ(certificate["measured"]["error"], report["error"]);
  EXPECT_EQ(certificate["measured"]["samples"], report["samples"]);
  EXPECT_EQ(certificate["measured"]["triangles"], report["triangles"]);
  EXPECT_EQ(certificate["source"]["checksum"], report["dem"]["checksum"]);
  EXPECT_EQ(certificate["promise"]["kept"], true);
  EXPECT_EQ(certificate["criterion"]["maxError"], 3.0);
  EXPECT_EQ(certificate["check"], "arete measure tin.obj dem.tif --expect 3");
  EXPECT_EQ(report["samples"]["nodataCovered"], 0);
}

TEST_F(ExtractCommand, SpendsABudget) {
  makeRaster("dem.tif", "fractal", 80, 80);
  const Json built = run({"build", "dem.tif", "-o", "dem.amt", "--json"}).json();
  const Outcome outcome =
      run({"extract", "dem.amt", "-o", "tin.ply", "--max-triangles", "2000", "--certificate", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json tin = outcome.json()["exports"][0];
  EXPECT_LE(tin["triangles"], 2000);
  EXPECT_GE(tin["triangles"], 1990);
  const Json promised = tin["promisedError"];
  EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--expect", promised.dump()}).code, 0);

  const std::uint64_t root = built["rootTriangles"];
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "root.ply", "--max-triangles", std::to_string(root)}).code, 0);
  const Outcome tooFew =
      run({"extract", "dem.amt", "-o", "few.ply", "--max-triangles", std::to_string(root - 1)});
  EXPECT_EQ(tooFew.code, 2);
  EXPECT_NE(tooFew.err.find(std::to_string(root) + " of the root"), std::string::npos) << tooFew.err;
  EXPECT_FALSE(exists("few.ply"));
}

TEST_F(ExtractCommand, SamplesTheTinBackOnTheSourceGrid) {
  makeRaster("dem.tif", "nodata holes", 60, 50);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Outcome outcome =
      run({"extract", "dem.amt", "-o", "smooth.tif", "--max-error", "2", "--error-raster", "error.tif"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto dem = readRaster(path("dem.tif")), smooth = readRaster(path("smooth.tif")),
             error = readRaster(path("error.tif"));
  ASSERT_TRUE(dem && smooth && error);
  EXPECT_EQ(smooth->heightfield.georeference.geoTransform, dem->heightfield.georeference.geoTransform);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < dem->heightfield.size(); ++i) {
    const double z = dem->heightfield.heights[i], tin = smooth->heightfield.heights[i];
    if (std::isnan(z) || std::isnan(tin)) continue;
    ++compared;
    EXPECT_LE(std::abs(tin - z), 2.001);
    EXPECT_NEAR(error->heightfield.heights[i], tin - z, 2e-3);
  }
  EXPECT_GT(compared, 1000u);
}

TEST_F(ExtractCommand, SaysInWordsThatThePixelsOfACoarseCutAreNotKnown) {
  makeRaster("dem.tif", "fractal", 60, 60);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const RasterHeightfield field = readRaster(path("dem.tif"))->heightfield;
  const Outcome o = run(
      {"extract", "dem.amt", "-o", "t.ply", "--camera=" + place(field, 30, 30, ",2"), "--deadline", "1e-6"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("pixel error unknown around the camera"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("inf"), std::string::npos) << o.out;
}

TEST_F(ExtractCommand, ReplacesNoFileByACertificateThatIsNone) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  write("notes.txt", "x,y,z\n1,2,3\n");
  const std::vector<std::string> words = {"extract",     "dem.amt", "-o",           "t.ply",
                                          "--max-error", "5",       "--certificate"};
  const auto with = [&](const std::string& name) {
    std::vector<std::string> all = words;
    all.push_back(name);
    return run(all);
  };
  const Outcome refused = with("notes.txt");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("notes.txt: exists and holds something other than"), std::string::npos)
      << refused.err;
  EXPECT_EQ(read("notes.txt"), "x,y,z\n1,2,3\n");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(with("kept.txt").code, 0) << i;
}

TEST_F(ExtractCommand, SaysInTheCertificateHowTheDemWasRead) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "DEM.AMT", "--band", "1", "--nodata", "-9999"}).code, 0);
  ASSERT_EQ(run({"convert", "DEM.AMT", "-o", "small.AMT", "--packed"}).code, 0);
  for (const char* model : {"DEM.AMT", "small.AMT"}) {
    const Outcome outcome =
        run({"extract", model, "-o", "tin.ply", "--max-error", "5", "--certificate", "c.json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(readJson("c.json")["check"],
              "arete measure tin.ply dem.tif --expect 5 --band 1 --nodata -9999");
  }
}

}  // namespace
}  // namespace arete::cli_test
