// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths with units: a question asked in one unit has the answer of the same question in another.
#include <cmath>

#include "cli/sight_fixture.h"
#include "io/geo/crs/reader.h"

namespace arete::cli_test {
namespace {

class Units : public SightCommands {
 protected:
  /// Waves of 40 m on a grid of 10 m, in UTM and in heights of the unit.
  void makeWaves(const std::string& name, const std::string& unit, double metres, bool hasCrs = true) const {
    constexpr std::uint32_t kSide = 40;
    std::vector<double> heights;
    for (std::uint32_t row = 0; row < kSide; ++row)
      for (std::uint32_t column = 0; column < kSide; ++column)
        heights.push_back(std::round(1000 * 40 * std::sin(column / 3.0) * std::cos(row / 5.0)) / 1000 /
                          metres);
    Georeference georeference;
    georeference.geoTransform = {500000, 10, 0, 5200000, 0, -10};
    georeference.hasGeoTransform = true;
    if (hasCrs) georeference.crsWkt = wktOf(crsFromText("EPSG:32632").value());
    georeference.verticalUnit = unit;
    georeference.verticalUnitMetres = metres;
    GeoTiffOptions options;
    options.sample = GeoTiffOptions::Sample::float64;
    ASSERT_TRUE(writeGeoTiff(path(name + ".tif"), kSide, kSide, heights, georeference, options));
    const Outcome built = run({"build", name + ".tif", "-o", name + ".amt", "-q"});
    ASSERT_EQ(built.code, 0) << built.err;
  }
  Json ask(std::vector<std::string> command) const {
    command.emplace_back("--json");
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json();
  }
};

TEST_F(Units, OfAnErrorAreTurnedIntoThatOfHeights) {
  makeWaves("feet", "ft", 0.3048);
  for (const auto& [stated, feet] : {std::pair{"2m", 2 / 0.3048},
                                     {"200cm", 2 / 0.3048},
                                     {"10ft", 10.0},
                                     {"7", 7.0},
                                     {"0.002km", 2 / 0.3048}}) {
    const Json answer = ask({"extract", "feet.amt", "x.ply", "--max-error", stated})["exports"][0];
    const Json plain =
        ask({"extract", "feet.amt", "y.ply", "--max-error", fmt::format("{}", feet)})["exports"][0];
    EXPECT_EQ(answer["triangles"], plain["triangles"]) << stated;
    EXPECT_NEAR(answer["maxError"].get<double>(), feet, 1e-9) << stated << answer;
    EXPECT_EQ(read("x.ply"), read("y.ply")) << stated;
  }
  EXPECT_EQ(run({"measure", "x.ply", "feet.tif", "--expect", "2m"}).code, 0);
  EXPECT_EQ(run({"measure", "x.ply", "feet.tif", "--expect", "1mm"}).code, 5);
  const Outcome several = run({"extract", "feet.amt", "-o", "tin.ply", "--max-error", "2m,20ft,9", "-q"});
  EXPECT_EQ(several.code, 0) << several.err;
  EXPECT_TRUE(exists("tin_2m.ply") && exists("tin_20ft.ply") && exists("tin_9.ply"));
  EXPECT_NEAR(ask({"info", "feet.amt", "--at", "3.048m"})["curve"][0]["maxError"].get<double>(), 10, 1e-12);
}

TEST_F(Units, OfHeightsAndDistancesGiveTheSameViewshed) {
  makeWaves("feet", "ft", 0.3048);
  const std::string place = "500200,5199800,";
  const auto seen = [&](const std::string& height, const std::string& target, const std::string& radius) {
    return ask({"viewshed", "feet.amt", "seen.tif", "--observer", place + height, "--target-height", target,
                "--radius", radius});
  };
  const Json plain = seen("32.808398950131235", "6.561679790026247", "150");
  EXPECT_GT(plain["seen"].get<int>(), 0);
  EXPECT_GT(plain["hidden"].get<int>(), 0);
  for (const auto& [height, target, radius] :
       {std::tuple{"10m", "2m", "0.15km"}, {"0.01km", "200cm", "15000cm"}, {"1000cm", "2m", "150m"}}) {
    const Json stated = seen(height, target, radius);
    for (const char* key : {"seen", "hidden", "outside"}) EXPECT_EQ(stated[key], plain[key]) << height << key;
    EXPECT_NEAR(stated["targetHeight"].get<double>(), 2 / 0.3048, 1e-9);
  }
  EXPECT_NE(seen("10m", "2m", "150ft")["outside"], plain["outside"]) << "feet are no metres";
  EXPECT_NE(seen("10", "2", "150m")["seen"], plain["seen"]) << "a number is in the DEM's unit";
}

TEST_F(Units, OfALineOfSightAreThoseOfItsHeights) {
  makeModel();  // heights in metres
  const Json metres = ask({"los", "dem.amt", "--from", "1105,1895,25", "--to", "1505,1895,25"});
  const Json feet = ask({"los", "dem.amt", "--from", "1105,1895,2500cm", "--to", "1505,1895,0.025kmagl"});
  EXPECT_EQ(feet["fromHeight"], metres["fromHeight"]);
  EXPECT_EQ(feet["clearance"], metres["clearance"]);
  EXPECT_NEAR(
      ask({"los", "dem.amt", "--from", "1105,1895,10ft", "--to", "1505,1895,2"})["fromHeight"].get<double>(),
      103.048, 1e-9);
  EXPECT_NEAR(ask({"los", "dem.amt", "--from", "1105,1895,10us-ft", "--to", "1505,1895,2"})["fromHeight"]
                  .get<double>(),
              100 + 12000.0 / 3937, 1e-9);
  refused({"los", "dem.amt", "--from", "1105,1895,10yd", "--to", "1505,1895,2"}, 2, "mm, cm, m, km");
  refused({"los", "dem.amt", "--from", "1105m,1895,10", "--to", "1505,1895,2"}, 2, "'1105m' is not a number");
  // Of a map without a CRS the metre of the ground is not known, and that of heights is.
  refused({"viewshed", "dem.amt", "s.tif", "--observer", "1105,1895,5m", "--radius", "1km"}, 2,
          "--radius 1km: has a unit, and the terrain has no CRS");
  refused({"extract", "dem.amt", "t.ply", "--max-error", "5", "--region", "1105,1700,1300,1895", "--distance",
           "1km"},
          2, "--distance 1km: has a unit, and the terrain has no CRS");
}

TEST_F(Units, AreRefusedWhereThatOfTheDataIsNotKnown) {
  makeWaves("bare", "", 1);
  refused({"extract", "bare.amt", "t.ply", "--max-error", "5m"}, 2,
          "--max-error 5m: has a unit, and the unit of the data is not known");
  refused({"los", "bare.amt", "--from", "500200,5199800,5m", "--to", "500100,5199800,2"}, 2, "is not known");
  EXPECT_EQ(run({"extract", "bare.amt", "t.ply", "--max-error", "5"}).code, 0);
  EXPECT_EQ(
      run({"viewshed", "bare.amt", "s.tif", "--observer", "500200,5199800,5", "--radius", "0.1km"}).code, 0)
      << "the ground has metres";
  refused({"extract", "bare.amt", "t.ply", "--max-error", "5M"}, 2, "mm, cm, m, km, ft, us-ft, mi, nmi");
  refused({"extract", "bare.amt", "t.ply", "--max-triangles", "5m"}, 2, "5m");
}

TEST_F(Units, OfAMeshAreThoseOfItsSpace) {
  // Two walls of a box, 10 m long, in centimetres by its comment.
  write("wall.ply",
        "ply\nformat ascii 1.0\ncomment vertical_unit cm\nelement vertex 4\nproperty double x\nproperty "
        "double y\n"
        "property double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1000 0 0\n1000 0.5 1000\n0 0 1000\n3 0 1 2\n3 0 2 3\n");
  ASSERT_EQ(run({"build", "wall.ply", "-o", "wall.amt", "--as", "surface", "-q"}).code, 0);
  const Json plain = ask({"extract", "wall.amt", "a.ply", "--max-error", "0.25"})["exports"][0];
  const Json stated = ask({"extract", "wall.amt", "b.ply", "--max-error", "2.5mm"})["exports"][0];
  EXPECT_EQ(stated["triangles"], plain["triangles"]);
  EXPECT_EQ(read("a.ply"), read("b.ply"));
  write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refused({"mesh", "repair", "bare.obj", "c.obj", "--weld", "2mm"}, 2,
          "--weld 2mm: has a unit, and the unit of the");
  refused({"mesh", "decimate", "bare.obj", "c.obj", "--max-error", "2mm"}, 2, "2mm");
}

}  // namespace
}  // namespace arete::cli_test
