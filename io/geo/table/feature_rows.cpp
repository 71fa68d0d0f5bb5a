// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL reports a failure while reading only through its error handler: a layer that ends early looks like a
// shorter one. So the collected errors are checked after the last feature.
#include "io/geo/table/feature_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "io/geo/crs/reader.h"
#include "io/geo/gdal/vector_file.h"

namespace arete {
namespace {

constexpr std::uint64_t kFeaturesPerReport = 4096;

/// "2020-02-29", "12:34:56.5", "2020-02-29T12:34:56+01:00"; without a zone where none is known.
std::string momentText(OGRFeature& feature, int field, OGRFieldType type) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, zone = 0;
  float second = 0;
  if (!feature.GetFieldAsDateTime(field, &year, &month, &day, &hour, &minute, &second, &zone))
    return feature.GetFieldAsString(field);
  const std::string date = fmt::format("{:04}-{:02}-{:02}", year, month, day);
  if (type == OFTDate) return date;
  // GDAL counts thousandths of a second, as floats.
  const int thousandths = static_cast<int>(std::lround(second * 1000));
  std::string time = fmt::format("{:02}:{:02}:{:02}", hour, minute, thousandths / 1000);
  if (thousandths % 1000 != 0) time += fmt::format(".{:03}", thousandths % 1000);
  constexpr int kUtc = 100, kMinutesPerStep = 15, kLeastZone = 2;
  if (zone >= kLeastZone) {
    const int minutes = std::abs(zone - kUtc) * kMinutesPerStep;
    time += zone == kUtc ? std::string("Z")
                         : fmt::format("{}{:02}:{:02}", zone < kUtc ? '-' : '+', minutes / 60, minutes % 60);
  }
  return type == OFTTime ? time : date + 'T' + time;
}

}  // namespace

Status forFeatures(GDALDataset& dataset, OGRLayer& layer, const GdalErrors& errors, const RunContext& context,
                   const std::function<Status(OGRFeature&)>& add) {
  const double total = double(layer.GetFeatureCount(false));
  layer.ResetReading();
  std::uint64_t n = 0;
  for (;; ++n) {
    if (n % kFeaturesPerReport == 0) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
      context.report("reading", total > 0 ? std::min(1.0, double(n) / total) : 0);
    }
    const OGRFeatureUniquePtr feature(layer.GetNextFeature());
    if (!feature) break;
    ARETE_CHECK(add(*feature));
  }
  if (errors.anyFailure())
    return failure(ErrorCode::unreadable,
                   fmt::format("the layer '{}' cannot be read: {}", layer.GetName(), errors.firstFailure()));
  ARETE_CHECK(checkFeatureCount(dataset, layer, n));
  context.report("reading", 1);
  return {};
}

PointAttributes::Kind kindOf(const OGRFieldDefn& field) {
  using Kind = PointAttributes::Kind;
  const OGRFieldSubType subtype = field.GetSubType();
  switch (field.GetType()) {
    case OFTInteger:
      return subtype == OFSTBoolean ? Kind::boolean
             : subtype == OFSTInt16 ? Kind::integer16
                                    : Kind::integer32;
    case OFTInteger64:
      return Kind::integer;
    case OFTReal:
      return subtype == OFSTFloat32 ? Kind::real32 : Kind::real;
    case OFTDate:
      return Kind::date;
    case OFTTime:
      return Kind::time;
    case OFTDateTime:
      return Kind::dateTime;
    case OFTBinary:
      return Kind::bytes;
    default:
      return subtype == OFSTJSON ? Kind::json : Kind::text;
  }
}

std::string fieldText(OGRFeature& feature, int field) {
  if (!feature.IsFieldSetAndNotNull(field)) return {};
  const OGRFieldDefn& definition = *feature.GetFieldDefnRef(field);
  switch (definition.GetType()) {
    case OFTReal:  // all digits, unlike GDAL's text
      return definition.GetSubType() == OFSTFloat32
                 ? fmt::format("{}", static_cast<float>(feature.GetFieldAsDouble(field)))
                 : fmt::format("{}", feature.GetFieldAsDouble(field));
    case OFTDate:
    case OFTTime:
    case OFTDateTime:
      return momentText(feature, field, definition.GetType());
    default:
      return feature.GetFieldAsString(field);
  }
}

Result<CrsTransform> transformOf(const OGRSpatialReference* own, const Georeference& dem, bool lonLat,
                                 bool isTable, Warnings& warnings) {
  if (!isKnownCrs(own)) {
    if (lonLat) return CrsTransform::fromLonLat(dem);
    if (!isTable && !dem.crsWkt.empty())
      warnings.push_back({WarningCode::position, "has no CRS; its coordinates are taken as the DEM's"});
    return CrsTransform();
  }
  if (dem.crsWkt.empty())
    return failure(ErrorCode::invalidData,
                   "has a CRS and the DEM has none, so the points cannot be transformed; "
                   "`crs` states the DEM's when it is built");
  if (lonLat) warnings.push_back({WarningCode::position, "has a CRS of its own, so `lonLat` is ignored"});
  return CrsTransform::between(wktOf(*own), dem.crsWkt);
}

}  // namespace arete
