// SPDX-License-Identifier: GPL-3.0-or-later
//
// GEOS, through OGR, does the geometry.
#include "io/gdal/polygon_set.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "io/gdal/support.h"

namespace arete {
namespace {

void collect(const OGRGeometry& geometry, OGRMultiPolygon& polygons) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon) {
    if (!geometry.IsEmpty()) polygons.addGeometry(&geometry);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, polygons);
  }
}

OGRLinearRing ringOf(const Ring& vertices) {
  OGRLinearRing ring;
  ring.setNumPoints(static_cast<int>(vertices.size()), FALSE);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    ring.setPoint(static_cast<int>(i), vertices[i].x, vertices[i].y);
  ring.closeRings();
  return ring;
}

OGRPolygon box(double west, double south, double east, double north) {
  OGRPolygon polygon;
  OGRLinearRing ring = ringOf({{west, south}, {east, south}, {east, north}, {west, north}});
  polygon.addRing(&ring);
  return polygon;
}

std::unique_ptr<OGRGeometry> shifted(const OGRMultiPolygon& polygons, double dx) {
  std::unique_ptr<OGRGeometry> copy(polygons.clone());
  if (dx == 0) return copy;
  for (OGRPolygon* polygon : *copy->toMultiPolygon())
    for (OGRLinearRing* ring : *polygon)
      for (int i = 0; i < ring->getNumPoints(); ++i) ring->setPoint(i, ring->getX(i) + dx, ring->getY(i));
  return copy;
}

}  // namespace

std::vector<Ring> ringsOf(const OGRMultiPolygon& polygons) {
  std::vector<Ring> rings;
  for (const OGRPolygon* polygon : polygons)
    for (const OGRLinearRing* source : *polygon) {
      Ring ring;
      for (int i = 0; i < source->getNumPoints(); ++i) {
        const Vec2 p{source->getX(i), source->getY(i)};
        if (ring.empty() || !(ring.back() == p)) ring.push_back(p);
      }
      while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
      if (ring.size() >= 3) rings.push_back(std::move(ring));
    }
  return rings;
}

OGRMultiPolygon polygonsOf(const std::vector<Ring>& rings) {
  const GdalErrors quiet;
  std::vector<OGRGeometry*> parts;
  for (const Ring& ring : rings) {
    auto polygon = std::make_unique<OGRPolygon>();
    OGRLinearRing closed = ringOf(ring);
    polygon->addRing(&closed);
    parts.push_back(polygon.release());
  }
  OGRMultiPolygon polygons;
  int isValid = 0;
  const std::unique_ptr<OGRGeometry> organized(
      OGRGeometryFactory::organizePolygons(parts.data(), static_cast<int>(parts.size()), &isValid));
  if (organized) collect(*organized, polygons);
  return polygons;
}

OGRMultiPolygon repaired(const OGRMultiPolygon& polygons, std::vector<std::string>& warnings) {
  if (!OGRGeometryFactory::haveGEOS()) return polygons;
  const GdalErrors quiet;
  OGRMultiPolygon result;
  bool isWarned = false;
  for (const OGRPolygon* polygon : polygons) {
    if (polygon->IsValid()) {
      result.addGeometry(polygon);
      continue;
    }
    OGRMultiPolygon valid;
    if (const std::unique_ptr<OGRGeometry> made(polygon->MakeValid()); made) collect(*made, valid);
    if (valid.IsEmpty() && !isWarned) {
      warnings.emplace_back("a polygon crosses itself and cannot be repaired");
      isWarned = true;
    }
    if (valid.IsEmpty()) result.addGeometry(polygon);
    for (const OGRPolygon* part : valid) result.addGeometry(part);
  }
  return result;
}

OGRMultiPolygon united(const OGRMultiPolygon& polygons, std::vector<std::string>& warnings) {
  if (polygons.getNumGeometries() < 2) return polygons;
  const GdalErrors quiet;
  OGRMultiPolygon result;
  const std::unique_ptr<OGRGeometry> made(OGRGeometryFactory::haveGEOS() ? polygons.UnionCascaded()
                                                                         : nullptr);
  if (made) collect(*made, result);
  if (!result.IsEmpty()) return result;
  warnings.emplace_back("the polygons cannot be united; where two of them overlap counts as outside");
  return polygons;
}

OGRMultiPolygon withinOneTurn(const OGRMultiPolygon& polygons, double turn,
                              std::vector<std::string>& warnings) {
  OGREnvelope extent;
  polygons.getEnvelope(&extent);
  constexpr double kRounding = 1e-12, kMostTurns = 1000;
  if (!(turn > 0) || polygons.IsEmpty() || !(extent.MaxX - extent.MinX > turn * (1 + kRounding)))
    return polygons;
  if (std::max(extent.MaxX, -extent.MinX) > kMostTurns * turn) return polygons;  // no longitudes
  const GdalErrors quiet;
  const OGRPolygon band = box(-turn / 2, extent.MinY - 1, turn / 2, extent.MaxY + 1);
  OGRMultiPolygon parts;
  for (double k = std::ceil((-turn / 2 - extent.MaxX) / turn); k * turn <= turn / 2 - extent.MinX; ++k) {
    const auto copy = shifted(polygons, k * turn);
    const std::unique_ptr<OGRGeometry> part(copy->Intersection(&band));
    if (part) collect(*part, parts);
  }
  if (!parts.IsEmpty()) return united(parts, warnings);
  warnings.emplace_back("the polygons reach over more than a turn and cannot be united");
  return polygons;
}

}  // namespace arete
