// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/point_table.h"

#include <fmt/format.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/crs_reader.h"
#include "io/crs_transform.h"
#include "io/gdal_support.h"
#include "io/point_text.h"
#include "io/vector_layer.h"

namespace arete {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFeaturesPerReport = 4096;

PointAttributes::Kind kindOf(OGRFieldType type) {
  switch (type) {
    case OFTInteger:
    case OFTInteger64:
      return PointAttributes::Kind::integer;
    case OFTReal:
      return PointAttributes::Kind::real;
    default:
      return PointAttributes::Kind::text;
  }
}

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
    for (int i = 0; i < feature.GetFieldCount(); ++i) {
      if (!feature.IsFieldSetAndNotNull(i))
        table_.attributes.add({});
      else if (feature.GetFieldDefnRef(i)->GetType() == OFTReal)  // all digits, which GDAL's text has not
        table_.attributes.add(fmt::format("{}", feature.GetFieldAsDouble(i)));
      else
        table_.attributes.add(feature.GetFieldAsString(i));
    }
  }

  OGRLayer& layer_;
  PointTable& table_;
};

Status readLayer(OGRLayer& layer, PointTable& table, const RunContext& context) {
  const GdalErrors errors;
  FeatureReader reader(layer, table);
  const double total = double(layer.GetFeatureCount(false));
  layer.ResetReading();
  for (std::size_t n = 0;; ++n) {
    if (n % kFeaturesPerReport == 0) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
      context.report("reading", total > 0 ? std::min(1.0, double(n) / total) : 0);
    }
    const OGRFeatureUniquePtr feature(layer.GetNextFeature());
    if (!feature) break;
    if (Status added = reader.add(*feature); !added) return added;
  }
  if (errors.anyFailure())
    return failure(ErrorCode::unreadable,
                   fmt::format("the layer '{}' cannot be read: {}", layer.GetName(), errors.firstFailure()));
  context.report("reading", 1);
  return {};
}

/// What brings the stated coordinates into the DEM's CRS.
Result<CrsTransform> transformOf(const OGRSpatialReference* own, const Georeference& dem, bool lonLat,
                                 bool isText, std::vector<std::string>& warnings) {
  if (!isKnownCrs(own)) {
    if (lonLat) return CrsTransform::fromLonLat(dem);
    if (!isText && !dem.crsWkt.empty())
      warnings.push_back("has no CRS; its coordinates are taken as the DEM's");
    return CrsTransform();
  }
  if (dem.crsWkt.empty())
    return failure(ErrorCode::invalidData,
                   "has a CRS and the DEM has none, so they cannot be brought together; --crs states the "
                   "DEM's when it is built");
  if (lonLat) warnings.push_back("has a CRS of its own, which is used instead of --lonlat");
  return CrsTransform::between(wktOf(*own), dem.crsWkt);
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
                                  const PointTableOptions& options, const RunContext& context) {
  auto table = readFrom(path, dem, options, context);
  if (!table && table.error().culprit.empty()) table.error().culprit = path;
  return table;
}

}  // namespace arete
