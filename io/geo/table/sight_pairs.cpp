// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL reads CSV as a layer without geometry, so tables and layers share the code. The positions of a row
// come from columns if there are such, otherwise from the ends of its geometry; a missing second position
// comes from azimuth and range. Tables of lines have headers and are small, so GDAL's speed suffices
// (point_text.cpp says where it does not).
#include "io/geo/table/sight_pairs.h"

#include <fmt/format.h>
#include <ogr_geometry.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/number_text.h"
#include "io/files/text_scan.h"
#include "io/geo/crs/lonlat.h"
#include "io/geo/crs/transform.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/vector_file.h"
#include "io/geo/gdal/vector_layer.h"
#include "io/geo/table/feature_rows.h"
#include "io/geo/text/column_rules.h"

namespace arete {
namespace {

constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kStandardInput = "/vsistdin";

int columnNamed(int count, const std::function<std::string_view(std::size_t)>& nameOf,
                std::span<const std::string_view> names) {
  const auto found = findColumn(std::size_t(count), nameOf, names);
  return found ? int(*found) : -1;
}

/// Missing if the text is not a finite number.
std::optional<double> finiteNumber(std::string_view text) {
  const auto number = text::parseNumber(text::withoutSpaces(text));
  return number && std::isfinite(*number) ? number : std::nullopt;
}

/// The position at a distance in a direction: along a geodesic, or on the map without a CRS.
class GroundDirection {
 public:
  explicit GroundDirection(const Georeference& dem)
      : lonLat_(CrsLonLat::of(dem)),
        geodesic_(dem.semiMajorAxisMetres, dem.inverseFlattening == 0 ? 0 : 1 / dem.inverseFlattening),
        unit_(dem.crsWkt.empty() ? 1 : dem.linearUnitMetres) {}

  Vec2 operator()(Vec2 xy, double azimuth, double metres) const {
    if (!lonLat_) {
      const double a = azimuth * std::numbers::pi / 180;
      return {xy.x + metres / unit_ * std::sin(a), xy.y + metres / unit_ * std::cos(a)};
    }
    lonLat_->toLonLat({&xy, 1});
    Vec2 end;
    geodesic_.Direct(xy.y, xy.x, azimuth, metres, end.y, end.x);
    end.x += 360 * std::round((xy.x - end.x) / 360);
    lonLat_->toCrs({&end, 1});
    return end;
  }

 private:
  Result<CrsLonLat> lonLat_;
  GeographicLib::Geodesic geodesic_;
  double unit_;
};

class PairReader {
 public:
  PairReader(OGRLayer& layer, SightPairs& pairs) : layer_(layer), pairs_(pairs) {
    const OGRFeatureDefn& definition = *layer.GetLayerDefn();
    fields_ = definition.GetFieldCount();
    const auto nameOf = [&](std::size_t i) {
      return std::string_view(definition.GetFieldDefn(int(i))->GetNameRef());
    };
    hasGeometry_ = layer.GetGeomType() != wkbNone;
    for (int end = 0; end < 2; ++end) {
      if (!hasGeometry_) {
        x_[end] = columnNamed(fields_, nameOf, ColumnNames::endX(end));
        y_[end] = columnNamed(fields_, nameOf, ColumnNames::endY(end));
      }
      height_[end] = columnNamed(fields_, nameOf, ColumnNames::endHeight(end));
    }
    azimuth_ = columnNamed(fields_, nameOf, ColumnNames::azimuth());
    range_ = columnNamed(fields_, nameOf, ColumnNames::range());
    if (hasGeometry_) pairs.attributes.columns.push_back({"source_fid", PointAttributes::Kind::integer});
    for (int i = 0; i < fields_; ++i)
      if (!isPosition(i))
        pairs.attributes.columns.push_back(
            {std::string(nameOf(std::size_t(i))), kindOf(*definition.GetFieldDefn(i))});
  }

  Status check() const {
    if (!hasGeometry_ && (x_[0] < 0 || y_[0] < 0))
      return failure(ErrorCode::invalidData, "has no columns x1 and y1 (or lon1, lat1, from_x, ...)");
    if (!hasGeometry_ && (x_[1] < 0 || y_[1] < 0) && !hasDirection())
      return failure(ErrorCode::invalidData,
                     "has no columns x2 and y2 (or lon2, lat2, to_x, ...), nor azimuth and range");
    return {};
  }

  /// Leaves the second position NaN if azimuth and range give it: see directions().
  Status add(OGRFeature& feature) {
    std::array<SightSite, 2> row;
    for (SightSite& site : row) site.stated = {kNotStated, kNotStated};
    if (hasGeometry_) {
      ARETE_CHECK(readGeometry(feature, row));
    } else {
      for (int end = 0; end < 2; ++end)
        for (const auto& [column, value] :
             {std::pair{x_[end], &row[end].stated.x}, {y_[end], &row[end].stated.y}})
          if (column >= 0) ARETE_CHECK(readNumber(feature, column, *value));
    }
    for (int end = 0; end < 2; ++end) {
      if (height_[end] < 0) continue;
      const std::string text = fieldText(feature, height_[end]);
      if (text.empty()) continue;
      const auto height = readHeightText(text);
      if (!height) return failure(ErrorCode::invalidData, height.error().message, where(feature));
      row[end].height = *height;
    }
    std::array<double, 2> direction = {kNotStated, kNotStated};
    if (hasDirection()) {
      ARETE_CHECK(readNumber(feature, azimuth_, direction[0]));
      ARETE_CHECK(readNumber(feature, range_, direction[1]));
      // A negative range would be another azimuth.
      if (!std::isfinite(row[1].stated.x) && direction[1] <= 0)
        return failure(ErrorCode::invalidData, "has a range that is not above 0", where(feature));
    }
    directions_.push_back(direction);
    if (hasGeometry_) pairs_.attributes.add(fmt::format("{}", feature.GetFID()));
    for (int i = 0; i < fields_; ++i)
      if (!isPosition(i)) pairs_.attributes.add(fieldText(feature, i));
    pairs_.rows.push_back(row);
    return {};
  }

  bool hasDirection() const { return azimuth_ >= 0 && range_ >= 0; }
  const std::vector<std::array<double, 2>>& directions() const { return directions_; }

 private:
  bool isPosition(int field) const {
    return std::any_of(x_.begin(), x_.end(), [&](int c) { return c == field; }) ||
           std::any_of(y_.begin(), y_.end(), [&](int c) { return c == field; });
  }

  std::string where(const OGRFeature& feature) const { return fmt::format("row {}", feature.GetFID()); }

  /// Leaves the value unchanged for an empty field.
  Status readNumber(OGRFeature& feature, int column, double& value) const {
    const std::string text = fieldText(feature, column);
    if (text.empty()) return {};
    const auto number = finiteNumber(text);
    if (!number)
      return failure(ErrorCode::invalidData, fmt::format("'{}' is not a number", text), where(feature));
    value = *number;
    return {};
  }

  Status readGeometry(const OGRFeature& feature, std::array<SightSite, 2>& row) const {
    const OGRGeometry* geometry = feature.GetGeometryRef();
    // A collection of one geometry counts as that geometry.
    while (geometry && !geometry->IsEmpty() &&
           OGR_GT_IsSubClassOf(wkbFlatten(geometry->getGeometryType()), wkbGeometryCollection) &&
           geometry->toGeometryCollection()->getNumGeometries() == 1)
      geometry = geometry->toGeometryCollection()->getGeometryRef(0);
    if (!geometry || geometry->IsEmpty()) return {};
    const OGRwkbGeometryType type = wkbFlatten(geometry->getGeometryType());
    OGRPoint ends[2];
    if (type == wkbPoint && hasDirection()) {
      ends[0] = *geometry->toPoint();
      row[0].stated = {ends[0].getX(), ends[0].getY()};
      return {};
    }
    if (!OGR_GT_IsSubClassOf(type, wkbCurve))
      return failure(ErrorCode::unsupported,
                     fmt::format("feature {} of the layer '{}' is a {}, not a line{}", feature.GetFID(),
                                 layer_.GetName(), geometry->getGeometryName(),
                                 type == wkbPoint ? ", and there are no columns azimuth and range" : ""));
    // A line of sight is straight, so vertices between the ends do not count.
    geometry->toCurve()->StartPoint(&ends[0]);
    geometry->toCurve()->EndPoint(&ends[1]);
    for (int end = 0; end < 2; ++end) row[end].stated = {ends[end].getX(), ends[end].getY()};
    return {};
  }

  OGRLayer& layer_;
  SightPairs& pairs_;
  int fields_ = 0;
  bool hasGeometry_ = false;
  std::array<int, 2> x_ = {-1, -1}, y_ = {-1, -1}, height_ = {-1, -1};
  int azimuth_ = -1, range_ = -1;
  std::vector<std::array<double, 2>> directions_;
};

void setPositions(SightPairs& pairs, const PairReader& reader, const CrsTransform& toDem,
                  const Georeference& dem) {
  for (int end = 0; end < 2; ++end) {
    std::vector<Vec2> positions;
    for (const auto& row : pairs.rows) positions.push_back(row[end].stated);
    toDem.apply(positions);
    // An end that is not stated stays so, whatever the transform makes of it.
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const bool isStated = std::isfinite(pairs.rows[i][end].stated.x + pairs.rows[i][end].stated.y);
      pairs.rows[i][end].xy = isStated ? positions[i] : Vec2{kNotStated, kNotStated};
    }
  }
  if (!reader.hasDirection()) return;
  const GroundDirection inDirection(dem);
  const auto back = toDem.isIdentity() ? Result<CrsTransform>(CrsTransform())
                                       : CrsTransform::between(dem.crsWkt, toDem.sourceWkt());
  for (std::size_t i = 0; i < pairs.rows.size(); ++i) {
    const auto& [azimuth, range] = reader.directions()[i];
    SightSite &from = pairs.rows[i][0], &to = pairs.rows[i][1];
    // A second end that is stated comes before a direction.
    if (std::isfinite(to.stated.x) || !std::isfinite(azimuth + range) || !std::isfinite(from.xy.x)) continue;
    to.xy = inDirection(from.xy, azimuth, range);
    if (back)
      if (const auto stated = (*back)(to.xy)) to.stated = *stated;
  }
}

Result<SightPairs> readPairsFrom(const std::string& path, const Georeference& dem,
                                 const PointTableOptions& options, const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  SightPairs pairs;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  // A table from stdin has no name by which GDAL knows it.
  auto opened = openVectors(path.starts_with(kStandardInput) ? fmt::format("CSV:{}", path) : path,
                            "set of lines", errors, pairs.warnings);
  if (!opened && opened.error().culprit.starts_with("CSV:")) opened.error().culprit = path;
  if (!opened) return tl::unexpected(opened.error());
  const GdalDatasetPtr dataset = std::move(*opened);
  ARETE_TRY(const auto layer, chooseLayer(*dataset, options.layer, LayerKind::linesOrTable));
  const bool isTable = layer->GetGeomType() == wkbNone;
  PairReader reader(*layer, pairs);
  ARETE_CHECK(reader.check());
  ARETE_CHECK(forFeatures(*dataset, *layer, errors, context, [&](OGRFeature& feature) -> Status {
    if (Status added = reader.add(feature); !added)
      return failure(
          added.error().code, added.error().message,
          added.error().culprit.empty() ? path : fmt::format("{}, {}", path, added.error().culprit));
    return {};
  }));
  if (pairs.rows.empty()) return failure(ErrorCode::invalidData, "holds no line");
  if (isTable) pairs.attributes.findKinds();
  ARETE_TRY(const auto transform,
            transformOf(layer->GetSpatialRef(), dem, options.lonLat, isTable, pairs.warnings));
  errors.moveTo(pairs.warnings);
  pairs.crsWkt = transform.sourceWkt().empty() ? dem.crsWkt : transform.sourceWkt();
  setPositions(pairs, reader, transform, dem);
  return pairs;
}

}  // namespace

Result<SightPairs> readSightPairs(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options, const RunContext& context) try {
  auto pairs = readPairsFrom(path, dem, options, context);
  if (!pairs && pairs.error().culprit.empty()) pairs.error().culprit = path;
  return pairs;
} catch (...) {
  return caughtFailure(path);
}

Result<SightPairs> readSightSites(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options, const RunContext& context) try {
  ARETE_TRY(auto table, readPointTable(path, dem, options, context));
  SightPairs sites;
  sites.attributes = std::move(table.attributes);
  sites.crsWkt = std::move(table.crsWkt);
  sites.warnings = std::move(table.warnings);
  const auto nameOf = [&](std::size_t i) { return std::string_view(sites.attributes.columns[i].name); };
  int column = -1;
  for (int end = 0; end < 2 && column < 0; ++end)
    column = columnNamed(int(sites.attributes.columns.size()), nameOf, ColumnNames::endHeight(end));
  // `arete height` and many surveys name a height above the sea so.
  if (column >= 0 && text::lowered(std::string(nameOf(std::size_t(column)))) == "height")
    sites.warnings.push_back({WarningCode::heights,
                              "the column height is taken for heights above the ground; rename it to h where "
                              "it is that, and to anything else where it is the height of the terrain"});
  const auto numberIn = [&](std::size_t row, std::span<const std::string_view> names) -> Result<double> {
    const int at = columnNamed(int(sites.attributes.columns.size()), nameOf, names);
    const std::string_view text = at < 0 ? std::string_view() : sites.attributes.at(row, std::size_t(at));
    if (text.empty()) return kNotStated;
    const auto number = finiteNumber(text);
    if (!number)
      return failure(ErrorCode::invalidData, fmt::format("'{}' is not a number", text),
                     fmt::format("{}, row {}", path, row + 1));
    return *number;
  };
  for (std::size_t i = 0; i < table.stated.size(); ++i) {
    std::array<SightSite, 2> row;
    row[0].stated = table.stated[i];
    row[0].xy = table.positions[i];
    row[1].stated = row[1].xy = {kNotStated, kNotStated};
    if (column >= 0)
      if (const std::string_view text = sites.attributes.at(i, std::size_t(column)); !text.empty()) {
        const auto height = readHeightText(text);
        if (!height)
          return failure(ErrorCode::invalidData, height.error().message,
                         fmt::format("{}, row {}", path, i + 1));
        row[0].height = *height;
      }
    const auto azimuth = numberIn(i, ColumnNames::azimuth()),
               beamwidth = numberIn(i, ColumnNames::beamwidth()), range = numberIn(i, ColumnNames::range());
    for (const auto* number : {&azimuth, &beamwidth, &range})
      if (!*number) return tl::unexpected(number->error());
    sites.beams.push_back({*azimuth, *beamwidth, *range});
    sites.rows.push_back(row);
  }
  return sites;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
