// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes from one format into another, as far as the formats can say what there is to say.
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "cli/cli_fixture.h"
#include "io/formats/exchange/mesh_formats.h"

namespace arete::cli_test {
namespace {

using Convert = Cli;

TEST_F(Convert, CarriesAMeshThroughEveryFormatAndKeepsThePromise) {
  makeRaster("dem.tif", "geographic", 40, 33);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "5"}).code, 0);
  const Outcome direct = run({"measure", "tin.ply", "dem.tif", "--json"});
  for (const MeshFormat& format : meshFormats()) {
    SCOPED_TRACE(format.name);
    const std::string there = "there" + std::string(format.extension);
    const Outcome converted = run({"convert", "tin.ply", "-o", there});
    ASSERT_EQ(converted.code, 0) << converted.err;
    EXPECT_EQ(converted.err.find("cannot hold") == std::string::npos,
              format.holds.isExact && format.holds.holdsCrs && format.holds.holdsVerticalUnit &&
                  format.holds.holdsErrors)
        << converted.err;
    EXPECT_EQ(converted.err.find("x and y are degrees") != std::string::npos,
              format.name == "PLY" || format.name == "OBJ" || format.name == "OFF" || format.name == "STL")
        << converted.err;
    const Outcome measured = run({"measure", there, "dem.tif", "--json", "--expect", "5.01"});
    EXPECT_EQ(measured.code, 0) << measured.err;
    EXPECT_NEAR(measured.json()["error"]["maximum"].get<double>(),
                direct.json()["error"]["maximum"].get<double>(), format.holds.isExact ? 0 : 1e-3);
    const Outcome back = run({"convert", there, "-o", "back.ply"});
    ASSERT_EQ(back.code, 0) << back.err;
    const Result<MeshFile> mesh = readMesh(path("back.ply"));
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->crsWkt.empty(), !format.holds.holdsCrs);
    EXPECT_EQ(mesh->triangleErrors.empty(), !format.holds.holdsErrors);
  }
}

TEST_F(Convert, SaysInOneLineWhatIsLost) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "--crs", "EPSG:32611"}).code, 0);
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "5"}).code, 0);
  const Outcome lossy = run({"convert", "tin.ply", "-o", "tin.stl", "--json"});
  EXPECT_EQ(lossy.code, 0) << lossy.err;
  EXPECT_NE(lossy.err.find("STL cannot hold the CRS"), std::string::npos) << lossy.err;
  EXPECT_NE(lossy.err.find("the error of each triangle"), std::string::npos) << lossy.err;
  EXPECT_EQ(std::count(lossy.err.begin(), lossy.err.end(), '\n'), 1);
  EXPECT_EQ(lossy.json()["lost"][0], "the CRS");
  EXPECT_EQ(run({"convert", "tin.ply", "-o", "tin.gpkg"}).err, "");
  // STL forgets the CRS; --crs says it again.
  const Outcome stated = run({"convert", "tin.stl", "-o", "tin.glb", "--crs", "EPSG:32611"});
  EXPECT_EQ(stated.code, 0) << stated.err;
  EXPECT_EQ(stated.err, "");
  EXPECT_NE(readMesh(path("tin.glb"))->crsWkt.find("32611"), std::string::npos);
  const Outcome replaced = run({"convert", "tin.ply", "-o", "other.ply", "--crs", "EPSG:4326"});
  EXPECT_NE(replaced.err.find("is replaced"), std::string::npos) << replaced.err;
}

TEST_F(Convert, WritesToStdoutAndToAPipeInTheFormatStated) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "5"}).code, 0);
  for (const MeshFormat& format : meshFormats()) {
    const std::string extension(format.extension), name = extension.substr(1);
    SCOPED_TRACE(name);
    if (name == "gpkg") {
      const Outcome refused = run({"convert", "tin.ply", "-o", "-", "--format", name});
      EXPECT_EQ(refused.code, 3) << refused.err;
      EXPECT_NE(refused.err.find("database"), std::string::npos) << refused.err;
      continue;
    }
    ASSERT_EQ(run({"convert", "tin.ply", "-o", "file" + extension}).code, 0);
    const Outcome piped = run({"convert", "tin.ply", "-o", "-", "--format", name});
    EXPECT_EQ(piped.code, 0) << piped.err;
    EXPECT_TRUE(piped.out == read("file" + extension));
    EXPECT_NE(piped.err.find("triangles"), std::string::npos) << piped.err;
    if (name != "ply" && name != "stl") continue;  // one that is exact, one that is read back
    // A named pipe, whose name says nothing.
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    std::string received;
    const Outcome named = run({"convert", "tin.ply", "-o", "pipe", "--format", name, "--json"}, [&](pid_t) {
      std::ifstream pipe(path("pipe"), std::ios::binary);
      received.assign(std::istreambuf_iterator<char>(pipe), {});
    });
    EXPECT_EQ(named.code, 0) << named.err;
    EXPECT_TRUE(received == read("file" + extension));
    EXPECT_EQ(named.json()["output"], "pipe");
    fs::remove(path("pipe"));
  }
  // What stdout was redirected to is written on, not replaced.
  const std::string command = "cd '" + path("") +
                              "' && (echo first; '" ARETE_PROGRAM
                              "' convert tin.ply -o - --format obj) > both 2> said";
  ASSERT_EQ(std::system(command.c_str()), 0) << read("said");
  EXPECT_EQ(read("both"), "first\n" + read("file.obj"));
  // The format comes before the name's, and is needed without one.
  ASSERT_EQ(run({"convert", "tin.ply", "-o", "mesh.dat", "--format", "stl"}).code, 0);
  EXPECT_EQ(read("mesh.dat"), read("file.stl"));
  EXPECT_EQ(run({"convert", "tin.ply", "-o", "-"}).code, 2);
  EXPECT_EQ(run({"convert", "tin.ply", "-o", "x", "--format", "doc"}).code, 2);
  EXPECT_EQ(run({"convert", "dem.amt", "-o", "x.amt", "--format", "ply"}).code, 2);
}

TEST_F(Convert, WarnsOfWhatTheReaderLeftOutOrGuessed) {
  write("bow.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n");
  const Outcome bow = run({"convert", "bow.obj", "-o", "bow.ply"});
  EXPECT_EQ(bow.code, 0);
  EXPECT_NE(bow.err.find("warning: bow.obj: 1 of its 1 face has"), std::string::npos) << bow.err;
}

TEST_F(Convert, RefusesWhatMakesNoSenseAndOverwritesNoInput) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "5"}).code, 0);
  const std::string before = read("tin.ply");
  fs::create_symlink("tin.ply", path("link.ply"));
  for (const char* output : {"tin.ply", "./tin.ply", "link.ply", "tin.dxf", "tin", "no/tin.stl"})
    EXPECT_NE(run({"convert", "tin.ply", "-o", output}).code, 0) << output;
  EXPECT_EQ(read("tin.ply"), before);
  const Outcome amt = run({"convert", "dem.amt", "-o", "tin.stl"});
  EXPECT_EQ(amt.code, 2);
  EXPECT_NE(amt.err.find("arete extract"), std::string::npos) << amt.err;
  const Outcome crs = run({"convert", "tin.ply", "-o", "tin.stl", "--crs", "gibberish"});
  EXPECT_EQ(crs.code, 2);
  EXPECT_NE(crs.err.find("--crs gibberish"), std::string::npos) << crs.err;
  write("cut.ply", before.substr(0, before.size() / 2));
  EXPECT_EQ(run({"convert", "cut.ply", "-o", "tin.stl"}).code, 4);
  EXPECT_EQ(run({"convert", "none.ply", "-o", "tin.stl"}).code, 3);
  EXPECT_FALSE(exists("tin.stl"));
  const Outcome help = run({"convert", "--help"});
  for (const MeshFormat& format : meshFormats())
    EXPECT_NE(help.out.find(std::string(format.extension)), std::string::npos) << format.name;
}

TEST_F(Convert, WarnsThatAnExactFormatDoesNotSayHowItsCoordinatesWereRounded) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.glb", "--max-error", "5"}).code, 0);
  const Outcome outcome = run({"convert", "tin.glb", "-o", "tin.obj"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("coordinates are rounded, by up to"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("which OBJ cannot record"), std::string::npos) << outcome.err;
}

TEST_F(Convert, TurnsAndScalesOnlyWhereStated) {
  write("x.obj", "v 0 1000 0\nv 1000 0 0\nv 0 0 1000\nf 1 2 3\n");
  const auto positions = [&](const std::vector<std::string>& options, const std::string& output) {
    std::vector<std::string> words = {"convert", "x.obj", "-o", output};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Result<MeshFile> mesh = readMesh(path(output));
    EXPECT_TRUE(mesh);
    return mesh ? mesh->mesh.positions : std::vector<Vec3>();
  };
  using Positions = std::vector<Vec3>;
  EXPECT_EQ(positions({}, "a.ply"), (Positions{{0, 1000, 0}, {1000, 0, 0}, {0, 0, 1000}}));
  EXPECT_EQ(positions({}, "a.glb"), (Positions{{0, 1000, 0}, {1000, 0, 0}, {0, 0, 1000}}));
  EXPECT_EQ(positions({"--up", "y"}, "a.glb"), (Positions{{0, 1000, 0}, {1000, 0, 0}, {0, 0, 1000}}));
  EXPECT_EQ(positions({"--up", "z"}, "a.glb"), (Positions{{0, 0, -1000}, {1000, 0, 0}, {0, 1000, 0}}));
  EXPECT_EQ(positions({"--up", "y"}, "a.ply"), (Positions{{0, 0, 1000}, {1000, 0, 0}, {0, -1000, 0}}));
  EXPECT_EQ(positions({"--unit", "mm"}, "a.off"), (Positions{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}));
}

TEST_F(Convert, RefusesAxesAndUnitsThatContradictTheFile) {
  write("crs.ply",
        "ply\nformat ascii 1.0\ncomment crs EPSG:32611\nelement vertex 3\nproperty double x\nproperty double "
        "y\n"
        "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
        "0\n0 1 "
        "1\n3 0 1 2\n");
  write("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"crs.ply", "--up", "y"},
                                                {"crs.ply", "--unit", "ft"},
                                                {"x.obj", "--unit", "ft", "--crs", "EPSG:32611"},
                                                {"x.obj", "--unit", "league"},
                                                {"x.obj", "--up", "x"}}) {
    std::vector<std::string> all = {"convert", words[0], "-o", "y.obj"};
    all.insert(all.end(), words.begin() + 1, words.end());
    const Outcome refused = run(all);
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_NE(refused.err.find(words[1]), std::string::npos) << refused.err;
    EXPECT_FALSE(exists("y.obj"));
  }
  EXPECT_EQ(run({"convert", "crs.ply", "-o", "y.obj", "--up", "z"}).code, 0) << "as it is";
}

TEST_F(Convert, NamesNoLossOfCoordinatesThatFloatsHold) {
  write("exact.obj", "v 0 0 0\nv 0.5 0 0\nv 0 1 0.25\nf 1 2 3\n");
  write("fine.obj", "v 0 0 0\nv 0.1 0 0\nv 0 1 0.25\nf 1 2 3\n");
  for (const char* output : {"a.stl", "a.glb"}) {
    EXPECT_EQ(run({"convert", "exact.obj", "-o", output}).err, "") << output;
    // The report has what is too fine for a warning.
    EXPECT_EQ(run({"convert", "exact.obj", "-o", output, "--json"}).json()["lost"].size(), 0u) << output;
    EXPECT_EQ(run({"convert", "fine.obj", "-o", output, "--json"}).json()["lost"].size(), 1u) << output;
  }
}

TEST_F(Convert, NamesNoRoundingOfAScanThatFloatsAroundItsMiddleHave) {
  write("scan.obj", "v 0.1 0.2 0.3\nv 1.1 0.7 0.2\nv 0.3 1.9 0.1\nf 1 2 3\n");
  for (const char* name : {"scan.glb", "scan.stl"}) {
    const Outcome outcome = run({"convert", "scan.obj", "-o", name, "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("finer"), std::string::npos) << outcome.err;
    // The report is whole.
    EXPECT_NE(outcome.out.find("coordinates finer"), std::string::npos) << outcome.out;
  }
}

}  // namespace
}  // namespace arete::cli_test
