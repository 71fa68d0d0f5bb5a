// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL reports a failure while reading only through its error handler: a layer that ends early looks like a
// shorter one. So the collected errors are checked after the last feature.
#include "io/table/feature_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "io/crs/reader.h"

namespace arete {
namespace {

constexpr std::size_t kFeaturesPerReport = 4096;

}  // namespace

Status forFeatures(OGRLayer& layer, const GdalErrors& errors, const RunContext& context,
                   const std::function<Status(OGRFeature&)>& add) {
  const double total = double(layer.GetFeatureCount(false));
  layer.ResetReading();
  for (std::size_t n = 0;; ++n) {
    if (n % kFeaturesPerReport == 0) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
      context.report("reading", total > 0 ? std::min(1.0, double(n) / total) : 0);
    }
    const OGRFeatureUniquePtr feature(layer.GetNextFeature());
    if (!feature) break;
    if (Status added = add(*feature); !added) return added;
  }
  if (errors.anyFailure())
    return failure(ErrorCode::unreadable,
                   fmt::format("the layer '{}' cannot be read: {}", layer.GetName(), errors.firstFailure()));
  context.report("reading", 1);
  return {};
}

PointAttributes::Kind kindOf(OGRFieldType type) {
  return type == OFTInteger || type == OFTInteger64 ? PointAttributes::Kind::integer
         : type == OFTReal                          ? PointAttributes::Kind::real
                                                    : PointAttributes::Kind::text;
}

std::string fieldText(OGRFeature& feature, int field) {
  if (!feature.IsFieldSetAndNotNull(field)) return {};
  if (feature.GetFieldDefnRef(field)->GetType() == OFTReal)  // all digits, unlike GDAL's text
    return fmt::format("{}", feature.GetFieldAsDouble(field));
  return feature.GetFieldAsString(field);
}

Result<CrsTransform> transformOf(const OGRSpatialReference* own, const Georeference& dem, bool lonLat,
                                 bool isTable, std::vector<std::string>& warnings) {
  if (!isKnownCrs(own)) {
    if (lonLat) return CrsTransform::fromLonLat(dem);
    if (!isTable && !dem.crsWkt.empty())
      warnings.push_back("has no CRS; its coordinates are taken as the DEM's");
    return CrsTransform();
  }
  if (dem.crsWkt.empty())
    return failure(ErrorCode::invalidData,
                   "has a CRS and the DEM has none, so the points cannot be transformed; "
                   "`crs` states the DEM's when it is built");
  if (lonLat) warnings.push_back("has a CRS of its own, so `lonLat` is ignored");
  return CrsTransform::between(wktOf(*own), dem.crsWkt);
}

}  // namespace arete
