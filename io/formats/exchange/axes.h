// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "io/formats/exchange/mesh_formats.h"

namespace arete {

/// A unit of length: numerator / denominator metres, both whole.
struct MeshUnit {
  std::string_view name;
  double numerator = 1, denominator = 1;
};

/// The units that a mesh may be stated to be in: mm, cm, m, km, in, ft, us-ft, yd.
std::vector<std::string> meshUnitNames();

/// How the numbers of a mesh file are to be understood where it does not say so itself.
struct MeshPlacing {
  MeshUp up = MeshUp::unknown;  ///< which axis points up; unknown: nothing is turned
  std::string unit = {};        ///< the length of 1, by its name; empty: nothing is scaled

  bool isNothing() const { return up == MeshUp::unknown && unit.empty(); }
};

/// Scales, turns and moves a mesh: what place() does, and its origin, rounding and errors go along. Errors
/// are rounded upwards; where one is too large for its number, none is stated.
///
/// Errors: as place(). Precondition: the placing does not mirror. O(size).
Status placeMesh(MeshFile& mesh, const Similarity& placing);

/// Turns and scales a mesh so that the `wanted` axis points up, y or z, and lengths are in metres. Positions,
/// the origin, the rounding and the errors of the mesh, and the directions among its attributes go along.
/// Turning swaps two axes and negates one: x, y, z become x, -z, y where y was up, and x, z, -y where z was;
/// so it is exact, and back again nothing has changed. Scaling rounds once or twice.
///
/// Errors: usage, culprit `up` or `unit`: the file says otherwise, by its CRS or its frame; the unit is not
/// known. invalidData: a coordinate is out of range then. O(size).
Status placeMesh(MeshFile& mesh, const MeshPlacing& placing, MeshUp wanted);

}  // namespace arete
