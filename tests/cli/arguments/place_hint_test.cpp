// SPDX-License-Identifier: GPL-3.0-or-later
// Longitudes and latitudes where the map of the DEM has lengths.
#include <string>
#include <vector>

#include "cli/sight_fixture.h"

namespace arete::cli_test {
namespace {

using PlaceHints = SightCommands;

TEST_F(PlaceHints, NameTheOptionAndWhatToAdd) {
  makeModel("EPSG:32632");
  const std::string add = "longitude,latitude? add --lonlat";
  refused({"los", "dem.amt", "--from", "9.001,46.952,10", "--to", "500100,5199900,2"}, 4,
          "--from 9.001,46.952,10: lies outside the DEM: " + add);
  refused({"los", "dem.amt", "--from", "500100,5199900,2", "--to", "9.001,46.952,10"}, 4,
          "--to 9.001,46.952,10: lies outside the DEM: " + add);
  refused({"viewshed", "dem.amt", "--observer", "9.001,46.952,10", "-o", "v.tif"}, 4,
          "--observer 9.001,46.952,10: lies outside the DEM: " + add);
  refused({"profile", "dem.amt", "--along", "9.001,46.952:9.002,46.953"}, 4,
          "--along 9.001,46.952:9.002,46.953: lies outside the DEM: " + add);
  refused({"extract", "dem.amt", "-o", "t.ply", "--camera", "9.001,46.952,100"}, 4, add);
  const Outcome height = run({"height", "dem.amt", "--at", "9.001,46.952"});
  EXPECT_EQ(height.code, 4);
  EXPECT_NE(height.err.find("--at 9.001,46.952: dem.amt has no terrain at this place: " + add),
            std::string::npos)
      << height.err;
  const Outcome focus = run({"extract", "dem.amt", "-o", "t.ply", "--max-error", "1", "--focus",
                             "9.001,46.952", "--error-growth", "1"});
  EXPECT_EQ(focus.code, 0);
  EXPECT_NE(focus.err.find("warning: --focus 9.001,46.952 lies outside the DEM: " + add), std::string::npos)
      << focus.err;
}

TEST_F(PlaceHints, OfARegionNameItsCrs) {
  makeModel("EPSG:32632");
  const std::vector<std::string> box = {"extract",     "dem.amt", "-o",       "t.ply",
                                        "--max-error", "1",       "--region", "9,46.95,9.005,46.953"};
  refused(box, 2, "longitude,latitude? add --region-crs EPSG:4326");
  std::vector<std::string> flagged = box, stated = box;
  flagged.emplace_back("--lonlat");
  refused(flagged, 2, "--region-crs EPSG:4326");
  stated.insert(stated.end(), {"--region-crs", "4326", "-q"});
  EXPECT_EQ(run(stated).code, 0);
}

TEST_F(PlaceHints, TellLatitudesFirst) {
  makeModel("EPSG:32632");
  refused({"los", "dem.amt", "--from", "-36.9,174.8,10", "--to", "500100,5199900,2"}, 4,
          "latitude,longitude? state longitude,latitude and add --lonlat");
}

// Without a CRS, --lonlat has no meaning; on the map, a place is one.
TEST_F(PlaceHints, AreNotGivenWhereNothingSpeaksForThem) {
  makeModel();
  const Outcome bare = run({"los", "dem.amt", "--from", "9,46,10", "--to", "1105,1895,2"});
  EXPECT_EQ(bare.code, 4);
  EXPECT_EQ(bare.err.find("longitude"), std::string::npos) << bare.err;
  EXPECT_NE(bare.err.find("--from 9,46,10: has no terrain below it"), std::string::npos) << bare.err;
  makeModel("EPSG:32632");
  const Outcome far = run({"los", "dem.amt", "--from", "400000,46,10", "--to", "500100,5199900,2"});
  EXPECT_EQ(far.err.find("longitude"), std::string::npos) << far.err;
  const Outcome aloft = run({"los", "dem.amt", "--from", "9,46,9000msl", "--to", "500100,5199900,2"});
  EXPECT_EQ(aloft.code, 0) << aloft.err;
  EXPECT_NE(aloft.err.find("warning: --from 9,46,9000msl lies outside the DEM"), std::string::npos)
      << aloft.err;
}

}  // namespace
}  // namespace arete::cli_test
