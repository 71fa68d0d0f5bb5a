// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/heightfield.h"

#include <fmt/format.h>

#include "engine/base/caught_failure.h"
#include "terrain/model/heights_checksum.h"

namespace arete {

Status RasterHeightfield::validate() const try {
  if (heights.size() != std::size_t(columns) * rows)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} heights for {} columns and {} rows", heights.size(), columns, rows),
                   source);
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (std::isinf(heights[i]))
      return failure(ErrorCode::invalidData,
                     fmt::format("the height at column {}, row {} is infinite", i % columns, i / columns),
                     source);
  const double determinant = georeference.determinant();
  if (determinant == 0 || !std::isfinite(determinant))
    return failure(ErrorCode::invalidData, "the geotransform is not invertible", source);
  return {};
} catch (...) {
  return caughtFailure();
}

Status PointHeightfield::validate() const try {
  if (heights.size() != positions.size())
    return failure(ErrorCode::invalidData,
                   fmt::format("{} heights for {} positions", heights.size(), positions.size()), source);
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (!std::isfinite(heights[i]) || !std::isfinite(positions[i].x) || !std::isfinite(positions[i].y))
      return failure(ErrorCode::invalidData, fmt::format("point {} has a coordinate that is not finite", i),
                     source);
  return {};
} catch (...) {
  return caughtFailure();
}

namespace {

std::string checksumOf(std::uint64_t a, std::uint64_t b, const std::vector<Vec2>& positions,
                       const std::vector<double>& heights) {
  HeightsChecksum checksum(a, b);
  checksum.add(positions);
  checksum.add(heights);
  return checksum.text();
}

}  // namespace

std::string heightsChecksum(const RasterHeightfield& heightfield) {
  return checksumOf(heightfield.columns, heightfield.rows, {}, heightfield.heights);
}

std::string heightsChecksum(const PointHeightfield& heightfield) {
  return checksumOf(heightfield.size(), 0, heightfield.positions, heightfield.heights);
}

}  // namespace arete
