// SPDX-License-Identifier: GPL-3.0-or-later
//
// A name or content that looks like text goes to readPointText(), anything else to GDAL.
#include "io/geo/table/point_table.h"

#include <fmt/format.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool isPlace(Vec2 p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Gathers the rows of features: the number of the feature, then its fields. A row without a position stays,
/// so that rows of the answer match rows of the file.
class FeatureReader {
 public:
  FeatureReader(OGRLayer& layer, PointTable& table) : layer_(layer), table_(table) {
    table.attributes.columns.push_back({"source_fid", PointAttributes::Kind::integer});
    const OGRFeatureDefn& definition = *layer.GetLayerDefn();
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
      const OGRFieldDefn& field = *definition.GetFieldDefn(i);
      table.attributes.columns.push_back({field.GetNameRef(), kindOf(field)});
    }
  }

  Status add(OGRFeature& feature) {
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (!geometry || geometry->IsEmpty()) {
      addRow(feature, {kNone, kNone}, kNone);
      ++table_.withoutPlace;
      return {};
    }
    const OGRwkbGeometryType type = wkbFlatten(geometry->getGeometryType());
    if (type == wkbPoint) {
      addPoint(feature, *geometry->toPoint());
    } else if (type == wkbMultiPoint) {
      for (const OGRPoint* point : *geometry->toMultiPoint()) addPoint(feature, *point);
    } else {
      return failure(ErrorCode::unsupported,
                     fmt::format("feature {} of the layer '{}' is a {}, not a point", feature.GetFID(),
                                 layer_.GetName(), geometry->getGeometryName()));
    }
    return {};
  }

 private:
  // A feature of several points is a row for each, with equal attributes. Positions that are not finite count
  // as missing.
  void addPoint(OGRFeature& feature, const OGRPoint& point) {
    const auto stated = [&](double value) {
      return !point.IsEmpty() && std::isfinite(value) ? value : kNone;
    };
    const Vec2 place = {stated(point.getX()), stated(point.getY())};
    table_.withoutPlace += isPlace(place) ? 0 : 1;
    addRow(feature, place, point.Is3D() ? stated(point.getZ()) : kNone);
  }

  void addRow(OGRFeature& feature, Vec2 place, double z) {
    table_.stated.push_back(place);
    table_.z.push_back(z);
    table_.attributes.add(fmt::format("{}", feature.GetFID()));
    for (int i = 0; i < feature.GetFieldCount(); ++i) table_.attributes.add(fieldText(feature, i));
  }

  OGRLayer& layer_;
  PointTable& table_;
};

Status readLayer(GDALDataset& dataset, OGRLayer& layer, PointTable& table, const RunContext& context) {
  GdalErrors errors;
  FeatureReader reader(layer, table);
  const Status read =
      forFeatures(dataset, layer, errors, context, [&](OGRFeature& feature) { return reader.add(feature); });
  errors.moveTo(table.warnings);
  return read;
}

/// The CRS that the points of a text state.
Result<OGRSpatialReference> crsOfSrid(int srid) {
  if (srid == 0) return OGRSpatialReference();
  return crsFromText(fmt::format("EPSG:{}", srid));
}

Result<PointTable> readFrom(const std::string& path, const Georeference& dem,
                            const PointTableOptions& options, const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  PointTable table;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  const bool isText = looksLikePointText(path, 2);
  Result<CrsTransform> transform = CrsTransform();
  if (isText) {
    if (!options.layer.empty())
      return failure(ErrorCode::usage, fmt::format("is text, which has no layer '{}'", options.layer));
    ARETE_TRY(auto rows, readPointText(path, {}, table.warnings, context, PointTextColumns::planRows,
                                       &table.attributes));
    table.stated = std::move(rows.positions);
    table.z = std::move(rows.heights);
    table.withoutPlace = rows.withoutPlace;
    table.xName = rows.xName;
    table.yName = rows.yName;
    table.attributes.findKinds();
    ARETE_TRY(const auto crs, crsOfSrid(rows.srid));
    transform = transformOf(&crs, dem, options.lonLat, isText, table.warnings);
  } else {
    ARETE_TRY(const auto dataset, openVectors(path, "set of points", errors, table.warnings));
    ARETE_TRY(const auto layer, chooseLayer(*dataset, options.layer, LayerKind::points));
    ARETE_CHECK(readLayer(*dataset, *layer, table, context));
    transform = transformOf(layer->GetSpatialRef(), dem, options.lonLat, isText, table.warnings);
  }
  if (!transform) return tl::unexpected(transform.error());
  if (table.stated.empty()) return failure(ErrorCode::invalidData, "holds no point");
  if (std::ranges::all_of(table.z, [](double z) { return std::isnan(z); })) table.z.clear();
  errors.moveTo(table.warnings);
  table.crsWkt = transform->sourceWkt().empty() ? dem.crsWkt : transform->sourceWkt();
  table.positions = table.stated;
  // One coordinate is no position, though the row keeps it.
  for (Vec2& position : table.positions)
    if (!isPlace(position)) position = {kNone, kNone};
  transform->apply(table.positions);
  return table;
}

}  // namespace

Result<PointTable> readPointTable(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options, const RunContext& context) try {
  auto table = readFrom(path, dem, options, context);
  if (!table && table.error().culprit.empty()) table.error().culprit = path;
  return table;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
