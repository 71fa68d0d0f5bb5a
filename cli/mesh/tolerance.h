// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/files/text/length_unit.h"
#include "io/formats/common/file.h"
#include "surface/model/surface_model.h"

namespace arete {

/// A distance as a user states it: in the file's unit, or as a share of the diagonal.
struct SurfaceTolerance {
  std::string text;  ///< "0.5%"
  double distance = 0;
  bool operator==(const SurfaceTolerance&) const = default;
};

/// Parses tolerances with commas between: "0.01", "0.5%", "2mm", "inf".
///
/// @param unit of the mesh.
/// Errors: usage, naming the option and the part that is no distance, or whose unit cannot be turned into
/// the mesh's.
Result<std::vector<SurfaceTolerance>> parseSurfaceTolerances(const std::string& option,
                                                             const std::string& text, double diagonal,
                                                             const DataUnit& unit);

/// The unit of a model, or of a mesh in a file.
DataUnit spaceUnitOf(const SurfaceModel& model);
DataUnit spaceUnitOf(const MeshFile& file);

/// "0.0123 (0.48 % of the diagonal)".
std::string withShare(double distance, double diagonal);

}  // namespace arete
