// SPDX-License-Identifier: GPL-3.0-or-later
// The main job: a DEM in, one multitriangulation, any tolerance out, with proof.
#include <fmt/format.h>

#include <cmath>

#include "cli/cli_fixture.h"
#include "io/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using MainJob = Cli;

TEST_F(MainJob, BuildsExtractsAndKeepsThePromise) {
  makeRaster("dem.tif", "fractal", 90, 70);
  const Outcome built = run({"build", "dem.tif", "-o", "dem.amt"});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_NE(built.out.find("6 300"), std::string::npos) << built.out;
  EXPECT_EQ(built.err, "");

  const Outcome extracted = run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "5"});
  ASSERT_EQ(extracted.code, 0) << extracted.err;
  const Outcome measured = run({"measure", "tin.ply", "dem.tif", "--expect", "5"});
  EXPECT_EQ(measured.code, 0) << measured.err;
  EXPECT_NE(measured.out.find("kept"), std::string::npos) << measured.out;
  EXPECT_EQ(files(), (std::set<std::string>{"dem.amt", "dem.tif", "tin.ply"}));
}

TEST_F(MainJob, HoldsOnEveryFamilyBothShapesAndBothMethods) {
  const bool isFull = std::getenv("ARETE_FULL") != nullptr;
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    makeRaster("dem.tif", family.name, isFull ? 150 : 31, isFull ? 120 : 27);
    for (const std::string shape : {"delaunay", "fidelity"}) {
      SCOPED_TRACE(shape);
      const Outcome built = run({"build", "dem.tif", "-o", "dem.amt", "--shape", shape, "-q"});
      ASSERT_EQ(built.code, 0) << built.err;
      if (isFull) {
        const Outcome valid = run({"validate", "dem.amt", "--fronts", "20"});
        EXPECT_EQ(valid.code, 0) << valid.err;
      }
      for (const std::string method : {"minimal", "saturated"}) {
        SCOPED_TRACE(method);
        const Outcome extracted =
            run({"extract", "dem.amt", "-o", "tin_{}.ply", "--max-error", "0,0.5,7", "--method", method});
        ASSERT_EQ(extracted.code, 0) << extracted.err;
        for (const std::string error : {"0", "0.5", "7"}) {
          const Outcome measured = run({"measure", "tin_" + error + ".ply", "dem.tif", "--expect", error});
          EXPECT_EQ(measured.code, 0) << error << ": " << measured.err;
        }
      }
    }
  }
}

TEST_F(MainJob, FitsHeightsForFewerTrianglesOrASmallerError) {
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

TEST_F(MainJob, FitsHeightsInARegionAndOnTheGrid) {
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

TEST_F(MainJob, LetsNoFileTalkToTheTerminal) {
  makeRaster("dem.tif", "fractal", 8, 8);
  write("tin.ply",
        "ply\nformat ascii 1.0\ncomment vertical_unit \x1b]0;title\x07\nelement vertex 3\nproperty double x\n"
        "property double y\nproperty double z\nelement face 1\nproperty list uchar uint vertex_indices\n"
        "end_header\n-900 -900 0\n900 -900 0\n0 900 0\n3 0 1 2\n");
  const Outcome measured = run({"measure", "tin.ply", "dem.tif"});
  const Outcome missing = run({"measure", "\x1b[2J.ply", "dem.tif"});
  EXPECT_EQ((measured.out + measured.err + missing.err).find('\x1b'), std::string::npos);
  EXPECT_NE(missing.err.find("?[2J.ply"), std::string::npos) << missing.err;
}

TEST_F(MainJob, NamesTheOutputsOfSeveralTolerances) {
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

TEST_F(MainJob, PutsTheToleranceWhereverTheNameAsksForIt) {
  makeRaster("dem.tif", "fractal", 30, 30);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  std::filesystem::create_directory(path("5"));
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "{}/{}m.obj", "--max-error", "5"}).code, 0);
  EXPECT_TRUE(exists("5/5m.obj"));
}

TEST_F(MainJob, SaysWhenStdoutTakesNothing) {
  makeRaster("dem.tif", "fractal", 30, 30);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  const std::string command = std::string(ARETE_PROGRAM) + " height " + path("dem.amt") + " --points " +
                              write("places.csv",
                                    [] {
                                      std::string rows = "x,y\n";
                                      for (int i = 0; i < 20'000; ++i) rows += "3,-3\n";
                                      return rows;
                                    }()) +
                              " > /dev/full 2> " + path("said");
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_NE(read("said").find("stdout cannot be written to"), std::string::npos) << read("said");
}

TEST_F(MainJob, CertificateAgreesWithMeasure) {
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

TEST_F(MainJob, SpendsABudget) {
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

TEST_F(MainJob, SamplesTheTinBackOnTheSourceGrid) {
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

TEST_F(MainJob, TakesScatteredPoints) {
  std::string text = "x,y,z\n";
  const PointHeightfield points = pointFamilies().front().make(400, 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{},{},{}\n", points.positions[i].x, points.positions[i].y, points.heights[i]);
  write("points.csv", text);
  const Outcome built = run({"build", "points.csv", "-o", "p.amt", "--crs", "EPSG:32611"});
  ASSERT_EQ(built.code, 0) << built.err;
  ASSERT_EQ(run({"extract", "p.amt", "-o", "p.ply", "--max-error", "1", "--certificate"}).code, 0);
  const Outcome measured =
      run({"measure", "p.ply", "points.csv", "--crs", "EPSG:32611", "--expect", "1", "--json"});
  ASSERT_EQ(measured.code, 0) << measured.err;
  const Json found = measured.json()["error"],
             certified = readJson("p.certificate.json")["measured"]["error"];
  EXPECT_EQ(found["maximum"], certified["maximum"]);
  EXPECT_EQ(found["worst"]["x"], certified["worst"]["x"]);
  EXPECT_FALSE(certified["worst"].contains("point")) << "a model numbers its points in its own way";
  const Outcome noGrid = run({"extract", "p.amt", "-o", "p.tif", "--max-error", "1"});
  EXPECT_EQ(noGrid.code, 2);
  EXPECT_NE(noGrid.err.find("scattered points"), std::string::npos) << noGrid.err;
}

TEST_F(MainJob, KeepsFeaturesAndFixedPointsInTheRoot) {
  makeRaster("dem.tif", "fractal", 60, 60);
  const auto raster = readRaster(path("dem.tif"));
  ASSERT_TRUE(raster);
  const Vec2 p = raster->heightfield.georeference.toSource(17.3, 22.8);
  write("fixed.csv", fmt::format("x,y\n{},{}\n{},{}\n", p.x, p.y, p.x + 1e7, p.y));
  const Outcome built = run(
      {"build", "dem.tif", "-o", "dem.amt", "--no-features", "--fixed", "fixed.csv", "--json", "--progress"});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(built.json()["features"], 0);
  EXPECT_EQ(built.json()["given"], 1);
  EXPECT_EQ(built.json()["fixedVertices"], 1);
  EXPECT_NE(built.err.find("1 of 2 points lie beside"), std::string::npos) << built.err;
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "root.obj", "--max-error", "inf"}).code, 0);
  const Vec2 snapped = raster->heightfield.georeference.toSource(17, 23);
  EXPECT_NE(read("root.obj").find(fmt::format("v {} {} ", snapped.x, snapped.y)), std::string::npos);

  EXPECT_EQ(run({"build", "dem.tif", "-o", "a.amt", "--features", "10", "--json"}).json()["features"], 10);
  const Json creased = run({"build", "dem.tif", "-o", "a.amt", "--crease-angle", "10", "--json"}).json();
  EXPECT_GT(creased["creaseVertices"], 0);
  EXPECT_GE(creased["rootVertices"], creased["fixedVertices"]);
}

TEST_F(MainJob, TellsTheCurve) {
  makeRaster("dem.tif", "fractal", 70, 70);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Json info = run({"info", "dem.amt", "--json"}).json();
  ASSERT_FALSE(info.is_discarded());
  EXPECT_EQ(info["samples"], 4900);
  EXPECT_EQ(info["finestTriangles"], 2 * 69 * 69);
  const Json curve = info["curve"];
  ASSERT_GT(curve.size(), 3u);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_LE(curve[i]["minimal"], curve[i]["saturated"]);
    if (i == 0) continue;
    EXPECT_LE(curve[i]["minimal"], curve[i - 1]["minimal"]);
    EXPECT_GT(curve[i]["maxError"], curve[i - 1]["maxError"]);
  }
  const Json at = run({"info", "dem.amt", "--json", "--at", "4"}).json()["curve"];
  ASSERT_EQ(at.size(), 1u);
  for (const std::string method : {"minimal", "saturated"}) {
    const Json tin =
        run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "4", "--method", method, "--json"})
            .json()["exports"][0];
    EXPECT_EQ(tin["triangles"], at[0][method]) << method;
  }
  EXPECT_NE(run({"info", "dem.amt"}).out.find("(finest)"), std::string::npos);
}

TEST_F(MainJob, ValidatesAndNamesWhatIsBroken) {
  makeRaster("dem.tif", "fractal", 40, 40);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Outcome valid = run({"validate", "dem.amt"});
  EXPECT_EQ(valid.code, 0) << valid.err;
  EXPECT_NE(valid.out.find("law 9  holds"), std::string::npos) << valid.out;
  EXPECT_EQ(run({"validate", "dem.amt", "--json"}).json()["holds"], true);

  std::string bytes = read("dem.amt");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  write("altered.amt", bytes);
  EXPECT_EQ(run({"validate", "altered.amt"}).code, 4);
  write("short.amt", bytes.substr(0, bytes.size() / 2));
  for (const char* command : {"validate", "info"}) {
    const Outcome cut = run({command, "short.amt"});
    EXPECT_TRUE(cut.code == 3 || cut.code == 4) << cut.code;
    EXPECT_NE(cut.err.find("short.amt"), std::string::npos) << cut.err;
  }
}

TEST_F(MainJob, GivesTheSameBytesForAnyNumberOfThreads) {
  makeRaster("dem.tif", "nodata holes", 120, 100);
  for (const std::string threads : {"1", "2", "4"})
    ASSERT_EQ(run({"build", "dem.tif", "-o", threads + ".amt", "--threads", threads}).code, 0);
  EXPECT_EQ(read("1.amt"), read("2.amt"));
  EXPECT_EQ(read("1.amt"), read("4.amt"));
}

/// Where the terrain of makeRaster() lies.
std::string place(const RasterHeightfield& field, double column, double row, const std::string& height) {
  const Vec2 p = field.georeference.toSource(column, row);
  return fmt::format("{},{}{}", p.x, p.y, height);
}

TEST_F(MainJob, ServesACameraAPlaceABudgetAndADeadline) {
  makeRaster("dem.tif", "fractal", 90, 70);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const RasterHeightfield field = readRaster(path("dem.tif"))->heightfield;
  const std::string camera = "--camera=" + place(field, 5, 60, ",20agl");
  const auto triangles = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"extract", "dem.amt", "-o", "t.ply", "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json()["exports"][0];
  };
  const Json fine = triangles({camera, "--look", "45,-10", "--pixel-error", "0.5"});
  const Json coarse = triangles({camera, "--look", "45,-10", "--pixel-error", "20"});
  EXPECT_GT(fine["triangles"], coarse["triangles"]);
  const Json inOne = triangles({camera + ",45,-10,60", "--pixel-error", "0.5"});
  EXPECT_EQ(fine["triangles"], inOne["triangles"]) << "the camera in one option";
  EXPECT_LE(fine["pixels"], 0.5);
  EXPECT_LE(coarse["pixels"], 20);
  const Json budget = triangles({camera, "--max-triangles", "1500", "--order", "two-queues"});
  EXPECT_LE(budget["triangles"], 1500);
  EXPECT_EQ(budget["complete"], false);
  const Json focus =
      triangles({"--max-error", "0.1", "--focus=" + place(field, 30, 30, ""), "--error-growth", "1"});
  EXPECT_LT(focus["triangles"], triangles({"--max-error", "0.1"})["triangles"]);
  const Json soon = triangles({"--max-error", "0", "--deadline", "1e6", "--order", "depth"});
  EXPECT_EQ(soon["triangles"], triangles({"--max-error", "0"})["triangles"]);
  EXPECT_EQ(soon["complete"], true);
}

TEST_F(MainJob, SaysInWordsThatThePixelsOfACoarseCutAreNotKnown) {
  makeRaster("dem.tif", "fractal", 60, 60);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const RasterHeightfield field = readRaster(path("dem.tif"))->heightfield;
  const Outcome o = run(
      {"extract", "dem.amt", "-o", "t.ply", "--camera=" + place(field, 30, 30, ",2"), "--deadline", "1e-6"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("its pixels around the camera's eye not known"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("inf"), std::string::npos) << o.out;
}

TEST_F(MainJob, RefusesCriteriaThatContradictEachOther) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const auto refused = [&](const std::vector<std::string>& options, const std::string& names) {
    std::vector<std::string> arguments = {"extract", "dem.amt", "-o", "t.ply"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(names), std::string::npos) << outcome.err;
    EXPECT_FALSE(exists("t.ply"));
  };
  refused({}, "--deadline");
  refused({"--max-error", "1", "--camera", "1,2,3"}, "--camera");
  refused({"--camera=0,0,3msl,4,5", "--look", "6,7"}, "--look 6,7");
  refused({"--camera=0,0,3msl,4,5,60", "--fov", "50"}, "--fov");
  refused({"--max-error", "1", "--focus", "1,2"}, "--error-growth");
  refused({"--max-error", "1", "--distance", "4"}, "--region");
  refused({"--max-error", "1", "--order", "depth"}, "--order");
  refused({"--max-error", "1", "--deadline", "5", "--method", "saturated"}, "--deadline");
  refused({"--max-triangles", "500", "--order", "two-queues"}, "--camera");
  refused({"--max-error", "1", "--outside-error", "5"}, "--outside-error");
  refused({"--max-error", "1", "--lonlat"}, "--lonlat");
  refused({"--pixel-error", "1", "--max-error", "1"}, "--camera");
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "t.ply", "--camera=-99999999,2,3"}).code, 4)
      << "above no terrain";
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "t.tif", "--deadline", "5"}).code, 2) << "cannot be repeated";
}

TEST_F(MainJob, SaysInTheCertificateHowTheDemWasRead) {
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

TEST_F(MainJob, TakesOnlyWholePixels) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Outcome outcome =
      run({"extract", "dem.amt", "-o", "tin.ply", "--camera", "500100,5199900,100", "--viewport", "10.5x3"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--viewport 10.5x3: is not of whole pixels"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace arete::cli_test
