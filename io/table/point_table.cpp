// SPDX-License-Identifier: GPL-3.0-or-later
//
// A name or content that looks like text goes to readPointText(), anything else to GDAL.
#include "io/table/point_table.h"

#include <fmt/format.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <limits>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/crs/transform.h"
#include "io/gdal/support.h"
#include "io/gdal/vector_layer.h"
#include "io/table/feature_rows.h"
#include "io/table/point_text.h"

namespace arete {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

class FeatureReader {
 public:
  FeatureReader(OGRLayer& layer, PointTable& table) : layer_(layer), table_(table) {
    table.attributes.columns.push_back({"source_fid", PointAttributes::Kind::integer});
    const OGRFeatureDefn& definition = *layer.GetLayerDefn();
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
      const OGRFieldDefn& field = *definition.GetFieldDefn(i);
      table.attributes.columns.push_back({field.GetNameRef(), kindOf(field.GetType())});
    }
  }

  Status add(OGRFeature& feature) {
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (!geometry || geometry->IsEmpty()) {
      addRow(feature, {kNone, kNone});
      return {};
    }
    const OGRwkbGeometryType type = wkbFlatten(geometry->getGeometryType());
    if (type == wkbPoint) {
      addRow(feature, {geometry->toPoint()->getX(), geometry->toPoint()->getY()});
    } else if (type == wkbMultiPoint) {
      for (const OGRPoint* point : *geometry->toMultiPoint()) addRow(feature, {point->getX(), point->getY()});
    } else {
      return failure(ErrorCode::unsupported,
                     fmt::format("feature {} of the layer '{}' is a {}, not a point", feature.GetFID(),
                                 layer_.GetName(), geometry->getGeometryName()));
    }
    return {};
  }

 private:
  void addRow(OGRFeature& feature, Vec2 place) {
    table_.stated.push_back(place);
    table_.attributes.add(fmt::format("{}", feature.GetFID()));
    for (int i = 0; i < feature.GetFieldCount(); ++i) table_.attributes.add(fieldText(feature, i));
  }

  OGRLayer& layer_;
  PointTable& table_;
};

Status readLayer(OGRLayer& layer, PointTable& table, const RunContext& context) {
  const GdalErrors errors;
  FeatureReader reader(layer, table);
  return forFeatures(layer, errors, context, [&](OGRFeature& feature) { return reader.add(feature); });
}

Result<PointTable> readFrom(const std::string& path, const Georeference& dem,
                            const PointTableOptions& options, const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  PointTable table;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  const bool isText = looksLikePointText(path);
  Result<CrsTransform> transform = CrsTransform();
  if (isText) {
    if (!options.layer.empty())
      return failure(ErrorCode::usage, fmt::format("is text, which has no layer '{}'", options.layer));
    auto rows = readPointText(path, {}, table.warnings, context, PointTextColumns::plan, &table.attributes);
    if (!rows) return tl::unexpected(rows.error());
    table.stated = std::move(rows->positions);
    table.attributes.findKinds();
    transform = transformOf(nullptr, dem, options.lonLat, isText, table.warnings);
  } else {
    const GdalDatasetPtr dataset = openGdal(path, GDAL_OF_VECTOR);
    if (!dataset) return tl::unexpected(explainOpenFailure(path, "set of points", errors));
    const auto layer = chooseLayer(*dataset, options.layer, LayerKind::points);
    if (!layer) return tl::unexpected(layer.error());
    if (Status read = readLayer(**layer, table, context); !read) return tl::unexpected(read.error());
    transform = transformOf((*layer)->GetSpatialRef(), dem, options.lonLat, isText, table.warnings);
  }
  if (!transform) return tl::unexpected(transform.error());
  if (table.stated.empty()) return failure(ErrorCode::invalidData, "holds no point");
  errors.moveTo(table.warnings);
  table.crsWkt = transform->sourceWkt().empty() ? dem.crsWkt : transform->sourceWkt();
  table.positions = table.stated;
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
