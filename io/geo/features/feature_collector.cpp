// SPDX-License-Identifier: GPL-3.0-or-later
//
// A feature's label stands at each of its points, or else inside its largest polygon, or else along its
// longest line.
#include "io/geo/features/feature_collector.h"

#include <fmt/format.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "engine/base/counted.h"
#include "io/files/text/grouped.h"
#include "io/files/text/utf8.h"
#include "io/geo/table/feature_rows.h"

namespace arete {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLongestLabel = 100;  // bytes; a longer one covers the picture

double heightOf(const OGRPoint& point) {
  return point.Is3D() && std::isfinite(point.getZ()) ? point.getZ() : kNoHeight;
}

/// One line of it without the spaces at its ends, and short.
std::string labelOf(std::string text, bool& isShortened) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  text = text.substr(first, text.find_last_not_of(' ') - first + 1);
  isShortened = text.size() > kLongestLabel;
  if (isShortened) {
    std::size_t end = kLongestLabel;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
      --end;  // not within a character
    text = text.substr(0, end) + "\xE2\x80\xA6";
  }
  return text;
}

}  // namespace

void FeatureCollector::place(Vec2 xy, double z) {
  const auto there = placer_.place(xy);
  if (!there) return;
  hasZ_ = hasZ_ || !std::isnan(z);
  layer_.points.push_back({*there, z});
  labelPlaces_.push_back(layer_.points.back());
}

void FeatureCollector::collectLine(const OGRSimpleCurve& line, std::uint64_t polygon) {
  xy_.clear();
  z_.clear();
  const bool is3d = line.Is3D() != 0;
  for (int i = 0; i < line.getNumPoints(); ++i) {
    xy_.push_back({line.getX(i), line.getY(i)});
    z_.push_back(is3d && std::isfinite(line.getZ(i)) ? line.getZ(i) : kNoHeight);
    hasZ_ = hasZ_ || !std::isnan(z_.back());
  }
  // A ring that does not end where it begins is closed.
  if (wkbFlatten(line.getGeometryType()) == wkbLineString && EQUAL(line.getGeometryName(), "LINEARRING") &&
      xy_.size() > 2 && !(xy_.front() == xy_.back())) {
    xy_.push_back(xy_.front());
    z_.push_back(z_.front());
  }
  const std::size_t before = layer_.lines.size();
  const auto added = placer_.addLine(xy_, z_, layer_);
  // A ring that was cut open bounds no area.
  for (std::size_t i = before; polygon != FeatureLayer::kNoPolygon && i < layer_.lines.size(); ++i) {
    const FeatureLayer::Line& piece = layer_.lines[i];
    if (layer_.vertices[piece.first] == layer_.vertices[piece.first + piece.count - 1])
      layer_.lines[i].polygon = polygon;
  }
  if (added && (!labelLine_ || layer_.lines[*added].count > layer_.lines[*labelLine_].count))
    labelLine_ = added;
}

void FeatureCollector::collect(const OGRGeometry& geometry) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (geometry.IsEmpty()) {
    // A part without coordinates has no place.
  } else if (type == wkbPoint) {
    const OGRPoint& point = *geometry.toPoint();
    place({point.getX(), point.getY()}, heightOf(point));
  } else if (type == wkbLineString) {
    collectLine(*geometry.toLineString());
  } else if (type == wkbPolygon || type == wkbTriangle) {
    const OGRPolygon& polygon = *geometry.toPolygon();
    const std::uint64_t number = layer_.polygons++;
    const std::size_t before = layer_.lines.size();
    for (const OGRLinearRing* ring : polygon) collectLine(*ring, number);
    const double area = field_ >= 0 ? polygon.get_Area() : -1;
    const bool isArea = std::any_of(layer_.lines.begin() + std::ptrdiff_t(before), layer_.lines.end(),
                                    [&](const FeatureLayer::Line& line) { return line.polygon == number; });
    if (isArea && area > largestArea_) {
      largestArea_ = area;
      labelPolygon_ = number;
    }
  } else if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface)) {
    for (const OGRPolygon* polygon : *geometry.toPolyhedralSurface()) collect(*polygon);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part);
  } else {
    ++others_;
  }
}

void FeatureCollector::addLabels(std::string text) {
  if (!text::isUtf8(text)) {
    ++unlike_;
    text = text::asUtf8(text);
  }
  bool isShortened = false;
  text = labelOf(std::move(text), isShortened);
  shortened_ += isShortened ? 1 : 0;
  if (text.empty()) return;
  for (const FeatureLayer::Place& at : labelPlaces_) layer_.labels.push_back({text, at});
  if (!labelPlaces_.empty()) return;
  if (labelPolygon_)
    layer_.labels.push_back({.text = text,
                             .polygon = *labelPolygon_,
                             .firstPolygon = firstPolygon_,
                             .endPolygon = layer_.polygons});
  else if (labelLine_)
    layer_.labels.push_back({text, {}, *labelLine_});
}

Status FeatureCollector::checkSize() const {
  if (layer_.vertices.size() + layer_.points.size() <= most_) return {};
  return failure(
      ErrorCode::unsupported,
      fmt::format("the layer '{}' has more than {} vertices, which is the most that is drawn; a part "
                  "of it, or simpler lines, can be",
                  layer_.name, grouped(most_)));
}

Status FeatureCollector::add(OGRFeature& feature) {
  ++layer_.features;
  const OGRGeometry* const geometry = feature.GetGeometryRef();
  if (!geometry || geometry->IsEmpty()) {
    ++without_;
    return {};
  }
  labelPlaces_.clear();
  labelLine_.reset();
  labelPolygon_.reset();
  largestArea_ = -1;
  firstPolygon_ = layer_.polygons;
  if (geometry->hasCurveGeometry()) {
    const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
    if (linear)
      collect(*linear);
    else
      ++others_;
  } else {
    collect(*geometry);
  }
  if (field_ >= 0) addLabels(fieldText(feature, field_));
  return checkSize();
}

Status FeatureCollector::addPoint(Vec2 xy, double z, std::string_view label) {
  ++layer_.features;
  if (std::isnan(xy.x) || std::isnan(xy.y)) {
    ++without_;
    return {};
  }
  labelPlaces_.clear();
  labelLine_.reset();
  labelPolygon_.reset();
  place(xy, z);
  if (!label.empty()) addLabels(std::string(label));
  return checkSize();
}

Status FeatureCollector::finish() {
  if (!hasZ_) layer_.z.clear();
  const auto warn = [&](WarningCode code, std::uint64_t n, std::string_view one, std::string_view many) {
    if (n > 0) layer_.warnings.push_back({code, counted(n, one, many)});
  };
  warn(WarningCode::omitted, without_, "feature without a geometry is left out",
       "features without a geometry are left out");
  warn(WarningCode::omitted, others_, "geometry other than points, lines and polygons is left out",
       "geometries other than points, lines and polygons are left out");
  warn(WarningCode::omitted, placer_.notFinite(), "place is not finite and left out",
       "places are not finite and left out");
  warn(WarningCode::position, placer_.outOfReach(),
       "place or edge is outside the domain of the DEM's CRS and left out",
       "places or edges are outside the domain of the DEM's CRS and left out");
  warn(WarningCode::choice, unlike_, "label is not UTF-8 and is taken as Latin-1",
       "labels are not UTF-8 and are taken as Latin-1");
  warn(WarningCode::omitted, shortened_, "label is long and shortened", "labels are long and shortened");
  if (!layer_.points.empty() || !layer_.lines.empty()) return {};
  if (placer_.outOfReach() + placer_.notFinite() > 0)
    return failure(ErrorCode::invalidData,
                   fmt::format("none of the places of the layer '{}' has coordinates in the DEM's CRS; check "
                               "the order of the coordinates and the CRS of the file",
                               layer_.name));
  return failure(ErrorCode::invalidData,
                 fmt::format("the layer '{}' has no point, line or polygon", layer_.name));
}

}  // namespace arete
