// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines and polygons are collected apart. GEOS unites several polygons before the reprojection, while shared
// borders still have the same numbers. The rings are then reprojected vertex by vertex; an edge, which is
// straight in the file, is bisected until its reprojection bends by no more than the tolerance.
#include "io/extract/region_reader.h"

#include <fmt/format.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/crs/reader.h"
#include "io/gdal/support.h"
#include "io/gdal/vector_layer.h"

namespace arete {
namespace {

constexpr double kBendTolerance = 1e-4;
constexpr int kMostBisections = 12;
constexpr std::size_t kFeaturesPerReport = 256;

using Chain = std::vector<Vec2>;

struct TransformationCloser {
  void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
};
using TransformationPtr = std::unique_ptr<OGRCoordinateTransformation, TransformationCloser>;

/// The geometries of a layer; lines only if takesLines.
struct Shapes {
  bool takesLines = false;
  OGRMultiPolygon polygons = {};
  OGRMultiLineString lines = {};
  std::size_t others = 0;  // geometries that are neither
};

void collect(const OGRGeometry& geometry, Shapes& all) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon || type == wkbTriangle) {
    OGRPolygon polygon(*geometry.toPolygon());
    polygon.flattenTo2D();
    if (!polygon.IsEmpty()) all.polygons.addGeometry(&polygon);
  } else if (type == wkbLineString && all.takesLines) {
    OGRLineString line(*geometry.toLineString());
    line.flattenTo2D();
    if (line.getNumPoints() > 1) all.lines.addGeometry(&line);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, all);
  } else {
    ++all.others;
  }
}

Status collectLayer(OGRLayer& layer, Shapes& all, std::vector<std::string>& warnings,
                    const RunContext& context) {
  GdalErrors errors;
  layer.ResetReading();
  for (std::size_t n = 0;; ++n) {
    if (n % kFeaturesPerReport == 0 && context.cancelled())
      return failure(ErrorCode::interrupted, "reading was stopped");
    const OGRFeatureUniquePtr feature(layer.GetNextFeature());
    if (!feature) break;
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (!geometry) continue;
    const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
    if (linear) collect(*linear, all);
  }
  if (errors.anyFailure())
    return failure(ErrorCode::unreadable,
                   fmt::format("the layer '{}' cannot be read: {}", layer.GetName(), errors.firstFailure()));
  errors.moveTo(warnings);
  if (all.polygons.IsEmpty() && all.lines.IsEmpty())
    return failure(ErrorCode::invalidData, fmt::format("the layer '{}' has no polygon{}", layer.GetName(),
                                                       all.takesLines ? " and no line" : ""));
  if (all.others > 0)
    warnings.push_back(fmt::format("{} geometries that are no polygons{} are left out", all.others,
                                   all.takesLines ? " or lines" : ""));
  return {};
}

/// The union of the polygons, or the polygons themselves, with a warning, where GEOS cannot make it.
OGRMultiPolygon unite(const OGRMultiPolygon& all, std::vector<std::string>& warnings) {
  if (all.getNumGeometries() < 2) return all;
  GdalErrors quiet;
  const std::unique_ptr<OGRGeometry> united(OGRGeometryFactory::haveGEOS() ? all.UnionCascaded() : nullptr);
  Shapes result;
  if (united) collect(*united, result);
  if (!result.polygons.IsEmpty()) return result.polygons;
  warnings.push_back("the polygons cannot be united; where two of them overlap counts as outside");
  return all;
}

/// Reprojects positions; a null transformation leaves them.
class Reprojection {
 public:
  Status prepare(const OGRSpatialReference& source, const OGRSpatialReference& target) {
    if (source.IsSame(&target)) return {};
    GdalErrors errors;
    transformation_.reset(OGRCreateCoordinateTransformation(&source, &target));
    if (transformation_) return {};
    return failure(ErrorCode::invalidData,
                   fmt::format("there is no way from its CRS to that of the DEM: {}", errors.firstFailure()));
  }

  bool operator()(Vec2& p) const {
    return !transformation_ ||
           (transformation_->Transform(1, &p.x, &p.y) && std::isfinite(p.x) && std::isfinite(p.y));
  }

  bool isIdentity() const { return transformation_ == nullptr; }

 private:
  TransformationPtr transformation_;
};

/// Appends the reprojected vertices of the edge a -> b that lie strictly inside it.
bool bendEdge(const Reprojection& reproject, Vec2 a, Vec2 b, Vec2 projectedA, Vec2 projectedB, int bisections,
              Chain& ring) {
  const Vec2 middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
  Vec2 projected = middle;
  if (!reproject(projected)) return false;
  const double bend = std::hypot(projected.x - (projectedA.x + projectedB.x) / 2,
                                 projected.y - (projectedA.y + projectedB.y) / 2);
  const double length = std::hypot(projectedB.x - projectedA.x, projectedB.y - projectedA.y);
  if (bend <= kBendTolerance * length || bisections == 0) return true;
  if (!bendEdge(reproject, a, middle, projectedA, projected, bisections - 1, ring)) return false;
  ring.push_back(projected);
  return bendEdge(reproject, middle, b, projected, projectedB, bisections - 1, ring);
}

/// Appends a ring, or a line, reprojected; nothing where too few vertices differ.
Status addChain(const OGRSimpleCurve& source, bool isRing, const Reprojection& reproject,
                std::vector<Chain>& chains) {
  Chain original;
  for (int i = 0; i < source.getNumPoints(); ++i) {
    const Vec2 p{source.getX(i), source.getY(i)};
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      return failure(ErrorCode::invalidData, "has a vertex that is not finite");
    if (original.empty() || !(original.back() == p)) original.push_back(p);
  }
  while (isRing && original.size() > 1 && original.front() == original.back()) original.pop_back();
  if (original.size() < (isRing ? 3 : 2)) return {};
  if (reproject.isIdentity()) {
    chains.push_back(std::move(original));
    return {};
  }
  Chain chain, projected = original;
  bool inside = true;
  for (Vec2& p : projected) inside = inside && reproject(p);
  for (std::size_t i = 0; inside && i < original.size(); ++i) {
    chain.push_back(projected[i]);
    const std::size_t next = (i + 1) % original.size();
    if (next == 0 && !isRing) break;
    inside = bendEdge(reproject, original[i], original[next], projected[i], projected[next], kMostBisections,
                      chain);
  }
  if (!inside) return failure(ErrorCode::invalidData, "has a vertex that the CRS of the DEM cannot tell");
  chains.push_back(std::move(chain));
  return {};
}

Result<RegionRead> readFrom(const std::string& path, const std::string& targetCrs,
                            const RegionReadOptions& options, const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  RegionRead read;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  const GdalDatasetPtr dataset = openGdal(path, GDAL_OF_VECTOR);
  if (!dataset) return tl::unexpected(explainOpenFailure(path, "set of polygons", errors));
  auto layer = chooseLayer(*dataset, options.layer,
                           options.takesLines ? LayerKind::polygonsAndLines : LayerKind::polygons);
  if (!layer) return tl::unexpected(layer.error());
  Shapes shapes{.takesLines = options.takesLines};
  if (Status status = collectLayer(**layer, shapes, read.warnings, context); !status)
    return tl::unexpected(status.error());
  const OGRMultiPolygon polygons = unite(shapes.polygons, read.warnings);

  auto source = chooseCrs((*layer)->GetSpatialRef(), options.crs, read.warnings);
  if (!source) return tl::unexpected(source.error());
  auto target = targetCrs.empty() ? OGRSpatialReference() : crsFromText(targetCrs);
  if (!target) return tl::unexpected(target.error());
  Reprojection reproject;
  if (!source->IsEmpty() && !target->IsEmpty()) {
    if (Status status = reproject.prepare(*source, *target); !status) return tl::unexpected(status.error());
  } else if (source->IsEmpty() != target->IsEmpty()) {
    read.lacksCrs = true;
    read.warnings.push_back(fmt::format("the CRS of the {} is not known; coordinates are taken as the DEM's",
                                        source->IsEmpty() ? "region" : "DEM"));
  }
  for (const OGRPolygon* polygon : polygons)
    for (const OGRLinearRing* ring : *polygon)
      if (Status status = addChain(*ring, true, reproject, read.rings); !status)
        return tl::unexpected(status.error());
  for (const OGRLineString* line : shapes.lines)
    if (Status status = addChain(*line, false, reproject, read.lines); !status)
      return tl::unexpected(status.error());
  if (read.rings.empty() && read.lines.empty())
    return failure(ErrorCode::invalidData, options.takesLines
                                               ? "has no polygon with an area and no line with a length"
                                               : "has no polygon with an area");
  return read;
}

}  // namespace

Result<RegionRead> readRegion(const std::string& path, const std::string& targetCrs,
                              const RegionReadOptions& options, const RunContext& context) try {
  auto read = readFrom(path, targetCrs, options, context);
  if (!read && read.error().culprit.empty()) read.error().culprit = path;
  return read;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
