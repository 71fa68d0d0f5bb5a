// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// A distance as a user states it: in the file's unit, or as a share of the diagonal.
struct SurfaceTolerance {
  std::string text;  ///< "0.5%"
  double distance = 0;
  bool operator==(const SurfaceTolerance&) const = default;
};

/// Parses tolerances with commas between: "0.01", "0.5%", "inf". Errors: usage, naming the option and the
/// part that is no distance.
Result<std::vector<SurfaceTolerance>> parseSurfaceTolerances(const std::string& option,
                                                             const std::string& text, double diagonal);

/// "0.0123 (0.48 % of the diagonal)".
std::string withShare(double distance, double diagonal);

}  // namespace arete
