// SPDX-License-Identifier: GPL-3.0-or-later
//
// A plain with a wall, over which the answers of los, profile and viewshed are known.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_writer.h"

namespace arete::cli_test {

/// 61 x 41 samples, 10 m apart, the first at (1005, 1995); 100 high but for a wall of 130 along x = 1305 with
/// a hole in the terrain at its southern end.
class SightCommands : public Cli {
 protected:
  void makeModel(const std::string& crs = {}) const {
    constexpr std::uint32_t kColumns = 61, kRows = 41;
    std::vector<double> heights(kColumns * kRows, 100);
    for (std::uint32_t row = 0; row < kRows; ++row) heights[row * kColumns + 30] = 130;
    for (std::uint32_t row = 32; row < kRows; ++row)
      for (std::uint32_t column = 28; column < 33; ++column) heights[row * kColumns + column] = std::nan("");
    Georeference georeference;
    georeference.geoTransform = {1000, 10, 0, 2000, 0, -10};
    georeference.hasGeoTransform = true;
    georeference.crsWkt = crs;
    georeference.verticalUnit = std::string("m");
    if (!crs.empty()) georeference.geoTransform = {500000, 10, 0, 5200000, 0, -10};
    ASSERT_TRUE(writeGeoTiff(path("dem.tif"), kColumns, kRows, heights, georeference));
    const Outcome built = run({"build", "dem.tif", "-o", "dem.amt", "-q"});
    ASSERT_EQ(built.code, 0) << built.err;
  }

  void refused(const std::vector<std::string>& arguments, int code, const std::string& sentence) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }

  static std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
};

}  // namespace arete::cli_test
