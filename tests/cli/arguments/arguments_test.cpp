// SPDX-License-Identifier: GPL-3.0-or-later
// What arete says to a command line that makes no sense, and to files that are not what they should be.
#include <sys/stat.h>

#include "cli/arguments_fixture.h"

namespace arete::cli_test {
namespace {

TEST_F(Arguments, RefusesTolerancesThatAreNone) {
  const auto extract = [&](const std::string& option, const std::string& value, int code,
                           const std::string& sentence) {
    expectRefusal({"extract", "dem.amt", "-o", "x.ply", option, value}, code, sentence);
  };
  extract("--max-error", "-1", 2, "--max-error: an error cannot be below zero, as -1 is");
  extract("--max-error", "nan", 2, "--max-error: 'nan' is not a number");
  extract("--max-error", "5,much", 2, "--max-error: 'much' is not a number");
  extract("--max-error", "5,", 2, "--max-error: '' is not a number");
  extract("--max-error", "5,2,5", 2, "--max-error: has 5 twice");
  extract("--max-triangles", "1", 2, "--max-triangles: 1 triangle is fewer than");
  extract("--max-triangles", "-4", 2, "--max-triangles: -4 is below zero");
  extract("--max-triangles", "many", 2, "--max-triangles: 'many' is not a number");
  expectRefusal({"extract", "dem.amt", "-o", "x.ply"}, 2,
                "--max-error, --max-triangles, --camera or --deadline is required");
  expectRefusal({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--method", "best"}, 2,
                "--method: 'best' must be one of minimal, saturated");
  const auto fit = [&](std::vector<std::string> options, const std::string& sentence) {
    options.insert(options.begin(), {"extract", "dem.amt", "-o", "x.ply", "--fit"});
    expectRefusal(options, 2, sentence);
  };
  fit({"heights", "--max-error", "1"}, "--fit: 'heights' must be one of triangles, error, unbiased");
  fit({"triangles", "--max-triangles", "500"}, "--fit triangles: requires --max-error");
  fit({"triangles", "--max-error", "1", "--method", "saturated"},
      "--fit triangles: cannot be combined with --method saturated");
  fit({"error", "--max-error", "1", "--region", "0,0,9,9"}, "--fit error: cannot be combined with --region");
  fit({"error", "--max-error", "1", "--deadline", "9"},
      "--fit error: cannot be combined with --camera, --focus or");
  fit({"triangles", "--max-error", "1", "--focus", "1,1", "--error-growth", "0"},
      "--fit triangles: cannot be");
  for (const std::vector<std::string>& place :
       {std::vector<std::string>{"--deadline", "9"}, {"--focus", "1,1", "--error-growth", "0"}}) {
    std::vector<std::string> options{"unbiased", "--max-error", "1"};
    options.insert(options.end(), place.begin(), place.end());
    fit(options, "--fit unbiased: cannot be combined with --camera, --focus or");
  }
  expectRefusal({"measure", "tin.ply", "dem.tif", "--expect", "-2"}, 2, "--expect: an error cannot be below");
}

TEST_F(Arguments, NameTheOptionThatSpoilsACamera) {
  const std::string place = middle() + ",500msl";
  const auto camera = [&](const std::string& option, const std::string& value, const std::string& sentence) {
    expectRefusal({"extract", "dem.amt", "-o", "x.ply", "--camera", place, option, value}, 2, sentence);
  };
  camera("--viewport", "0x10", "--viewport 0x10: the picture must have a pixel");
  camera("--look", "10,-100", "--look 10,-100: the pitch must lie between");
  camera("--fov", "0", "--fov: must be from 0.01");
}

TEST_F(Arguments, ACameraIsToldNoMorePixelsThanItAskedFor) {
  for (const double pixels : {0.5, 1.0, 2.0, 4.0, 8.0})
    for (const char* method : {"minimal", "saturated"}) {
      const Json answer =
          run({"extract", "dem.amt", "-o", "x.ply", "--json", "--camera", middle() + ",20,45,-10",
               "--pixel-error", std::to_string(pixels), "--method", method})
              .json();
      EXPECT_LE(answer["exports"][0]["pixels"].get<double>(), pixels) << method;
    }
}

TEST_F(Arguments, RefusesBuildOptionsOutOfRange) {
  const auto build = [&](const std::string& option, const std::string& value, int code,
                         const std::string& sentence) {
    expectRefusal({"build", "dem.tif", "-o", "x.amt", option, value}, code, sentence);
  };
  build("--ratio", "1", 2, "--ratio: must be above 1, not 1");
  build("--ratio", "nan", 2, "--ratio: 'nan' is not a finite number");
  build("--max-degree", "3", 2, "--max-degree: must be from 6");
  build("--min-aspect", "0.9", 2, "--min-aspect: requires --shape fidelity");
  build("--layer", "peaks", 2, "dem.tif: is a raster, which has no layer 'peaks'");
  expectRefusal({"build", "dem.tif", "-o", "x.amt", "--shape", "fidelity", "--min-aspect", "0.9"}, 2,
                "--min-aspect");
  build("--rim-tolerance", "-1", 2, "--rim-tolerance: must be 0 or more");
  build("--shape", "pretty", 2, "--shape: 'pretty' must be one of delaunay, fidelity");
  build("--features", "-3", 2, "--features: must be from 0");
  build("--crease-angle", "200", 2, "--crease-angle: must be from 0 to 180");
  build("--band", "7", 2, "there is no band 7");
  build("--crs", "nonsense", 2, "--crs nonsense: is not a CRS");
  build("--nodata", "none", 2, "--nodata: 'none' is not a number");
  build("--threads", "0", 2, "--threads: Value 0 not in range 1 to 4096");
  build("--fixed", "nowhere.csv", 3, "nowhere.csv: there is no such file");
  write("far.csv", "x,y\n1e9,1e9\n");
  before_ = files();
  build("--fixed", "far.csv", 4, "--fixed far.csv: none of 1 point lies on the DEM's data");
  expectRefusal({"build", "dem.tif", "-o", "x.amt", "--features", "3", "--no-features"}, 2, "--no-features");
}

TEST_F(Arguments, RefusesOutputsBeforeAnyWork) {
  expectRefusal({"build", "dem.tif", "-o", "no/dem.amt"}, 3, "--output no/dem.amt: the folder");
  expectRefusal({"build", "dem.tif", "-o", "dem.ply"}, 2, "must end in .amt, not .ply");
  expectRefusal({"build", "dem.amt", "-o", "./dem.amt"}, 2, "--output ./dem.amt: is an input");
  expectRefusal({"extract", "dem.amt", "-o", "dem.tif", "--max-error", "1"}, 2,
                "--output dem.tif: is an input");
  expectRefusal(
      {"extract", "dem.amt", "-o", "x.dxf", "--max-error", "1"}, 2,
      "--output x.dxf: '.dxf' is not a format that can be written; known are .ply (PLY), .obj (OBJ), ");
  expectRefusal({"extract", "dem.amt", "-o", "x", "--max-error", "1"}, 2,
                "the extension that names a format");
  expectRefusal({"extract", "dem.amt", "-o", "no/x.ply", "--max-error", "1"}, 3,
                "--output no/x.ply: the folder");
  expectRefusal({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--error-raster", "e.png"}, 2,
                "--error-raster e.png: the error raster is a GeoTIFF");
  expectRefusal({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--certificate", "no/c.json"}, 3,
                "--certificate no/c.json: the folder");
  expectRefusal({"extract", "dem.amt", "-o", "x.tif", "--max-error", "1", "--error-raster", "x.tif"}, 2,
                "--error-raster x.tif");
  expectRefusal({"extract", "--certificate", "dem.amt", "--max-error", "1", "-o", "x.ply"}, 2,
                "put FILE.amt before --certificate");
  expectRefusal({"measure", "tin.ply", "dem.tif", "--error-raster", "dem.tif"}, 2,
                "--error-raster dem.tif: is an input");
}

TEST_F(Arguments, RefusesAFolderThatCannotBeWrittenTo) {
  // Root may write anywhere but there.
  const std::string folder = geteuid() == 0 ? "/proc" : path("locked");
  if (geteuid() != 0) {
    fs::create_directory(folder);
    chmod(folder.c_str(), 0555);
    before_ = files();
  }
  const Outcome outcome = run({"build", "dem.tif", "-o", folder + "/x.amt"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find(folder + "/x.amt"), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), before_);
}

TEST_F(Arguments, RefusesRegionsThatMeanNothing) {
  const auto region = [&](const std::string& text, int code, const std::string& sentence) {
    expectRefusal({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--region", text}, code,
                  sentence);
  };
  region("1,2,3", 2, "--region 1,2,3: a box has four numbers");
  region("5,0,1,9", 2, "--region 5,0,1,9: xmin must be below xmax");
  region("-9e8,-9e8,-8e8,-8e8", 2, "does not meet the data of dem.amt");
  region("park.gpkg", 3, "park.gpkg: there is no such file");
  region("0,0,1,nan", 2, "finite numbers");
  expectRefusal({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--outside-error", "5"}, 2,
                "--outside-error: requires --region");
  expectRefusal({"extract", "dem.amt", "-o", "x.ply", "--max-error", "9", "--region", "-1e9,-1e9,1e9,1e9",
                 "--outside-error", "5"},
                2, "--outside-error: 5 is below the error 9 inside");
  expectRefusal({"measure", "tin.ply", "dem.tif", "--region", "-9e8,-9e8,-8e8,-8e8"}, 2,
                "holds no sample of");
}

TEST_F(Arguments, NeverAssumesACrs) {
  write("bare.xyz", "0 0 1\n1 0 2\n0.5 1 3\n3 1.5 4\n");
  ASSERT_EQ(run({"build", "bare.xyz", "-o", "bare.amt"}).code, 0);
  write("park.geojson", R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]})");
  before_ = files();
  expectRefusal({"extract", "bare.amt", "-o", "x.ply", "--max-error", "1", "--region", "park.geojson"}, 2,
                "has a CRS and the DEM has none");
  write("fixed.geojson", R"({"type":"Point","coordinates":[0.5,0.5]})");
  before_ = files();
  expectRefusal({"build", "bare.xyz", "-o", "x.amt", "--fixed", "fixed.geojson"}, 4,
                "has a CRS and the DEM has none");
}

TEST_F(Arguments, TellsFilesThatAreNotWhatTheyShouldBe) {
  expectRefusal({"build", "nowhere.tif", "-o", "x.amt"}, 3, "nowhere.tif: there is no such file");
  expectRefusal({"info", "nowhere.amt"}, 3, "nowhere.amt");
  expectRefusal({"info", "dem.tif"}, 3, "dem.tif: is not an .amt file");
  expectRefusal({"measure", "tin.dxf", "dem.tif"}, 3, ".dxf is no known mesh format; known are PLY (.ply)");
  expectRefusal({"measure", "tin.ply", "nowhere.tif"}, 3, "nowhere.tif");
  write("bad.ply", "ply\nformat ascii 1.0\nelement vertex 9999999\n");
  write("bad.tif", "this is no raster");
  before_ = files();
  expectRefusal({"measure", "bad.ply", "dem.tif"}, 4, "bad.ply");
  EXPECT_NE(run({"build", "bad.tif", "-o", "x.amt"}).code, 0);
}

TEST_F(Arguments, NamesDegenerateData) {
  for (const RasterFamily& family : degenerateFamilies()) {
    SCOPED_TRACE(family.name);
    makeRaster("bad.tif", family.name, 9, 9);
    before_ = files();
    expectRefusal({"build", "bad.tif", "-o", "x.amt"}, 4, "bad.tif: ");
  }
}

TEST_F(Arguments, TakePointsThatAreOnALineButForTheirRounding) {
  std::string text = "x,y,z\n";
  for (int i = 0; i < 100; ++i)
    text += std::to_string(i / 10) + "." + std::to_string(i % 10) + "," + std::to_string(3 * i / 10) + "." +
            std::to_string(3 * i % 10) + "," + std::to_string(i * i % 17) + "\n";
  write("line.csv", text);
  for (const char* shape : {"delaunay", "fidelity"}) {
    const Outcome build = run({"build", "line.csv", "-o", "line.amt", "--no-features", "--shape", shape});
    EXPECT_EQ(build.code, 0) << build.err;
    const Outcome laws = run({"validate", "line.amt"});
    EXPECT_EQ(laws.code, 0) << laws.err << laws.out;
  }
}

TEST_F(Arguments, KeepTheInputOfAConversion) {
  expectRefusal({"convert", "dem.amt", "-o", "dem.amt", "--packed"}, 2, "dem.amt: is an input");
  expectRefusal({"convert", "tin.ply", "-o", "tin.ply"}, 2, "tin.ply: is an input");
}

TEST_F(Arguments, AreToldWhenOneFileIsToBeTwoOutputs) {
  expectRefusal({"extract", "dem.amt", "-o", "new.tif", "--max-error", "2", "--error-raster", "new.tif"}, 2,
                "--error-raster new.tif: is written by this command already");
  expectRefusal({"extract", "dem.amt", "-o", "new.ply", "--max-error", "2", "--certificate", "new.ply"}, 2,
                "--certificate new.ply: is written by this command already");
}

TEST_F(Arguments, LeaveNoFolderBehindADemoOfNothing) {
  expectRefusal({"demo", "nothing.tif", "-o", "folder"}, 3, "nothing.tif");
}

TEST_F(Arguments, SayWhatCommasBetweenDigitsMean) {
  expectRefusal(
      {"extract", "dem.amt", "-o", "x.ply", "--max-triangles", "5,000"}, 2,
      "--max-triangles: commas stand between several numbers, and digits are not grouped by them: 5000?");
}

}  // namespace
}  // namespace arete::cli_test
