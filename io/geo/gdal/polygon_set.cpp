// SPDX-License-Identifier: GPL-3.0-or-later
//
// GEOS, through OGR, does the geometry.
#include "io/geo/gdal/polygon_set.h"

#include <ogr_api.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "io/geo/gdal/support.h"

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

/// How often a ring goes around a point that is not on it, counted with its direction.
int windingNumber(const OGRLinearRing& ring, const OGRPoint& p) {
  int winding = 0;
  for (int i = 0; i + 1 < ring.getNumPoints(); ++i) {
    const double y0 = ring.getY(i), y1 = ring.getY(i + 1);
    if ((y0 > p.getY()) == (y1 > p.getY())) continue;
    const double side =
        (ring.getX(i + 1) - ring.getX(i)) * (p.getY() - y0) - (p.getX() - ring.getX(i)) * (y1 - y0);
    if ((side > 0) == (y1 > y0)) winding += y1 > y0 ? 1 : -1;
  }
  return winding;
}

/// All that a ring goes around: of the faces between its edges, those that it goes around at least once. Null
/// where GEOS fails.
std::unique_ptr<OGRGeometry> goneAround(const OGRLinearRing& ring) {
  OGRLineString line;
  line.addSubLineString(&ring);
  const std::unique_ptr<OGRGeometry> crossed(line.Union(&line));  // edges end where they cross
  if (!crossed) return nullptr;
  OGRGeometryCollection edges;
  if (OGR_GT_IsSubClassOf(wkbFlatten(crossed->getGeometryType()), wkbGeometryCollection))
    for (const OGRGeometry* edge : *crossed->toGeometryCollection()) edges.addGeometry(edge);
  else
    edges.addGeometry(crossed.get());
  const std::unique_ptr<OGRGeometry> faces(edges.Polygonize());
  if (!faces) return nullptr;
  OGRMultiPolygon all, kept;
  collect(*faces, all);
  for (OGRPolygon* face : all) {
    const std::unique_ptr<OGRGeometry> inside(
        OGRGeometry::FromHandle(OGR_G_PointOnSurface(OGRGeometry::ToHandle(face))));
    if (inside && wkbFlatten(inside->getGeometryType()) == wkbPoint &&
        windingNumber(ring, *inside->toPoint()) != 0)
      kept.addGeometry(face);
  }
  if (kept.IsEmpty()) return std::make_unique<OGRMultiPolygon>();
  return std::unique_ptr<OGRGeometry>(kept.UnionCascaded());
}

/// All that the outer ring of a polygon goes around but its holes do not.
std::unique_ptr<OGRGeometry> goneAround(const OGRPolygon& polygon) {
  const OGRLinearRing* outer = polygon.getExteriorRing();
  auto area = outer ? goneAround(*outer) : nullptr;
  for (int i = 0; area && i < polygon.getNumInteriorRings(); ++i)
    if (const auto hole = goneAround(*polygon.getInteriorRing(i)); hole && !hole->IsEmpty())
      area.reset(area->Difference(hole.get()));
  return area;
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

OGRMultiPolygon repaired(const OGRMultiPolygon& polygons, Warnings& warnings) {
  if (!OGRGeometryFactory::haveGEOS()) return polygons;
  const GdalErrors quiet;
  OGRMultiPolygon result;
  bool isWarned = false;
  for (const OGRPolygon* polygon : polygons) {
    if (polygon->IsValid()) {
      result.addGeometry(polygon);
      continue;
    }
    // Nothing is left of one that its holes cover.
    OGRMultiPolygon valid;
    const auto made = goneAround(*polygon);
    if (made) collect(*made, valid);
    if (!made && !isWarned) {
      warnings.push_back({WarningCode::geometry, "a polygon crosses itself and cannot be repaired"});
      isWarned = true;
    }
    if (!made) result.addGeometry(polygon);
    for (const OGRPolygon* part : valid) result.addGeometry(part);
  }
  return result;
}

OGRMultiPolygon united(const OGRMultiPolygon& polygons, Warnings& warnings) {
  if (polygons.getNumGeometries() < 2) return polygons;
  const GdalErrors quiet;
  OGRMultiPolygon result;
  const std::unique_ptr<OGRGeometry> made(OGRGeometryFactory::haveGEOS() ? polygons.UnionCascaded()
                                                                         : nullptr);
  if (made) collect(*made, result);
  if (!result.IsEmpty()) return result;
  warnings.push_back(
      {WarningCode::geometry, "the polygons cannot be united; where two of them overlap counts as outside"});
  return polygons;
}

OGRMultiPolygon withinOneTurn(const OGRMultiPolygon& polygons, double turn, Warnings& warnings) {
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
  warnings.push_back(
      {WarningCode::geometry, "the polygons reach over more than a turn and cannot be united"});
  return polygons;
}

}  // namespace arete
