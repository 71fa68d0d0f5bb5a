// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/files/text/stated_size.h"
#include "io/geo/crs/data_unit.h"

namespace arete {

Result<std::vector<SurfaceTolerance>> parseSurfaceTolerances(const std::string& option,
                                                             const std::string& text, double diagonal,
                                                             const DataUnit& unit) {
  ARETE_TRY(const std::vector<StatedSize> sizes, parseStatedSizes(text, option, &unit));
  std::vector<SurfaceTolerance> tolerances;
  for (const StatedSize& size : sizes) {
    const double distance = size.of(diagonal);
    if (std::ranges::count(tolerances, distance, &SurfaceTolerance::distance) > 0)
      return failure(ErrorCode::usage, fmt::format("has {} twice", size.text), option);
    tolerances.push_back({size.text, distance});
  }
  return tolerances;
}

DataUnit spaceUnitOf(const SurfaceModel& model) {
  return spaceUnitOf(model.crsWkt, model.verticalUnit);
}

DataUnit spaceUnitOf(const MeshFile& file) {
  return spaceUnitOf(file.crsWkt, file.verticalUnit);
}

std::string withShare(double distance, double diagonal) {
  return fmt::format("{:.6g} ({:.4g} % of the diagonal)", distance, 100 * distance / diagonal);
}

}  // namespace arete
