// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texts go through readPointText(), everything else through OGR. Both give rows, which are sorted by position
// to find equal ones. Which points stay and which conflict is reported depends only on the order of the file.
#include "io/geo/dem/point_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "engine/memory/pages.h"
#include "io/files/text/address_text.h"
#include "io/geo/crs/reader.h"
#include "io/geo/crs/vertical.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/vector_file.h"
#include "io/geo/gdal/vector_layer.h"
#include "io/geo/table/feature_rows.h"
#include "io/geo/text/point_rows.h"
#include "io/geo/text/point_text.h"

namespace arete {
namespace {

constexpr std::array kSamePlaceNames = {std::pair{SamePlace::refuse, std::string_view("error")},
                                        std::pair{SamePlace::least, std::string_view("min")},
                                        std::pair{SamePlace::greatest, std::string_view("max")},
                                        std::pair{SamePlace::mean, std::string_view("mean")},
                                        std::pair{SamePlace::first, std::string_view("first")}};

std::string_view samePlaceClause(SamePlace rule) {
  switch (rule) {
    case SamePlace::least:
      return "the least";
    case SamePlace::greatest:
      return "the greatest";
    case SamePlace::mean:
      return "the mean";
    default:
      return "the first";
  }
}

constexpr std::size_t kPointLimit = (std::size_t(1) << 32) - 2;

std::string fieldNames(const OGRFeatureDefn& definition) {
  std::vector<std::string> names;
  for (int i = 0; i < definition.GetFieldCount(); ++i)
    names.emplace_back(definition.GetFieldDefn(i)->GetNameRef());
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

/// Collects the points of features, one after the other.
class FeatureCollector {
 public:
  FeatureCollector(OGRLayer& layer, int zField) : layer_(layer), zField_(zField) {}

  /// A feature may hold one point or several. One without a position or a height is counted and left out; any
  /// other geometry is an error, since a part of the terrain would be missing.
  Status add(OGRFeature& feature) {
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (!geometry || geometry->IsEmpty() || (zField_ >= 0 && !feature.IsFieldSetAndNotNull(zField_))) {
      ++skipped;
      return {};
    }
    const OGRwkbGeometryType type = wkbFlatten(geometry->getGeometryType());
    if (type == wkbPoint) return addPoint(feature, *geometry->toPoint());
    if (type == wkbMultiPoint) {
      for (const OGRPoint* point : *geometry->toMultiPoint()) ARETE_CHECK(addPoint(feature, *point));
      return {};
    }
    return failure(ErrorCode::unsupported,
                   fmt::format("feature {} of the layer '{}' is a {}, not a point", feature.GetFID(),
                               layer_.GetName(), geometry->getGeometryName()));
  }

  PointRows rows;
  std::size_t skipped = 0;

 private:
  // Where a field is the height, a geometry needs none. NaN as a height stands for a missing one; NaN as a
  // coordinate is an error.
  Status addPoint(const OGRFeature& feature, const OGRPoint& point) {
    if (zField_ < 0 && !point.Is3D())
      return failure(ErrorCode::invalidData,
                     fmt::format("feature {} of the layer '{}' has no height; `zField` names "
                                 "the field that holds it (the fields: {})",
                                 feature.GetFID(), layer_.GetName(), fieldNames(*layer_.GetLayerDefn())));
    const double z = zField_ < 0 ? point.getZ() : feature.GetFieldAsDouble(zField_);
    if (std::isnan(z) && std::isfinite(point.getX()) && std::isfinite(point.getY())) {
      ++skipped;
      return {};
    }
    for (const double value : {point.getX(), point.getY(), z})
      if (!std::isfinite(value))
        return failure(ErrorCode::invalidData,
                       fmt::format("feature {} of the layer '{}' has the coordinate {}", feature.GetFID(),
                                   layer_.GetName(), value));
    rows.add(point.getX(), point.getY(), z, std::uint64_t(feature.GetFID()));
    return {};
  }

  OGRLayer& layer_;
  int zField_;
};

/// A field is a height only if its type is a number: texts that look like numbers are refused, not parsed.
Result<int> findZField(OGRLayer& layer, const std::string& name) {
  if (name.empty()) return -1;
  const OGRFeatureDefn& definition = *layer.GetLayerDefn();
  const int index = definition.GetFieldIndex(name.c_str());
  if (index < 0)
    return failure(ErrorCode::usage, fmt::format("the layer '{}' has no field '{}'; its fields: {}",
                                                 layer.GetName(), name, fieldNames(definition)));
  const OGRFieldType type = definition.GetFieldDefn(index)->GetType();
  if (type != OFTInteger && type != OFTInteger64 && type != OFTReal)
    return failure(ErrorCode::usage,
                   fmt::format("the field '{}' of the layer '{}' is of type {}, not a number", name,
                               layer.GetName(), OGRFieldDefn::GetFieldTypeName(type)));
  return index;
}

Result<PointRows> readLayer(GDALDataset& dataset, OGRLayer& layer, const PointReadOptions& options,
                            Warnings& warnings, const RunContext& context) {
  ARETE_TRY(auto zField, findZField(layer, options.zField));
  GdalErrors errors;
  FeatureCollector collector(layer, zField);
  ARETE_CHECK(forFeatures(dataset, layer, errors, context,
                          [&](OGRFeature& feature) { return collector.add(feature); }));
  errors.moveTo(warnings);
  if (collector.skipped > 0)
    warnings.push_back({WarningCode::omitted,
                        counted(collector.skipped, "feature without a position or a height is left out",
                                "features without a position or a height are left out")});
  return std::move(collector.rows);
}

void dropNodata(PointRows& rows, double nodata, Warnings& warnings) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows.heights.size(); ++i) {
    if (rows.heights[i] == nodata) continue;
    rows.positions[kept] = rows.positions[i];
    rows.heights[kept] = rows.heights[i];
    rows.origins[kept++] = rows.origins[i];
  }
  if (const std::size_t dropped = rows.heights.size() - kept; dropped > 0)
    warnings.push_back({WarningCode::omitted, fmt::format("{} of the height {} {} left out as NODATA",
                                                          counted(dropped, "point", "points"), nodata,
                                                          agreeing(dropped, "is", "are"))});
  rows.positions.resize(kept);
  rows.heights.resize(kept);
  rows.origins.resize(kept);
}

/// The points of one place as one height.
class PlaceHeight {
 public:
  PlaceHeight(SamePlace rule, double first) : rule_(rule), height_(first), sum_(first) {}

  void add(double height) {
    ++count_;
    sum_ += height;
    if (rule_ == SamePlace::least) height_ = std::min(height_, height);
    if (rule_ == SamePlace::greatest) height_ = std::max(height_, height);
  }
  double height() const {
    if (rule_ != SamePlace::mean) return height_;
    const double mean = sum_ / double(count_);
    return std::isfinite(mean) ? mean : height_;  // a sum beyond the range of doubles
  }

 private:
  SamePlace rule_;
  double height_, sum_;
  std::size_t count_ = 1;
};

/// Keeps the first of each set of equal points, and one point of each set at one place, with the height by
/// the rule. Without a rule equal positions with different heights are an error, which names the first such
/// pair in the file.
Status mergeEqual(PointRows& rows, SamePlace rule, std::string_view originName, Warnings& warnings) {
  // Equal positions are next to each other after sorting, and within one position the order of the file
  // holds, so the first of each group is the first in the file.
  const std::size_t count = rows.heights.size();
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  const auto& p = rows.positions;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(p[a].x, p[a].y, a) < std::tie(p[b].x, p[b].y, b);
  });
  std::vector<bool> repeated(count, false);
  std::size_t merged = 0, joined = 0, places = 0;
  double widest = 0;
  std::pair<std::uint32_t, std::uint32_t> conflict{0, std::numeric_limits<std::uint32_t>::max()};
  for (std::size_t first = 0, next = 0; first < count; first = next) {
    const std::uint32_t a = order[first];
    const double own = rows.heights[a];
    PlaceHeight place(rule, own);
    std::size_t different = 0;
    // All points at one place are compared with the first one there. The conflict to report is the one whose
    // second point comes first in the file.
    for (next = first + 1; next < count && p[a] == p[order[next]]; ++next) {
      const std::uint32_t b = order[next];
      repeated[b] = true;
      place.add(rows.heights[b]);
      if (rows.heights[b] == own) {
        ++merged;
        continue;
      }
      ++different;
      if (b < conflict.second) conflict = {a, b};
      widest = std::max(widest, std::abs(rows.heights[b] - own));
    }
    if (different > 0 && rule != SamePlace::refuse) rows.heights[a] = place.height();
    joined += different;
    places += different > 0 ? 1 : 0;
  }
  // Conflicts are errors only without a rule; under a rule the warnings count what was left out and how far
  // it was off.
  if (const auto [a, b] = conflict; b < count && rule == SamePlace::refuse)
    return failure(ErrorCode::degenerate,
                   fmt::format("two points at x {}, y {} have different heights: {} ({} {}) and {} ({} {}); "
                               "`samePlace` says which height a place has",
                               p[a].x, p[a].y, rows.heights[a], originName, rows.origins[a], rows.heights[b],
                               originName, rows.origins[b]));
  if (merged > 0)
    warnings.push_back(
        {WarningCode::omitted, counted(merged, "point repeats another one exactly and is left out",
                                       "points repeat another one exactly and are left out")});
  if (joined > 0)
    warnings.push_back(
        {WarningCode::omitted,
         fmt::format("{} several heights, up to {:.6g} from the first; each gets one, {}, and {} left out",
                     counted(places, "place has", "places have"), widest, samePlaceClause(rule),
                     counted(joined, "point is", "points are"))});
  if (merged + joined == 0) return {};
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (repeated[i]) continue;
    rows.positions[kept] = rows.positions[i];
    rows.heights[kept++] = rows.heights[i];
  }
  rows.positions.resize(kept);
  rows.heights.resize(kept);
  return {};
}

/// Everything that follows the rows: NODATA, equal places, and what the CRS says of the vertical axis.
Result<PointRead> finish(PointRows rows, std::string_view originName, const OGRSpatialReference* crs,
                         const PointReadOptions& options, const std::string& path, PointRead read) {
  if (options.nodata) dropNodata(rows, *options.nodata, read.warnings);
  if (rows.heights.empty()) return failure(ErrorCode::invalidData, "holds no point");
  if (rows.heights.size() >= kPointLimit)
    return failure(ErrorCode::unsupported,
                   fmt::format("holds {} points; {} can be numbered", rows.heights.size(), kPointLimit - 1));
  ARETE_CHECK(mergeEqual(rows, options.samePlace, originName, read.warnings));

  // The geotransform maps the middle of the pixel (x, y) to x, y: positions are coordinates of the CRS
  // already.
  PointHeightfield& points = read.heightfield;
  points.georeference.geoTransform = {-0.5, 1, 0, -0.5, 0, 1};
  points.georeference.hasGeoTransform = true;
  ARETE_TRY(auto chosen, chooseCrs(crs, options.crs, read.warnings));
  ARETE_TRY(const auto isDepth, describeVertical(chosen, {}, {options.verticalUnit, options.isDepth},
                                                 points.georeference, read.warnings));
  if (isDepth)
    for (double& height : rows.heights) height = 0 - height;
  rows.positions.shrink_to_fit();
  rows.heights.shrink_to_fit();
  points.positions = std::move(rows.positions);
  points.heights = std::move(rows.heights);
  points.source = nameWithoutQuery(path);
  points.sourceChecksum = heightsChecksum(points);
  ARETE_CHECK(points.validate());
  return read;
}

// A file that looks like text goes to our own reader, and GDAL opens only what does not.
Result<PointRead> readFrom(const std::string& path, const PointReadOptions& options,
                           const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  PointRead read;
  GdalDatasetPtr dataset;
  bool asText = looksLikePointText(path);
  if (!asText) {
    ARETE_TRY(auto opened, openVectors(path, "set of points", errors, read.warnings));
    dataset = std::move(opened);
  }
  if (asText) {
    if (!options.layer.empty())
      return failure(ErrorCode::usage, fmt::format("is text, which has no layer '{}'", options.layer));
    ARETE_TRY(auto rows, readPointText(path, options.zField, read.warnings, context));
    if (rows.srid == 0) return finish(std::move(rows), "line", nullptr, options, path, std::move(read));
    ARETE_TRY(const auto crs, crsFromText(fmt::format("EPSG:{}", rows.srid)));
    return finish(std::move(rows), "line", &crs, options, path, std::move(read));
  }
  ARETE_TRY(auto layer, chooseLayer(*dataset, options.layer, LayerKind::points));
  ARETE_TRY(auto rows, readLayer(*dataset, *layer, options, read.warnings, context));
  errors.moveTo(read.warnings);
  return finish(std::move(rows), "feature", layer->GetSpatialRef(), options, path, std::move(read));
}

}  // namespace

std::optional<SamePlace> samePlaceNamed(std::string_view name) {
  for (const auto& [rule, known] : kSamePlaceNames)
    if (name == known) return rule;
  return std::nullopt;
}

Result<PointRead> readPoints(const std::string& path, const PointReadOptions& options,
                             const RunContext& context) try {
  auto read = readFrom(path, options, context);
  giveFreeHeapBack();  // blocks that growing rows left behind
  if (!read && read.error().culprit.empty()) read.error().culprit = path;
  return read;
} catch (...) {
  return caughtFailure(path);
}

Result<PointRead> pointsFrom(std::span<const Vec3> points, const std::string& crsWkt,
                             const std::string& source, const PointReadOptions& options) try {
  registerGdal();
  PointRows rows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!isFinite(points[i]))
      return failure(ErrorCode::invalidData, fmt::format("point {} has a coordinate that is not finite", i),
                     source);
    rows.add(points[i].x, points[i].y, points[i].z, i);
  }
  Result<OGRSpatialReference> crs = OGRSpatialReference();
  if (!crsWkt.empty()) crs = crsFromText(crsWkt);
  if (!crs) return failure(crs.error().code, crs.error().message, source);
  Result<PointRead> read =
      finish(std::move(rows), "point", crsWkt.empty() ? nullptr : &*crs, options, source, {});
  if (!read && read.error().culprit.empty()) read.error().culprit = source;
  return read;
} catch (...) {
  return caughtFailure(source);
}

}  // namespace arete
