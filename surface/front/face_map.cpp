// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/front/face_map.h"

#include <algorithm>
#include <limits>

#include "engine/base/nearest_on_triangle.h"
#include "engine/memory/required_memory.h"

namespace arete {
namespace {

SpaceTriangle placeOf(const MultiTriangulation& mt, TriangleId t) {
  const auto [a, b, c] = mt.corners(t);
  return {mt.position(VertexId(a)), mt.position(VertexId(b)), mt.position(VertexId(c))};
}

/// By face of the source: its middle, that of the parts into which it may have been split.
std::vector<Vec3> middlesOf(const SurfaceModel& model) {
  std::vector<Vec3> middles(model.sourceFaces, Vec3{0, 0, 0});
  std::vector<double> areas(model.sourceFaces, 0);
  for (const bool isSecond : {false, true})
    for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t) {
      if (model.mt.remover(TriangleId(t)).isValid()) continue;
      const SpaceTriangle place = placeOf(model.mt, TriangleId(t));
      const Vec3 middle = (place[0] + place[1] + place[2]) / 3.0;
      const double area = norm(cross(place[1] - place[0], place[2] - place[0]));
      const std::uint32_t of = model.faceOf[t];
      if (!isSecond)
        areas[of] += area;
      else
        middles[of] = areas[of] > 0 ? middles[of] + area / areas[of] * middle : middle;
    }
  return middles;
}

/// From a finest triangle, by the nearest of what its node replaced, to one that has a number.
std::uint32_t climbed(const MultiTriangulation& mt, std::uint32_t finest, const Vec3& middle,
                      const std::vector<std::uint32_t>& numberOf) {
  std::uint32_t t = finest;
  while (numberOf[t] == MeshAttributes::kNone) {
    std::uint32_t nearest = MeshAttributes::kNone;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t candidate : mt.floor(mt.creator(TriangleId(t)))) {
      const double distance = distanceToTriangle(middle, placeOf(mt, TriangleId(candidate)));
      if (distance < least || nearest == MeshAttributes::kNone) nearest = candidate;
      least = std::min(least, distance);
    }
    t = nearest;
  }
  return t;
}

/// The same within a chart: a triangle and one that replaces it on its side of a seam have a wedge in common.
/// kNone where none of what replaced it has.
std::uint32_t climbedInChart(const SurfaceModel& model, std::uint32_t finest, const Vec3& middle,
                             const std::vector<std::uint32_t>& numberOf) {
  const MultiTriangulation& mt = model.mt;
  std::uint32_t t = finest;
  while (numberOf[t] == MeshAttributes::kNone) {
    const auto& own = model.wedgesOf[t];
    std::uint32_t nearest = MeshAttributes::kNone;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t candidate : mt.floor(mt.creator(TriangleId(t)))) {
      const bool isInChart = std::ranges::any_of(model.wedgesOf[candidate], [&](std::uint32_t w) {
        return std::ranges::find(own, w) != own.end();
      });
      const double distance = distanceToTriangle(middle, placeOf(mt, TriangleId(candidate)));
      if (!isInChart || !(distance < least)) continue;
      nearest = candidate;
      least = distance;
    }
    if (nearest == MeshAttributes::kNone) return nearest;
    t = nearest;
  }
  return t;
}

std::vector<std::uint32_t> numbersIn(const MultiTriangulation& mt, const Cut& cut) {
  std::vector<std::uint32_t> numberOf(mt.triangleIdCount(), MeshAttributes::kNone);
  for (std::uint32_t i = 0; i < cut.ids.size(); ++i) numberOf[cut.ids[i]] = i;
  return numberOf;
}

}  // namespace

std::vector<FaceInCut> someFacesOf(const SurfaceModel& model, const Cut& cut, std::uint32_t most) {
  const MultiTriangulation& mt = model.mt;
  const std::vector<std::uint32_t> numberOf = numbersIn(mt, cut);
  std::vector<FaceInCut> found;
  const std::uint32_t step = mt.finestTriangleCount() / std::max(most, 1u) + 1;
  std::uint32_t next = 0;
  for (std::uint32_t finest = 0; finest < mt.triangleIdCount(); ++finest) {
    // Of a part, faces of the source are those alone whose removers are not missing.
    if (mt.remover(TriangleId(finest)).isValid() || mt.isRemoverMissing(TriangleId(finest))) continue;
    if (next++ % step != 0) continue;
    const SpaceTriangle place = placeOf(mt, TriangleId(finest));
    const Vec3 middle = (place[0] + place[1] + place[2]) / 3.0;
    const std::uint32_t t = model.hasWedges() ? climbedInChart(model, finest, middle, numberOf)
                                              : climbed(mt, finest, middle, numberOf);
    if (t != MeshAttributes::kNone) found.push_back({finest, middle, numberOf[t]});
  }
  return found;
}

std::vector<std::uint32_t> facesOf(const SurfaceModel& model, const Cut& cut) {
  const MultiTriangulation& mt = model.mt;
  const std::vector<std::uint32_t> numberOf = numbersIn(mt, cut);
  requireMemory(model.sourceFaces * (sizeof(std::uint32_t) + sizeof(Vec3) + 2 * sizeof(double)));
  std::vector<std::uint32_t> found(model.sourceFaces, MeshAttributes::kNone);
  const std::vector<Vec3> middles = middlesOf(model);
  std::vector<double> distances(middles.size(), std::numeric_limits<double>::infinity());
  for (std::uint32_t finest = 0; finest < mt.triangleIdCount(); ++finest) {
    if (mt.remover(TriangleId(finest)).isValid()) continue;
    // Of the parts of a split face, that which holds its middle.
    const std::uint32_t of = model.faceOf[finest];
    const Vec3& middle = middles[of];
    const double away = distanceToTriangle(middle, placeOf(mt, TriangleId(finest)));
    if (!(away < distances[of])) continue;
    distances[of] = away;
    found[of] = numberOf[climbed(mt, finest, middle, numberOf)];
  }
  for (const auto& [face, in] : model.leftOutFaces) found[face] = found[in];
  return found;
}

}  // namespace arete
