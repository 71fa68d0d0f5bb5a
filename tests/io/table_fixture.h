// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/geo/crs/reader.h"
#include "io/geo/table/height_table.h"
#include "io/geo/table/point_table.h"

/// What tests of tables share.
namespace arete::test {

inline Georeference utm() {
  Georeference georeference;
  EXPECT_TRUE(describeCrs(*crsFromText("EPSG:32611"), georeference));
  return georeference;
}

/// The lines of a table of heights, as the program writes them.
inline std::string csvOf(const PointTable& table, const std::vector<std::optional<GroundHeight>>& heights) {
  std::string text;
  forCsvLines(table, heights, [&](std::string_view line) { text += line; });
  return text;
}

}  // namespace arete::test
