// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "cli/cli_fixture.h"
#include "io/formats/exchange/mesh_formats.h"

namespace arete::cli_test {
namespace {

/// A unit square at height z, as a program that is not ours would write it: a quadrilateral.
std::string square(double size, double z) {
  const std::string s = std::to_string(size), h = std::to_string(z);
  return "v 0 0 " + h + "\nv " + s + " 0 " + h + "\nv " + s + " " + s + " " + h + "\nv 0 " + s + " " + h +
         "\nf 1 2 3 4\n";
}

class MeasureMeshes : public Cli {};

TEST_F(MeasureMeshes, TellsDistancesBothWays) {
  write("a.obj", square(3, 0));
  write("b.obj", square(3, 4));
  const Outcome outcome = run({"measure", "a.obj", "b.obj", "--samples", "5000"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* said : {"from the first", "both ways", "RMS / diagonal", "0.942809", "5 000", "seed 1"})
    EXPECT_NE(outcome.out.find(said), std::string::npos) << said << " in\n" << outcome.out;
  EXPECT_EQ(outcome.err, "");

  const Json json = run({"measure", "a.obj", "b.obj", "--samples", "5000", "--seed", "9", "--json"}).json();
  ASSERT_FALSE(json.is_discarded());
  EXPECT_EQ(json["first"]["path"], "a.obj");
  EXPECT_EQ(json["first"]["triangles"], 2);
  EXPECT_EQ(json["second"]["area"], 9);
  EXPECT_EQ(json["fromFirst"]["maximum"], 4);
  EXPECT_EQ(json["fromSecond"]["samples"], 5000);
  EXPECT_NEAR(json["bothWays"]["rms"], 4, 1e-12);
  EXPECT_NEAR(json["ofDiagonal"]["mean"], 4 / std::sqrt(18), 1e-12);
  EXPECT_EQ(json["seed"], 9);
  EXPECT_FALSE(json.contains("kept"));
}

TEST_F(MeasureMeshes, ChecksAPromise) {
  write("a.obj", square(1, 0));
  write("b.obj", square(2, 0));
  const Outcome kept = run({"measure", "a.obj", "b.obj", "--samples", "100", "--expect", "1.5"});
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_NE(kept.out.find("kept: nowhere farther than 1.5"), std::string::npos) << kept.out;
  const Outcome broken = run({"measure", "a.obj", "b.obj", "--samples", "100", "--expect", "1.4", "--json"});
  EXPECT_EQ(broken.code, 5);
  EXPECT_EQ(broken.json()["kept"], false);
  EXPECT_NE(broken.err.find("more than 1.4"), std::string::npos) << broken.err;
}

TEST_F(MeasureMeshes, APromiseIsAboutTheSecondMeshUnlessBothWaysAreAskedFor) {
  write("small.obj", square(1, 0));
  write("large.obj", square(2, 0));
  // No point of the small square is off the large one; a corner of the large one is far from the small one.
  const auto code = [&](const char* first, const char* second, const char* expect, bool bothWays) {
    std::vector<std::string> words = {"measure", first, second, "--samples", "100", "--expect", expect, "-q"};
    if (bothWays) words.push_back("--both-ways");
    return run(words).code;
  };
  EXPECT_EQ(code("large.obj", "small.obj", "0", false), 0);
  EXPECT_EQ(code("large.obj", "small.obj", "0", true), 5);
  EXPECT_EQ(code("small.obj", "large.obj", "1", false), 5);
  EXPECT_EQ(code("small.obj", "large.obj", "1.5", false), 0);
  // Of the second's diagonal: the square root of 8, and of 2.
  EXPECT_EQ(code("small.obj", "large.obj", "51%", false), 0);
  EXPECT_EQ(code("small.obj", "large.obj", "49%", false), 5);
  EXPECT_EQ(code("large.obj", "small.obj", "99%", true), 5);
  EXPECT_EQ(code("large.obj", "small.obj", "101%", true), 0);
  const Json json =
      run({"measure", "large.obj", "small.obj", "--samples", "100", "--expect", "10%", "--json"}).json();
  EXPECT_EQ(json["expectOf"], "fromSecond");
  EXPECT_DOUBLE_EQ(json["expect"], std::sqrt(2.0) / 10);
  EXPECT_NEAR(json["expectPercent"].get<double>(), 10, 1e-9);
  makeRaster("dem.tif", "fractal", 9, 9);
  EXPECT_EQ(run({"measure", "small.obj", "dem.tif", "--both-ways"}).code, 2);
}

TEST_F(MeasureMeshes, WritesTheFirstMeshWithADistancePerVertex) {
  write("a.obj", square(1, 0));
  write("b.obj", square(1, 2));
  const Outcome outcome =
      run({"measure", "a.obj", "b.obj", "--samples", "100", "--error-mesh", "distances.ply"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string bytes = read("distances.ply");
  EXPECT_NE(bytes.find("property float quality\nproperty uchar red\n"), std::string::npos);
  const auto mesh = readMesh(path("distances.ply"));
  ASSERT_TRUE(mesh) << mesh.error().describe();
  EXPECT_EQ(mesh->mesh.positions.size(), 4u);
  EXPECT_EQ(mesh->mesh.triangles.size(), 2u);
  // Of the first vertex: x, y, z as doubles, then its quality.
  const std::size_t begin = bytes.find("end_header\n") + 11;
  float quality = 0;
  std::memcpy(&quality, bytes.data() + begin + 24, sizeof quality);
  EXPECT_EQ(quality, 2);

  EXPECT_EQ(run({"measure", "a.obj", "b.obj", "--error-mesh", "distances.obj"}).code, 2);
  EXPECT_EQ(run({"measure", "a.obj", "b.obj", "--error-mesh", "no/such.ply"}).code, 3);
  const Outcome own = run({"measure", "distances.ply", "b.obj", "--error-mesh", "distances.ply"});
  EXPECT_EQ(own.code, 2);
  EXPECT_NE(own.err.find("is an input"), std::string::npos) << own.err;
  EXPECT_EQ(read("distances.ply"), bytes);
}

TEST_F(MeasureMeshes, RefusesWhatMakesNoSense) {
  write("a.obj", square(1, 0));
  write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const auto refused = [&](std::vector<std::string> arguments, int code, const char* said) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  refused({"measure", "a.obj", "none.obj"}, 3, "none.obj");
  refused({"measure", "none.ply", "a.obj"}, 3, "none.ply");
  refused({"measure", "a.obj", "line.obj"}, 4, "line.obj: holds no triangle that has area");
  refused({"measure", "line.obj", "a.obj"}, 4, "line.obj: holds no triangle that has area");
  refused({"measure", "a.obj", "a.obj", "--samples", "0"}, 2, "--samples");
  refused({"measure", "a.obj", "a.obj", "--seed", "-1"}, 2, "--seed");
  refused({"measure", "a.obj", "a.obj", "--expect", "-1"}, 2, "--expect");
  refused({"measure", "a.obj", "a.obj", "--region", "0,0,1,1"}, 2,
          "--region: requires a DEM, and a.obj is a mesh");
  refused({"measure", "a.obj", "a.obj", "--error-raster", "e.tif"}, 2, "--error-raster");
  refused({"measure", "a.obj", "a.obj", "--allow-covered-nodata"}, 2, "--allow-covered-nodata");
  refused({"measure", "a.obj", "a.obj", "--nodata", "3"}, 2, "--nodata");
  makeRaster("dem.tif", "fractal", 20, 20);
  refused({"measure", "a.obj", "dem.tif", "--samples", "5"}, 2,
          "--samples: requires another mesh, and dem.tif is a DEM");
  refused({"measure", "a.obj", "dem.tif", "--error-mesh", "e.ply"}, 2, "--error-mesh");
}

TEST_F(MeasureMeshes, WarnsAboutFramesThatDoNotCompare) {
  const std::string a = square(1, 0);
  write("degrees.obj", "# crs EPSG:4326\n" + a);
  write("utm.obj", "# crs EPSG:32611\n" + a);
  write("other.obj", "# crs EPSG:32612\n" + a);
  EXPECT_NE(run({"measure", "degrees.obj", "degrees.obj", "--samples", "10"}).err.find("are degrees"),
            std::string::npos);
  const Outcome mixed = run({"measure", "degrees.obj", "utm.obj"});
  EXPECT_EQ(mixed.code, 4);
  EXPECT_NE(mixed.err.find("degrees.obj: its x and y are degrees"), std::string::npos) << mixed.err;
  EXPECT_NE(run({"measure", "utm.obj", "other.obj", "--samples", "10"}).err.find("as if they were in one"),
            std::string::npos);
  EXPECT_EQ(run({"measure", "utm.obj", "utm.obj", "--samples", "10"}).err, "");
}

TEST_F(MeasureMeshes, ComparesDegreesInMetres) {
  // A degree of latitude is 111 km, and of longitude half as much at 60 degrees north.
  const auto strip = [](double x, double y, double z) {
    std::string text = "# crs EPSG:4326\n";
    for (const double dy : {0.0, 0.001})
      for (const double dx : {0.0, 0.001})
        text += "v " + std::to_string(x + dx) + " " + std::to_string(y + dy) + " " + std::to_string(z) + "\n";
    return text + "f 1 2 4\nf 1 4 3\n";
  };
  write("a.obj", strip(10, 60, 100));
  write("up.obj", strip(10, 60, 103));
  write("east.obj", strip(10.0005, 60, 100));
  const auto maximum = [&](const std::string& other) {
    const Outcome outcome = run({"measure", "a.obj", other, "--samples", "1000", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["unit"], "metre");
    EXPECT_NEAR(json["fromFirst"]["worst"][1].get<double>(), 60, 0.01) << json.dump(2);
    return json["fromFirst"]["maximum"].get<double>();
  };
  EXPECT_NEAR(maximum("up.obj"), 3, 1e-6);
  EXPECT_NEAR(maximum("east.obj"), 0.0005 * 55'800, 0.1);
}

TEST_F(MeasureMeshes, TakesEveryFormat) {
  makeRaster("dem.tif", "fractal", 40, 40);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  for (const MeshFormat& format : meshFormats()) {
    SCOPED_TRACE(format.name);
    const std::string name = "tin" + std::string(format.extension);
    if (!format.read || !format.write) continue;
    ASSERT_EQ(run({"extract", "dem.amt", "-o", name, "--max-error", "5"}).code, 0);
    const Outcome outcome = run({"measure", name, "tin.ply", "--samples", "500", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_LT(outcome.json()["bothWays"]["maximum"], format.holds.isExact ? 1e-6 : 0.1);
    EXPECT_EQ(run({"measure", "tin.ply", name, "--samples", "500"}).code, 0);
  }
  write("points.csv", "x,y,z\n0,0,1\n1,0,2\n0,1,3\n");
  const Outcome points = run({"measure", "tin.ply", "points.csv", "--samples", "5"});
  EXPECT_NE(points.err.find("points.csv is a DEM"), std::string::npos) << points.err;
}

TEST_F(MeasureMeshes, GivesTheSameTextForAnyNumberOfThreads) {
  makeRaster("dem.tif", "fractal", 60, 60);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "0,5"}).code, 0);
  const auto measured = [&](const char* threads) {
    return run({"measure", "tin_5.ply", "tin_0.ply", "--samples", "20000", "--json", "--threads", threads})
        .out;
  };
  const std::string one = measured("1");
  EXPECT_NE(one.find("bothWays"), std::string::npos);
  EXPECT_EQ(measured("2"), one);
  EXPECT_EQ(measured("4"), one);
}

}  // namespace
}  // namespace arete::cli_test
