// SPDX-License-Identifier: GPL-3.0-or-later
//
// A name or content that looks like text goes to readPointText(), anything else to GDAL.
#include "io/geo/table/plan_point_reader.h"

#include <fmt/format.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/reader.h"
#include "io/geo/crs/transform.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/vector_file.h"
#include "io/geo/gdal/vector_layer.h"
#include "io/geo/table/feature_rows.h"
#include "io/geo/text/point_text.h"

namespace arete {
namespace {

Result<CrsTransform> transformation(const OGRSpatialReference* own, const std::string& targetCrs,
                                    Warnings& warnings) {
  if (!isKnownCrs(own)) {
    if (!targetCrs.empty())
      warnings.push_back({WarningCode::position, "has no CRS; its coordinates are taken as the DEM's"});
    return CrsTransform();
  }
  if (targetCrs.empty())
    return failure(ErrorCode::invalidData,
                   "has a CRS and the DEM has none, so the points cannot be transformed; "
                   "`crs` states the DEM's");
  return CrsTransform::between(wktOf(*own), targetCrs);
}

Status addPoint(const OGRPoint& point, const CrsTransform& toTarget, std::vector<Vec2>& positions) {
  // An empty point has no position and is passed over.
  if (point.IsEmpty()) return {};
  const auto p = toTarget({point.getX(), point.getY()});
  if (!p || !std::isfinite(p->x) || !std::isfinite(p->y))
    return failure(
        ErrorCode::invalidData,
        fmt::format("the point {} {} is outside the domain of the DEM's CRS", point.getX(), point.getY()));
  positions.push_back(*p);
  return {};
}

Status addGeometry(const OGRGeometry& geometry, const CrsTransform& toTarget, std::vector<Vec2>& positions) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPoint) return addPoint(*geometry.toPoint(), toTarget, positions);
  if (type != wkbMultiPoint)
    return failure(ErrorCode::unsupported,
                   fmt::format("holds a {}, not a point", geometry.getGeometryName()));
  for (const OGRPoint* point : *geometry.toMultiPoint()) ARETE_CHECK(addPoint(*point, toTarget, positions));
  return {};
}

Result<PlanPoints> readFrom(const std::string& path, const std::string& targetCrs,
                            const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  PlanPoints read;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  if (looksLikePointText(path, 2)) {
    ARETE_TRY(auto rows, readPointText(path, {}, read.warnings, context, PointTextColumns::plan));
    // Text names its CRS by an SRID; without one its coordinates are the DEM's.
    if (rows.srid != 0) {
      ARETE_TRY(const auto crs, crsFromText(fmt::format("EPSG:{}", rows.srid)));
      ARETE_TRY(const auto toTarget, transformation(&crs, targetCrs, read.warnings));
      for (const Vec2 place : rows.positions)
        ARETE_CHECK(addPoint({place.x, place.y}, toTarget, read.positions));
    } else {
      read.positions = std::move(rows.positions);
    }
  } else {
    ARETE_TRY(const auto dataset, openVectors(path, "set of points", errors, read.warnings));
    ARETE_TRY(const auto layer, chooseLayer(*dataset, {}, LayerKind::points));
    ARETE_TRY(const auto toTarget, transformation(layer->GetSpatialRef(), targetCrs, read.warnings));
    ARETE_CHECK(forFeatures(*dataset, *layer, errors, context, [&](OGRFeature& feature) -> Status {
      const OGRGeometry* geometry = feature.GetGeometryRef();
      return geometry ? addGeometry(*geometry, toTarget, read.positions) : Status();
    }));
    errors.moveTo(read.warnings);
  }
  if (read.positions.empty()) return failure(ErrorCode::invalidData, "holds no point");
  return read;
}

}  // namespace

Result<PlanPoints> readPlanPoints(const std::string& path, const std::string& targetCrs,
                                  const RunContext& context) try {
  auto read = readFrom(path, targetCrs, context);
  if (!read && read.error().culprit.empty()) read.error().culprit = path;
  return read;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
