// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/laws/compare_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"

namespace arete {
namespace {

tl::unexpected<Error> differs(std::string what) {
  return failure(ErrorCode::brokenPromise, std::move(what));
}

std::string nameOf(double height) {
  return std::isnan(height) ? "NODATA" : fmt::format("{}", height);
}

std::vector<std::array<double, 3>> sortedPoints(const PointHeightfield& field) {
  std::vector<std::array<double, 3>> points(field.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {field.positions[i].x, field.positions[i].y, field.heights[i]};
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace

Result<std::uint64_t> compareWithSource(const TerrainModel& model, const RasterHeightfield& source) try {
  if (!model.isRaster)
    return differs("the model was built from scattered points, and the source is a raster");
  if (model.columns != source.columns || model.rows != source.rows)
    return differs(fmt::format("the model has {} columns and {} rows, the source {} and {}", model.columns,
                               model.rows, source.columns, source.rows));
  if (model.georeference.geoTransform != source.georeference.geoTransform)
    return differs("the model and the source have different geotransforms");
  const RasterHeightfield own = model.rasterSamples();
  std::uint64_t different = 0;
  std::size_t first = 0;
  for (std::size_t i = own.size(); i-- > 0;) {
    const double mine = own.heights[i], theirs = source.heights[i];
    if (mine == theirs || (std::isnan(mine) && std::isnan(theirs))) continue;
    ++different;
    first = i;
  }
  if (different > 0)
    return differs(
        fmt::format("{} of {} heights {} from the source; the first at column {}, row {}: {} in the "
                    "model, {} in the source",
                    different, own.size(), agreeing(different, "differs", "differ"), first % own.columns,
                    first / own.columns, nameOf(own.heights[first]), nameOf(source.heights[first])));
  return own.size();
} catch (...) {
  return caughtFailure();
}

Result<std::uint64_t> compareWithSource(const TerrainModel& model, const PointHeightfield& source) try {
  if (model.isRaster) return differs("the model was built from a raster, and the source is a set of points");
  const auto mine = sortedPoints(model.pointSamples()), theirs = sortedPoints(source);
  const auto [here, there] = std::ranges::mismatch(mine, theirs);
  if (here == mine.end() && there == theirs.end()) return mine.size();
  const auto& p = there == theirs.end() || (here != mine.end() && *here < *there) ? *here : *there;
  return differs(
      fmt::format("{} in the model, {} in the source; x {}, y {}, height {} is only in the {}",
                  counted(mine.size(), "point", "points"), theirs.size(), p[0], p[1], p[2],
                  there == theirs.end() || (here != mine.end() && *here < *there) ? "model" : "source"));
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
