// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/gdal/vector_layer.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "io/geo/gdal/support.h"

namespace arete {
namespace {

bool mayHold(OGRwkbGeometryType declared, LayerKind kind) {
  const OGRwkbGeometryType type = wkbFlatten(declared);
  if (kind == LayerKind::any) return type != wkbNone;
  if (type == wkbUnknown || type == wkbGeometryCollection) return true;
  if (kind == LayerKind::points) return type == wkbPoint || type == wkbMultiPoint;
  const bool isLines = OGR_GT_IsSubClassOf(type, wkbCurve) || OGR_GT_IsSubClassOf(type, wkbMultiCurve);
  if (kind == LayerKind::linesOrTable)
    return isLines || type == wkbNone || type == wkbPoint || type == wkbMultiPoint;
  if (kind == LayerKind::polygonsAndLines && isLines) return true;
  if (kind == LayerKind::surfaces && OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface)) return true;
  return OGR_GT_IsSubClassOf(type, wkbCurvePolygon) || OGR_GT_IsSubClassOf(type, wkbMultiSurface);
}

/// Whether a layer holds the vertices of another one's lines: the points of tracks and routes in a GPX file.
bool repeatsLines(GDALDataset& dataset, OGRLayer& layer) {
  const std::string_view name = layer.GetName();
  return dataset.GetDriver() && EQUAL(dataset.GetDriver()->GetDescription(), "GPX") &&
         (name == "track_points" || name == "route_points");
}

/// The only one of some layers that has features; null if there is none or several.
OGRLayer* onlyFilled(GDALDataset& dataset, const std::vector<std::string>& names) {
  const GdalErrors quiet;
  OGRLayer* found = nullptr;
  for (const std::string& name : names) {
    OGRLayer* const layer = dataset.GetLayerByName(name.c_str());
    layer->ResetReading();
    const bool isFilled = OGRFeatureUniquePtr(layer->GetNextFeature()) != nullptr;
    layer->ResetReading();
    if (!isFilled) continue;
    if (found) return nullptr;
    found = layer;
  }
  return found;
}

}  // namespace

Result<OGRLayer*> chooseLayer(GDALDataset& dataset, const std::string& name, LayerKind kind) {
  if (kind == LayerKind::shapes) {
    bool hasOthers = false, hasPoints = false;
    for (OGRLayer* layer : dataset.GetLayers()) {
      hasOthers = hasOthers || mayHold(layer->GetGeomType(), LayerKind::polygonsAndLines);
      hasPoints = hasPoints || mayHold(layer->GetGeomType(), LayerKind::points);
    }
    kind = hasOthers || !hasPoints ? LayerKind::polygonsAndLines : LayerKind::points;
  }
  std::vector<std::string> all, fitting;
  OGRLayer* found = nullptr;
  for (int i = 0; i < dataset.GetLayerCount(); ++i) {
    OGRLayer* layer = dataset.GetLayer(i);
    all.emplace_back(layer->GetName());
    if (!name.empty() && name == layer->GetName()) return layer;
    if (!mayHold(layer->GetGeomType(), kind)) continue;
    if (kind == LayerKind::any && repeatsLines(dataset, *layer)) continue;
    fitting.emplace_back(layer->GetName());
    found = layer;
  }
  if (all.empty()) return failure(ErrorCode::unsupported, "holds no vector layer");
  const char* what = kind == LayerKind::points             ? "points"
                     : kind == LayerKind::polygons         ? "polygons"
                     : kind == LayerKind::polygonsAndLines ? "polygons or lines"
                     : kind == LayerKind::linesOrTable     ? "lines or a table"
                     : kind == LayerKind::any              ? "points, lines or polygons"
                                                           : "surfaces";
  if (!name.empty())
    return failure(ErrorCode::notFound,
                   fmt::format("has no layer '{}'; its layers: {}", name, fmt::join(all, ", ")));
  if (fitting.empty())
    return failure(ErrorCode::unsupported,
                   fmt::format("has no layer of {}; its layers: {}", what, fmt::join(all, ", ")));
  // GPX has a layer for each thing that it can hold, mostly empty.
  if (fitting.size() > 1)
    if (OGRLayer* const only = onlyFilled(dataset, fitting)) return only;
  if (fitting.size() > 1)
    return failure(ErrorCode::unsupported, fmt::format("has {} layers that may hold {}; name one of them: {}",
                                                       fitting.size(), what, fmt::join(fitting, ", ")));
  return found;
}

}  // namespace arete
