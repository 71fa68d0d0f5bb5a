// SPDX-License-Identifier: GPL-3.0-or-later
// The options that los, profile and viewshed share: NODATA, the shape of the Earth.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cli/sight_fixture.h"
#include "io/geo/dem/raster_reader.h"
#include "io/geo/dem/raster_writer.h"

namespace arete::cli_test {
namespace {

using SharedSightArguments = SightCommands;

TEST_F(SharedSightArguments, TakesNodataAsItIsTold) {
  makeModel();
  const auto verdict = [&](const char* nodata) {
    return run({"los", "dem.amt", "--from", "1205,1615,20", "--to", "1405,1615,20", "--nodata", nodata,
                "--json"})
        .json();
  };
  EXPECT_EQ(verdict("unknown")["verdict"], "unknown");
  EXPECT_NEAR(verdict("unknown")["gap"].get<double>(), 60, 1e-6);
  EXPECT_EQ(verdict("clear")["verdict"], "visible");
  const Json blocked = verdict("blocked");
  EXPECT_EQ(blocked["verdict"], "blocked");
  EXPECT_NEAR(blocked["obstruction"]["distance"].get<double>(), 70, 1e-6);
  EXPECT_TRUE(blocked["obstruction"]["terrainHeight"].is_null());
}

TEST_F(SharedSightArguments, GoesOverTheEllipsoidWhereThereIsACrs) {
  makeModel("EPSG:32632");
  const std::vector<std::string> arguments = {"los",  "dem.amt",           "--from", "500105,5199895,20",
                                              "--to", "500505,5199895,20", "--json"};
  const Json curved = run(arguments).json();
  EXPECT_EQ(curved["earth"], "ellipsoid");
  EXPECT_NEAR(curved["distance"].get<double>(), 400 / 0.9996, 1e-3);
  std::vector<std::string> flat = arguments;
  flat.insert(flat.end(), {"--earth", "plane"});
  EXPECT_NEAR(run(flat).json()["distance"].get<double>(), 400, 1e-9);
  const Json lonLat = run({"los", "dem.amt", "--lonlat", "--from", "9.0013,46.9528,20", "--to",
                           "9.0066,46.9528,20", "--json"})
                          .json();
  EXPECT_EQ(lonLat["verdict"], "blocked") << lonLat;
  EXPECT_NEAR(lonLat["azimuth"].get<double>(), 90, 0.01);
}

}  // namespace
}  // namespace arete::cli_test
