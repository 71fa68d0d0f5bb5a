// SPDX-License-Identifier: GPL-3.0-or-later
//
// A text of points is read as every table of points is. Another text, for instance of lines in WKT, goes
// to GDAL as all other files do.
#include "io/geo/features/feature_layer.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/text_scan.h"
#include "io/geo/bent/chain_transform.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/reader.h"
#include "io/geo/features/chain_placer.h"
#include "io/geo/features/feature_collector.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/vector_file.h"
#include "io/geo/gdal/vector_layer.h"
#include "io/geo/table/feature_rows.h"
#include "io/geo/table/point_table.h"
#include "io/geo/text/cell_number.h"
#include "io/geo/text/column_rules.h"
#include "io/geo/text/point_text.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

/// How far an edge may be from where its file leads it, in spacings of the DEM's samples.
constexpr double kDeviation = 0.1;

/// Metres between neighbouring samples; of points on average.
double spacingOf(const TerrainModel& model) {
  const MetricFrame& metric = model.mt.metric();
  const double x = std::abs(metric.scale.x), y = std::abs(metric.scale.y);
  if (model.isRaster) return std::min(x, y);
  const Box2 box = planBox(model);
  const double area = (box.xMax - box.xMin) * x * (box.yMax - box.yMin) * y;
  return std::sqrt(area / std::max(1.0, double(model.mt.vertexCount())));
}

/// That in the unit of a CRS.
double inUnitOf(const OGRSpatialReference& crs, double metres) {
  return crs.IsGeographic() ? metres / (crs.GetSemiMajor() * crs.GetAngularUnits())
                            : metres / crs.GetLinearUnits();
}

/// Whether the coordinates of a layer are in the order y, x. GDAL's drivers lead nearly all of them to x, y.
bool swapsAxes(const OGRSpatialReference* crs) {
  if (!isKnownCrs(crs)) return false;
  OGRSpatialReference usual(*crs);
  usual.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const auto& stated = crs->GetDataAxisToSRSAxisMapping();
  const auto& wanted = usual.GetDataAxisToSRSAxisMapping();
  return stated.size() > 1 && wanted.size() > 1 && stated[0] == wanted[1] && stated[1] == wanted[0];
}

/// @param own of the file; may be null.
/// @param isTable its format states no CRS, so that its absence is not worth a warning.
Result<ChainPlacer> placerOf(const OGRSpatialReference* own, const TerrainModel& model,
                             const FeatureReadOptions& options, bool isTable, Warnings& warnings) {
  ARETE_TRY(OGRSpatialReference source, chooseCrs(isKnownCrs(own) ? own : nullptr, options.crs, warnings));
  const bool swaps = options.crs.empty() && swapsAxes(own);
  const LongitudeTurns turns(model);
  const std::string& demCrs = model.georeference.crsWkt;
  if (source.IsEmpty()) {
    if (!isTable && !demCrs.empty())
      warnings.push_back({WarningCode::position, "has no CRS; its coordinates are taken as the DEM's"});
    return ChainPlacer({}, turns, model.georeference.isGeographic ? turnOf(model.georeference) : 0, false);
  }
  if (demCrs.empty())
    return failure(ErrorCode::invalidData,
                   "has a CRS and the DEM has none, so the two cannot be brought together; `crs` states the "
                   "DEM's when it is built");
  source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  source.StripVertical();
  ARETE_TRY(OGRSpatialReference target, crsFromText(demCrs));
  target.StripVertical();
  const double deviation = inUnitOf(source, kDeviation * spacingOf(model));
  auto exact = ChainTransform::between(source, target, deviation, ChainTransform::Ballpark::refused);
  if (!exact) {
    ARETE_TRY(exact, ChainTransform::between(source, target, deviation));
    warnings.push_back(
        {WarningCode::position,
         "is in another datum than the DEM, and PROJ knows no transformation between the two, or "
         "lacks its grid; they are taken for the same, which may be metres off"});
  }
  return ChainPlacer(std::move(*exact), turns, turnOfDegrees(source), swaps);
}

bool isLonLatName(std::string_view name) {
  static constexpr std::array<std::string_view, 4> kNames = {"lon", "long", "longitude", "lng"};
  return std::ranges::find(kNames, text::lowered(name)) != kNames.end();
}

/// Units of the DEM's heights in a unit of the heights that a file states.
double heightFactor(const OGRSpatialReference* source, const Georeference& dem) {
  if (dem.verticalUnit.empty() || !isKnownCrs(source)) return 1;
  Georeference described;
  if (describeCrs(*source, described) && !described.verticalUnit.empty())
    return described.verticalUnitMetres / dem.verticalUnitMetres;
  return source->IsGeographic() ? 1 / dem.verticalUnitMetres : 1;
}

void scaleHeights(FeatureLayer& layer, double factor) {
  if (factor == 1) return;
  for (double& z : layer.z) z *= factor;
  for (auto& point : layer.points) point.z *= factor;
  for (auto& label : layer.labels) label.at.z *= factor;
}

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? std::string("none") : fmt::format("{}", fmt::join(names, ", "));
}

/// The heights of points by their column of heights, where they state none themselves; empty without one.
std::vector<double> heightsOf(PointTable& table) {
  if (!table.z.empty()) return std::move(table.z);
  const auto& columns = table.attributes.columns;
  const auto column = findColumn(
      columns.size(), [&](std::size_t c) -> std::string_view { return columns[c].name; }, ColumnNames::z());
  std::vector<double> heights;
  if (!column) return heights;
  for (std::size_t i = 0; i < table.stated.size(); ++i) {
    const CellNumber cell = readCell(table.attributes.at(i, *column));
    heights.push_back(cell.kind == CellNumber::Kind::number && std::isfinite(cell.value)
                          ? cell.value
                          : std::numeric_limits<double>::quiet_NaN());
  }
  return heights;
}

Status readTable(PointTable table, const TerrainModel& model, const FeatureReadOptions& options,
                 FeatureLayer& layer, const RunContext& context) {
  layer.warnings = std::move(table.warnings);
  std::optional<std::size_t> labels;
  if (!options.label.empty()) {
    const auto& columns = table.attributes.columns;
    const std::string wanted = text::lowered(options.label);
    labels = findColumn(
        columns.size(), [&](std::size_t c) -> std::string_view { return columns[c].name; },
        std::array<std::string_view, 1>{wanted});
    if (!labels) {
      std::vector<std::string> names;
      for (const auto& column : columns) names.push_back(column.name);
      return failure(ErrorCode::notFound, fmt::format("has no column '{}' for labels; its columns: {}",
                                                      options.label, listed(names)));
    }
  }
  // The CRS that the text states is in table.crsWkt, or else that is the DEM's.
  OGRSpatialReference own;
  const Georeference& dem = model.georeference;
  if (!table.crsWkt.empty() && table.crsWkt != dem.crsWkt) {
    ARETE_TRY(own, crsFromText(table.crsWkt));
  } else if (options.crs.empty() && !dem.crsWkt.empty() && !dem.isGeographic && isLonLatName(table.xName)) {
    ARETE_TRY(own, crsFromText("OGC:CRS84"));
    layer.warnings.push_back(
        {WarningCode::position,
         fmt::format("states no CRS; its columns '{}' and '{}' are taken as longitude and "
                     "latitude of WGS 84",
                     table.xName, table.yName)});
  }
  ARETE_TRY(ChainPlacer placer, placerOf(&own, model, options, true, layer.warnings));
  const std::vector<double> heights = heightsOf(table);
  FeatureCollector collector(std::move(placer), labels ? 0 : -1, options.mostVertices, layer);
  for (std::size_t i = 0; i < table.stated.size(); ++i) {
    if (i % 4096 == 0 && context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
    ARETE_CHECK(collector.addPoint(table.stated[i],
                                   heights.empty() ? std::numeric_limits<double>::quiet_NaN() : heights[i],
                                   labels ? table.attributes.at(i, *labels) : std::string_view()));
  }
  ARETE_CHECK(collector.finish());
  scaleHeights(layer, heightFactor(&own, dem));
  return {};
}

/// GDAL finds WKT in a column of a CSV by the names that it is given.
std::vector<std::string> csvOptions(const std::string& path) {
  const std::string extension = text::lowerExtension(path);
  if (extension != "csv" && extension != "tsv" && extension != "psv") return {};
  return {fmt::format("GEOM_POSSIBLE_NAMES={}", fmt::join(ColumnNames::wkt(), ","))};
}

Status readVectors(const std::string& path, const TerrainModel& model, const FeatureReadOptions& options,
                   FeatureLayer& layer, const RunContext& context) {
  GdalErrors errors;
  const CPLConfigOptionSetter withHeights("GPX_ELE_AS_25D", "YES", true);
  ARETE_TRY(const auto dataset,
            openVectors(path, "set of points, lines or polygons", errors, layer.warnings, csvOptions(path)));
  ARETE_TRY(OGRLayer* const chosen, chooseLayer(*dataset, options.layer, LayerKind::any));
  layer.name = chosen->GetName();
  int field = -1;
  if (!options.label.empty()) {
    const OGRFeatureDefn& definition = *chosen->GetLayerDefn();
    field = definition.GetFieldIndex(options.label.c_str());
    if (field < 0) {
      std::vector<std::string> names;
      for (int i = 0; i < definition.GetFieldCount(); ++i)
        names.emplace_back(definition.GetFieldDefn(i)->GetNameRef());
      return failure(ErrorCode::notFound,
                     fmt::format("the layer '{}' has no field '{}' for labels; its fields: {}", layer.name,
                                 options.label, listed(names)));
    }
  }
  ARETE_TRY(ChainPlacer placer, placerOf(chosen->GetSpatialRef(), model, options,
                                         text::lowerExtension(path) == "csv", layer.warnings));
  if (!options.where.empty() && chosen->SetAttributeFilter(options.where.c_str()) != OGRERR_NONE)
    return failure(ErrorCode::usage, fmt::format("the layer '{1}' does not take the condition '{0}': {2}",
                                                 options.where, layer.name, errors.firstFailure()));
  FeatureCollector collector(std::move(placer), field, options.mostVertices, layer);
  ARETE_CHECK(forFeatures(*dataset, *chosen, errors, context,
                          [&](OGRFeature& feature) { return collector.add(feature); }));
  errors.moveTo(layer.warnings);
  if (!options.where.empty() && layer.features == 0)
    return failure(ErrorCode::invalidData, fmt::format("no feature of the layer '{}' meets the condition {}",
                                                       layer.name, options.where));
  ARETE_CHECK(collector.finish());
  scaleHeights(layer, heightFactor(chosen->GetSpatialRef(), model.georeference));
  return {};
}

Status readInto(const std::string& path, const TerrainModel& model, const FeatureReadOptions& options,
                FeatureLayer& layer, const RunContext& context) {
  registerGdal();
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  if (!looksLikePointText(path, 2)) return readVectors(path, model, options, layer, context);
  auto table = readPointTable(path, model.georeference, {.layer = options.layer}, context);
  if (table && !options.where.empty())
    return failure(ErrorCode::usage, "is a table of points in text, whose rows no condition chooses");
  if (table) {
    layer.name = std::filesystem::path(path).stem().string();
    return readTable(std::move(*table), model, options, layer, context);
  }
  if (table.error().code != ErrorCode::invalidData) return tl::unexpected(table.error());
  // Lines in WKT. What was the matter with the points is the better answer if GDAL finds nothing either.
  const Status read = readVectors(path, model, options, layer, context);
  if (!read && (read.error().code == ErrorCode::unsupported || read.error().code == ErrorCode::invalidData))
    return tl::unexpected(table.error());
  return read;
}

}  // namespace

Result<FeatureLayer> readFeatures(const std::string& path, const TerrainModel& model,
                                  const FeatureReadOptions& options, const RunContext& context) try {
  FeatureLayer layer;
  Status read = readInto(path, model, options, layer, context);
  if (!read) {
    if (read.error().culprit.empty()) read.error().culprit = path;
    return tl::unexpected(read.error());
  }
  return layer;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
