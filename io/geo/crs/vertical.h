// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_spatialref.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "terrain/model/georeference.h"

namespace arete {

/// What a person states about the heights of a source. Empty: what the source says.
struct VerticalOptions {
  std::string unit;             ///< as metresPerUnit() takes it
  std::optional<bool> isDepth;  ///< the values count downwards
};

/// What a source says about its heights beside its CRS.
struct VerticalSigns {
  std::string unit;       ///< empty: nothing
  std::string datum;      ///< used where the CRS has none
  std::string depthName;  ///< why the values are depths whatever the CRS says; empty: nothing says so
  bool isUp = false;      ///< the format demands heights, whatever the CRS says
};

/// @return True if the vertical axis of the CRS points down.
bool pointsDown(const OGRSpatialReference& crs);

/// Fills the CRS and the vertical part of a georeference: as describeCrs(), then the unit that is stated, or
/// that of the source, or that of the CRS. Warns where they differ, of an unknown unit, and where nothing
/// states the unit of the heights and the CRS does not count in metres.
///
/// Heights count upwards everywhere in Arete. Values that count downwards are to be negated by the caller;
/// the CRS is then kept without its vertical part, of which the datum and the unit are kept by name.
///
/// @return Whether the values are depths. Errors: those of describeCrs(). usage: an unknown unit is stated.
Result<bool> describeVertical(const OGRSpatialReference& crs, const VerticalSigns& signs,
                              const VerticalOptions& options, Georeference& georeference, Warnings& warnings);

}  // namespace arete
