// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// Where the coordinates of a mesh are led before it is written; by default nowhere.
struct PlaceTarget {
  /// Any text that crsFromUser() takes, or "utm": the zone of the middle, on the datum of the mesh. x is
  /// easting or longitude. Heights keep their numbers and their unit.
  std::string crs = {};
  /// Metres to the east, to the north and up from an origin: the frame that a GLB has, with z up. Heights
  /// are in metres too.
  bool isMetric = false;

  bool isStated() const { return isMetric || !crs.empty(); }
};

}  // namespace arete
