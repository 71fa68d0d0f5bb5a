// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comparisons are written so that NaN fails them.
#include "terrain/builder/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mt/hole_limit.h"
#include "terrain/model/build_options.h"

namespace arete {

static_assert(kMaxHoleCorners - 1 == kMostDegree);

Status checkSpan(const Vec3& span, const std::string& source) {
  constexpr double kMost = 1e30;
  if (span.x < kMost && span.y < kMost && span.z < kMost) return {};
  return failure(
      ErrorCode::invalidData,
      fmt::format("spans {} by {} metres, and {} in height: more than {}", span.x, span.y, span.z, kMost),
      source);
}

Status checkPositions(const RasterHeightfield& heightfield) {
  // Twice this, and the tolerance of measure() would reach a tenth of a pixel.
  constexpr double kMostPixels = 1.0 / 80;
  const Georeference& georeference = heightfield.georeference;
  const auto& g = georeference.geoTransform;
  const double area = std::abs(georeference.determinant());
  for (const double column : {-0.5, heightfield.columns - 0.5})
    for (const double row : {-0.5, heightfield.rows - 0.5}) {
      const Vec2 at = georeference.toSource(column, row);
      const double x = 0x1p-53 * std::max(std::abs(at.x), std::abs(g[0])),
                   y = 0x1p-53 * std::max(std::abs(at.y), std::abs(g[3]));
      const double pixels =
          std::max(x * std::abs(g[5]) + y * std::abs(g[2]), x * std::abs(g[4]) + y * std::abs(g[1])) / area;
      if (!(pixels <= kMostPixels))
        return failure(
            ErrorCode::invalidData,
            fmt::format("x {} and y {} are too far from the origin for pixels so small: numbers of 64 "
                        "bits round positions there by {:.2g} pixels",
                        at.x, at.y, pixels),
            heightfield.source);
    }
  return {};
}

std::string whyNoTriangle(const RasterHeightfield& heightfield) {
  std::size_t valid = 0;
  for (const double z : heightfield.heights) valid += std::isnan(z) ? 0 : 1;
  if (valid == 0) return "there is no valid sample";
  if (heightfield.columns < 2 || heightfield.rows < 2)
    return fmt::format("{} column(s) and {} row(s) enclose no area", heightfield.columns, heightfield.rows);
  return fmt::format("none of the {} valid samples has a cell with three valid corners", valid);
}

double roundingSlack(double low, double high) {
  return 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high));
}

double crossingSlack(double low, double high, std::uint32_t columns, std::uint32_t rows) {
  return roundingSlack(low, high) +
         8 * std::numeric_limits<double>::epsilon() * std::max(columns, rows) * (high - low);
}

}  // namespace arete
