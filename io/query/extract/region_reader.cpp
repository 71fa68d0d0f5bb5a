// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines, points and polygons are collected apart. GEOS unites several polygons before the reprojection, while
// shared borders still have the same numbers. The rings are then reprojected (io/geo/crs/chain_projection.h).
#include "io/query/extract/region_reader.h"

#include <fmt/format.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "io/geo/bent/chain_transform.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/polygon_set.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/vector_file.h"
#include "io/geo/gdal/vector_layer.h"

namespace arete {
namespace {

constexpr std::size_t kFeaturesPerReport = 256;

using Chain = std::vector<Vec2>;

/// The geometries of a layer; lines and points only if they are taken.
struct Shapes {
  bool takesLines = false, takesPoints = false;
  OGRMultiPolygon polygons = {};
  OGRMultiLineString lines = {};
  Chain points = {};
  std::size_t others = 0;     // geometries that are none of these
  std::size_t openRings = 0;  // that do not end where they begin
  bool isEmpty() const { return polygons.IsEmpty() && lines.IsEmpty() && points.empty(); }
};

void collect(const OGRGeometry& geometry, Shapes& all) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon || type == wkbTriangle) {
    OGRPolygon polygon(*geometry.toPolygon());
    polygon.flattenTo2D();
    for (const OGRLinearRing* ring : polygon)
      if (!ring->IsEmpty() && !ring->get_IsClosed()) ++all.openRings;
    polygon.closeRings();  // GEOS takes no other
    if (!polygon.IsEmpty()) all.polygons.addGeometry(&polygon);
  } else if (type == wkbLineString && all.takesLines) {
    OGRLineString line(*geometry.toLineString());
    line.flattenTo2D();
    if (line.getNumPoints() > 1) all.lines.addGeometry(&line);
  } else if (type == wkbPoint && all.takesPoints) {
    const OGRPoint* point = geometry.toPoint();
    if (!point->IsEmpty()) all.points.push_back({point->getX(), point->getY()});
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, all);
  } else {
    ++all.others;
  }
}

Status collectLayer(GDALDataset& dataset, OGRLayer& layer, Shapes& all, Warnings& warnings,
                    const RunContext& context) {
  GdalErrors errors;
  layer.ResetReading();
  std::size_t n = 0, without = 0;
  for (;; ++n) {
    if (n % kFeaturesPerReport == 0 && context.cancelled())
      return failure(ErrorCode::interrupted, "reading was stopped");
    const OGRFeatureUniquePtr feature(layer.GetNextFeature());
    if (!feature) break;
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (!geometry || geometry->IsEmpty()) {
      ++without;
      continue;
    }
    const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
    if (linear) collect(*linear, all);
  }
  if (errors.anyFailure())
    return failure(ErrorCode::unreadable,
                   fmt::format("the layer '{}' cannot be read: {}", layer.GetName(), errors.firstFailure()));
  ARETE_CHECK(checkFeatureCount(dataset, layer, n));
  errors.moveTo(warnings);
  // Some of GDAL's drivers say so, once in a process; here it is counted.
  std::erase_if(warnings, [](const std::string& warning) {
    return warning.find("Non closed ring detected") != std::string::npos;
  });
  if (all.openRings > 0)
    warnings.push_back(
        {WarningCode::geometry, fmt::format("{} of its rings {}; an edge closes each", all.openRings,
                                            agreeing(all.openRings, "does not end where it begins",
                                                     "do not end where they begin"))});
  if (all.isEmpty())
    return failure(ErrorCode::invalidData,
                   fmt::format("the layer '{}' has no polygon{}{}", layer.GetName(),
                               all.takesLines ? " and no line" : "", all.takesPoints ? " and no point" : ""));
  if (without > 0)
    warnings.push_back({WarningCode::omitted, counted(without, "feature without a geometry is left out",
                                                      "features without a geometry are left out")});
  if (all.others > 0)
    warnings.push_back(
        {WarningCode::omitted,
         fmt::format("{}{}{} {} left out",
                     counted(all.others, "geometry that is no polygon", "geometries that are no polygons"),
                     all.takesLines ? agreeing(all.others, " or line", " or lines") : "",
                     all.takesPoints ? agreeing(all.others, " or point", " or points") : "",
                     agreeing(all.others, "is", "are"))});
  return {};
}

Status checkFinite(const Chain& chain) {
  for (const Vec2& p : chain)
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      return failure(ErrorCode::invalidData, "has a vertex that is not finite");
  return {};
}

Status checkFinite(const OGRMultiPolygon& polygons) {
  for (const OGRPolygon* polygon : polygons)
    for (const OGRLinearRing* ring : *polygon)
      for (const OGRPoint& point : *ring) ARETE_CHECK(checkFinite(Chain{{point.getX(), point.getY()}}));
  return {};
}

/// The vertices without repetitions.
Chain chainOf(const OGRLineString& line) {
  Chain chain;
  for (int i = 0; i < line.getNumPoints(); ++i) {
    const Vec2 p{line.getX(i), line.getY(i)};
    if (chain.empty() || !(chain.back() == p)) chain.push_back(p);
  }
  return chain;
}

void warnOfLongEdges(const OGRMultiPolygon& polygons, double turn, Warnings& warnings) {
  if (turn == 0) return;
  bool isFound = false;
  for (const OGRPolygon* polygon : polygons)
    for (const OGRLinearRing* ring : *polygon)
      for (int i = 1; i < ring->getNumPoints(); ++i)
        isFound = isFound || leadsTheLongWay(ring->getX(i) - ring->getX(i - 1), turn);
  if (isFound)
    warnings.push_back(
        {WarningCode::position,
         "has a polygon with an edge over more than half a turn of longitudes, which is taken as it is "
         "drawn, "
         "the long "
         "way; a shape that crosses the antimeridian is cut there, or goes on beyond 180 degrees"});
}

/// The polygons as rings that the even-odd rule understands, before they are reprojected.
Result<std::vector<Chain>> regionRings(const OGRMultiPolygon& polygons, const OGRSpatialReference& source,
                                       bool isReprojected, Warnings& warnings) {
  ARETE_CHECK(checkFinite(polygons));
  OGRMultiPolygon all = united(repaired(polygons, warnings), warnings);
  if (isReprojected) {
    Georeference onSource;
    ARETE_CHECK(describeCrs(source, onSource));
    all = withinOneTurn(all, turnOf(onSource), warnings);
  }
  return ringsOf(all);
}

Result<RegionRead> readFrom(const std::string& path, const std::string& targetCrs,
                            const RegionReadOptions& options, const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  RegionRead read;
  ARETE_TRY(const auto dataset, openVectors(path, "set of polygons", errors, read.warnings));
  ARETE_TRY(auto layer, chooseLayer(*dataset, options.layer,
                                    options.takesPoints  ? LayerKind::shapes
                                    : options.takesLines ? LayerKind::polygonsAndLines
                                                         : LayerKind::polygons));
  Shapes shapes{.takesLines = options.takesLines, .takesPoints = options.takesPoints};
  ARETE_CHECK(collectLayer(*dataset, *layer, shapes, read.warnings, context));

  ARETE_TRY(auto source, chooseCrs(layer->GetSpatialRef(), options.crs, read.warnings));
  ARETE_TRY(auto target, targetCrs.empty() ? OGRSpatialReference() : crsFromText(targetCrs));
  ChainTransform reproject;
  if (!source.IsEmpty() && !target.IsEmpty()) {
    ARETE_TRY(reproject, ChainTransform::between(source, target));
  } else if (source.IsEmpty() != target.IsEmpty()) {
    read.lacksCrs = true;
    read.warnings.push_back({WarningCode::position,
                             fmt::format("the CRS of the {} is not known; coordinates are taken as the DEM's",
                                         source.IsEmpty() ? "region" : "DEM")});
  }
  errors.moveTo(read.warnings);  // of the layer's CRS
  const double turn = turnOfDegrees(source);
  warnOfLongEdges(shapes.polygons, turn, read.warnings);
  ARETE_TRY(const auto rings, regionRings(shapes.polygons, source, !reproject.isIdentity(), read.warnings));
  for (const Chain& ring : rings) {
    ARETE_TRY(auto projected, reproject(ring, true));
    read.rings.push_back(std::move(projected));
  }
  for (const OGRLineString* line : shapes.lines) {
    Chain chain = chainOf(*line);
    takeShortWays(chain, turn);
    ARETE_CHECK(checkFinite(chain));
    if (chain.size() < 2) continue;
    ARETE_TRY(auto projected, reproject(chain, false));
    read.lines.push_back(std::move(projected));
  }
  for (const Vec2& point : shapes.points) {
    ARETE_CHECK(checkFinite(Chain{point}));
    ARETE_TRY(const auto projected, reproject(Chain{point}, false));
    read.points.push_back(projected.front());
  }
  if (read.rings.empty() && read.lines.empty() && read.points.empty())
    return failure(ErrorCode::invalidData, options.takesLines
                                               ? "has no polygon with an area and no line with a length"
                                               : "has no polygon with an area");
  return read;
}

/// A polygon of rings that need not be closed: the outer one and holes.
OGRPolygon polygonOf(const std::vector<Chain>& rings) {
  OGRPolygon polygon;
  for (const Chain& vertices : rings) {
    OGRLinearRing ring;
    for (const Vec2& p : vertices) ring.addPoint(p.x, p.y);
    ring.closeRings();
    ring.flattenTo2D();
    polygon.addRing(&ring);
  }
  return polygon;
}

}  // namespace

Result<RegionRead> regionOf(const std::vector<std::vector<std::vector<Vec2>>>& polygons,
                            const std::string& crs) try {
  registerGdal();
  RegionRead read;
  OGRMultiPolygon all;
  for (const auto& rings : polygons)
    if (!rings.empty() && rings.front().size() > 2) {
      const OGRPolygon polygon = polygonOf(rings);
      all.addGeometry(&polygon);
    }
  ARETE_TRY(const auto source, crs.empty() ? OGRSpatialReference() : crsFromText(crs));
  warnOfLongEdges(all, turnOfDegrees(source), read.warnings);
  ARETE_TRY(auto rings, regionRings(all, source, false, read.warnings));
  read.rings = std::move(rings);
  if (read.rings.empty()) return failure(ErrorCode::invalidData, "has no polygon with an area");
  return read;
} catch (...) {
  return caughtFailure();
}

Result<RegionRead> readRegion(const std::string& path, const std::string& targetCrs,
                              const RegionReadOptions& options, const RunContext& context) try {
  auto read = readFrom(path, targetCrs, options, context);
  if (!read && read.error().culprit.empty()) read.error().culprit = path;
  return read;
} catch (...) {
  return caughtFailure(path);
}

Result<std::vector<Vec2>> reprojectRing(const std::vector<Vec2>& ring, const std::string& fromCrs,
                                        const std::string& toCrs) try {
  registerGdal();
  ARETE_TRY(const auto source, crsFromUser(fromCrs));
  ARETE_TRY(const auto target, crsFromText(toCrs));
  ARETE_TRY(const auto reproject, ChainTransform::between(source, target));
  return reproject(ring, true);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
