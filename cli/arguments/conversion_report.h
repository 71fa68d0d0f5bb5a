// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "cli/session/session.h"
#include "io/formats/exchange/convert.h"

namespace arete {

/// Rounding of coordinates of this part of the diagonal is that of 32-bit floats around the middle of a scan,
/// as most scans are stored: nothing that can be seen or measured of them is lost.
inline constexpr double kFineShareOfDiagonal = 1e-7;
/// Where a distance is promised, rounding of a hundredth of it still counts.
inline constexpr double kFineShareOfTolerance = 1e-2;

/// Whether what a format cannot hold is a rounding of coordinates too fine for a warning.
///
/// @param lost "coordinates finer than 1e-9, 1e-9, 1e-9 (x, y, z)", or something else.
/// @param diagonal of the mesh; 0: every digit counts.
/// @param tolerance the distance that is promised.
bool isFineRounding(const std::string& lost, double diagonal,
                    double tolerance = std::numeric_limits<double>::infinity());

/// Writes the warnings of a conversion, and a line of what the format cannot hold.
void warnOfConversion(const ConvertedMesh& converted, const std::string& input, std::string_view format,
                      const Session& session);

/// The line that says how far floats would move the vertices of a mesh that doubles hold.
std::string doublesText(double movedByFloats);

/// The text of a mesh that was written: "part.obj: 12 triangles, 8 vertices", and the files beside it.
std::string writtenText(const std::string& output, const ConvertedMesh& converted);

/// What a command answers of a mesh that it wrote.
Json writtenJson(const std::string& input, const std::string& output, std::string_view format,
                 const ConvertedMesh& converted);

}  // namespace arete
