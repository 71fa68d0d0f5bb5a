// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/scene/placed_surface.h"

#include <algorithm>
#include <array>
#include <limits>

#include "terrain/model/camera.h"

namespace arete {
namespace {

/// East, north and up in metric space, at right angles; left-handed where that is mirrored.
std::array<Vec3, 3> axesOf(const TerrainModel& terrain) {
  const Vec3 origin = metricPosition({0, 0}, 0, terrain);
  const Vec3 east = metricPosition({1, 0}, 0, terrain) - origin;
  const Vec3 north = unit(metricPosition({0, 1}, 0, terrain) - origin);
  const Vec3 right{north.y, -north.x, 0};
  return {dot(right, east) > 0 ? right : -right, north, Vec3{0, 0, 1}};
}

}  // namespace

Similarity zUp(const SurfaceModel& model, const std::string& up) {
  const bool isYUp = (up.empty() ? model.up : up) == "y";
  if (!isYUp) return {};
  return Similarity(std::array{Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}}, 1, {});
}

Vec3 pivotOf(const StatedObject& stated, const SurfaceModel& model) {
  if (stated.anchor == StatedObject::Anchor::origin) return {};
  const Similarity turned = Similarity(stated.turn, 1, {}) * zUp(model, stated.up);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Vec3 low{kInfinite, kInfinite, kInfinite}, high = -low;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
    const Vec3 p = turned(model.mt.position(VertexId(v)));
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return turned.inverse()({(low.x + high.x) / 2, (low.y + high.y) / 2, low.z});
}

Similarity placedInScene(const PlacedObject& object, const SurfaceModel& model, const TerrainModel* terrain) {
  const StatedObject& stated = object.stated;
  const Vec3 anchor = terrain ? metricPosition(object.xy, object.height, *terrain)
                              : Vec3{object.xy.x, object.xy.y, object.height};
  const Similarity standing(terrain ? axesOf(*terrain) : Similarity().axes(), 1, anchor);
  const Similarity upright = Similarity(stated.turn, stated.scale, {}) * zUp(model, stated.up);
  // Large coordinates of a file are taken off before anything is multiplied.
  const Vec3 toFile = model.mt.metric().origin - pivotOf(stated, model);
  return standing * upright * Similarity(Turn{}, 1, toFile);
}

}  // namespace arete
