// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each polygon is inserted as it is complete; all are one transaction, since SQLite commits each insertion on
// its own otherwise.
#include "io/geo/polygons/polygon_file.h"

#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/text_scan.h"
#include "io/geo/geopackage/geopackage.h"
#include "io/geo/polygons/ground_areas.h"

namespace arete {
namespace {

constexpr const char* kAnswer = "answer";
constexpr const char* kCells = "cells";
constexpr const char* kArea = "area_m2";
constexpr const char* kStage = "polygons";

std::unique_ptr<OGRPolygon> geometryOf(const CellPolygon& polygon, const Georeference& georeference) {
  auto geometry = std::make_unique<OGRPolygon>();
  for (const auto& corners : polygon.rings) {
    auto ring = std::make_unique<OGRLinearRing>();
    const int count = int(corners.size());
    ring->setNumPoints(count + 1, FALSE);
    for (int i = 0; i <= count; ++i) {
      const CellCorner& corner = corners[std::size_t(i % count)];
      // Samples stand half a cell from the corners.
      const Vec2 xy = georeference.hasGeoTransform
                          ? georeference.toSource(double(corner.column) - 0.5, double(corner.row) - 0.5)
                          : Vec2{double(corner.column), double(corner.row)};
      ring->setPoint(i, xy.x, xy.y);
    }
    geometry->addRingDirectly(ring.release());
  }
  return geometry;
}

Result<OGRLayer*> polygonLayer(GDALDataset& dataset, const Georeference& georeference,
                               const PolygonFields& fields, const GdalErrors& errors) {
  CPLStringList list;
  list.SetNameValue("SPATIAL_INDEX", "YES");
  ARETE_TRY(OGRLayer* const layer,
            addLayer(dataset, fields.layer, georeference.crsWkt, wkbPolygon, errors, list.List()));
  OGRFieldDefn answer(kAnswer, OFTString), cells(kCells, OFTInteger64), area(kArea, OFTReal);
  OGRFieldDefn value(fields.value.c_str(), OFTInteger);
  if (layer->CreateField(&answer) != OGRERR_NONE ||
      (!fields.value.empty() && layer->CreateField(&value) != OGRERR_NONE) ||
      layer->CreateField(&cells) != OGRERR_NONE || layer->CreateField(&area) != OGRERR_NONE)
    return cannotBeWritten(errors);
  return layer;
}

Status insertPolygons(GDALDataset& dataset, GdalErrors& errors, const CellValues& raster,
                      const Georeference& georeference, const PolygonFields& fields, PolygonReport& report,
                      const RunContext& context) {
  ARETE_TRY(OGRLayer* const layer, polygonLayer(dataset, georeference, fields, errors));
  errors.clear();
  auto areas = GroundAreas::of(georeference, raster.columns, raster.rows);
  report.hasAreas = areas.has_value();
  if (dataset.StartTransaction() != OGRERR_NONE) return cannotBeWritten(errors);
  const auto areaOf = [&](const CellRun& run) {
    return areas ? areas->ofRun(run.row, run.begin, run.end) : std::nan("");
  };
  const auto insert = [&](CellPolygon polygon) -> Status {
    OGRFeature feature(layer->GetLayerDefn());
    if (const std::string text = fields.answer(polygon.value); !text.empty())
      feature.SetField(kAnswer, text.c_str());
    if (!fields.value.empty() && fields.isNumber(polygon.value))
      feature.SetField(fields.value.c_str(), int(polygon.value));
    feature.SetField(kCells, GIntBig(polygon.cells));
    if (std::isfinite(polygon.area)) feature.SetField(kArea, polygon.area);
    feature.SetGeometryDirectly(geometryOf(polygon, georeference).release());
    if (layer->CreateFeature(&feature) != OGRERR_NONE) return cannotBeWritten(errors);
    ++report.polygons;
    return {};
  };
  ARETE_CHECK(forCellPolygons(raster, areaOf, insert, kStage, context));
  if (dataset.CommitTransaction() != OGRERR_NONE) return cannotBeWritten(errors);
  return {};
}

}  // namespace

Result<PolygonReport> writePolygons(const std::string& path, const CellValues& raster,
                                    const Georeference& georeference, const PolygonFields& fields,
                                    ExistingFile existing, const RunContext& context) try {
  if (text::lowerExtension(path) != "gpkg")
    return failure(ErrorCode::usage, "polygons are a GeoPackage and end in .gpkg", path);
  PolygonReport report;
  const auto insert = [&](GDALDataset& dataset, GdalErrors& errors) {
    return insertPolygons(dataset, errors, raster, georeference, fields, report, context);
  };
  Status status = writeGeoPackage(path, existing, {fields.layer, {kAnswer, kCells, kArea}}, insert, context);
  if (!status && status.error().culprit.empty()) status.error().culprit = path;
  if (!status) return tl::unexpected(status.error());
  return report;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
