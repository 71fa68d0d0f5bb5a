// SPDX-License-Identifier: GPL-3.0-or-later
// The options of reading a DEM: several files, what hides or turns heights, and that a certificate repeats
// them.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"
#include "io/geo/dem/raster_writer.h"

namespace arete::cli_test {
namespace {

class Reading : public Cli {
 protected:
  /// Writes the columns from `first` to before `end` of a raster.
  void writeColumns(const std::string& name, const RasterHeightfield& field, std::uint32_t first,
                    std::uint32_t end) const {
    std::vector<double> heights;
    for (std::uint32_t row = 0; row < field.rows; ++row)
      for (std::uint32_t column = first; column < end; ++column) heights.push_back(field.at(column, row));
    Georeference georeference = field.georeference;
    georeference.geoTransform[0] += first * georeference.geoTransform[1];
    ASSERT_TRUE(writeGeoTiff(path(name), end - first, field.rows, heights, georeference,
                             {.sample = GeoTiffOptions::Sample::float64}));
  }
};

TEST_F(Reading, JoinsFilesIntoTheModelOfTheWhole) {
  makeRaster("dem.tif", "fractal", 60, 40);
  const auto whole = readRaster(path("dem.tif"));
  ASSERT_TRUE(whole);
  writeColumns("a.tif", whole->heightfield, 0, 31);
  writeColumns("b.tif", whole->heightfield, 30, 60);
  const Json single = run({"build", "dem.tif", "-o", "dem.amt", "--json"}).json();
  const Outcome built = run({"build", "b.tif", "a.tif", "-o", "both.amt", "--json"});
  ASSERT_EQ(built.code, 0) << built.err;
  for (const char* same : {"sourceChecksum", "triangles", "rootTriangles", "levels"})
    EXPECT_EQ(built.json()[same], single[same]) << same;
  EXPECT_EQ(run({"build", "*.tif", "-o", "pattern.amt", "--json"}).json()["sourceChecksum"],
            single["sourceChecksum"]);
  for (const char* model : {"dem", "both"})
    ASSERT_EQ(run({"extract", std::string(model) + ".amt", "-o", std::string(model) + ".ply", "--max-error",
                   "2", "--certificate"})
                  .code,
              0);
  const Outcome measured = run({"measure", "both.ply", "a.tif", "b.tif", "--expect", "2"});
  EXPECT_EQ(measured.code, 0) << measured.err;
  EXPECT_NE(read("both.certificate.json").find("measure both.ply b.tif a.tif --expect"), std::string::npos)
      << read("both.certificate.json");
  const Outcome destroying = run({"build", "dem.tif", "a.tif", "-o", "a.tif"});
  EXPECT_EQ(destroying.code, 2);
  const Outcome layered = run({"build", "a.tif", "b.tif", "-o", "x.amt", "--layer", "p"});
  EXPECT_EQ(layered.code, 2);
  EXPECT_NE(layered.err.find("--layer"), std::string::npos) << layered.err;
}

TEST_F(Reading, TakesNodataThatIsNoNumberAndRepeatsWhatWasStated) {
  makeRaster("dem.tif", "fractal", 30, 30);
  for (const char* nodata : {"nan", "inf", "-inf", "-9999"}) {
    const Outcome built = run({"build", "dem.tif", "-o", "dem.amt", "--nodata", nodata, "--positive", "down",
                               "--vertical-unit", "us-ft"});
    ASSERT_EQ(built.code, 0) << built.err;
    ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "2", "--certificate"}).code, 0);
    EXPECT_NE(read("tin.certificate.json")
                  .find(fmt::format("--nodata {} --vertical-unit us-ft --positive down", nodata)),
              std::string::npos)
        << read("tin.certificate.json");
  }
  const Outcome measured = run(
      {"measure", "tin.ply", "dem.tif", "--positive", "down", "--vertical-unit", "us-ft", "--expect", "2"});
  EXPECT_EQ(measured.code, 0) << measured.err;
  EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--expect", "2"}).code, 5) << "upside down";
  for (const auto& wrong :
       {std::pair{"--nodata", "none"}, {"--positive", "sideways"}, {"--vertical-unit", "cubit"}}) {
    const Outcome refused = run({"build", "dem.tif", "-o", "dem.amt", wrong.first, wrong.second});
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_NE(refused.err.find(wrong.first), std::string::npos) << refused.err;
  }
}

TEST_F(Reading, SaysHowToReadWhatIsCompressed) {
  for (const auto& [name, hint] : {std::pair{"a.tif.gz", "/vsigzip/a.tif.gz"},
                                   {"a.tgz", "/vsitar/a.tgz/NAME"},
                                   {"A.TAR.GZ", "/vsitar/A.TAR.GZ/NAME"},
                                   {"a.tar", "/vsitar/a.tar/NAME"},
                                   {"a.7z", "unpack it"},
                                   {"a.tif.xz", "unpack it"}}) {
    write(name, "\x1f\x8b and so on");
    const Outcome refused = run({"build", name, "-o", "a.amt"});
    EXPECT_EQ(refused.code, 3) << refused.err;
    EXPECT_NE(refused.err.find(hint), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace arete::cli_test
