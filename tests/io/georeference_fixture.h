// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "io/geo/crs/reader.h"
#include "terrain/model/georeference.h"

namespace arete::test {

/// A georeference of which the CRS and the place are known.
inline Georeference georeferenceOf(const std::string& crs,
                                   const std::array<double, 6>& geoTransform = {0, 1, 0, 0, 0, -1}) {
  Georeference georeference;
  georeference.geoTransform = geoTransform;
  georeference.hasGeoTransform = true;
  const auto parsed = crsFromText(crs);
  EXPECT_TRUE(parsed) << crs;
  if (parsed) {
    EXPECT_TRUE(describeCrs(*parsed, georeference)) << crs;
  }
  return georeference;
}

}  // namespace arete::test
