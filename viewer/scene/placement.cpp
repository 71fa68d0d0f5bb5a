// SPDX-License-Identifier: GPL-3.0-or-later
//
// East, north and up at the anchor are found from where the scene draws its neighbours a metre away: on flat
// ground the axes of the map, on a curved Earth the ones of the place. They are left-handed where the metric
// space is mirrored against the map, so that an object is mirrored there and once more in the picture.
#include "viewer/scene/placement.h"

#include <array>
#include <cmath>

#include "viewer/scene/subject.h"

namespace arete {
namespace {

Similarity standing(const Placement& p, const std::array<Vec3, 3>& axes, const Vec3& anchor) {
  const Similarity about(Turn{}, 1, -p.pivot), turned(p.turn, p.scale, {});
  return Similarity(axes, 1, anchor) * turned * about;
}

/// At right angles: north stays, east gives way where a sheared grid leans it.
std::array<Vec3, 3> upright(const Vec3& east, const Vec3& north, bool isMirrored) {
  const Vec3 up = unit(isMirrored ? cross(north, east) : cross(east, north));
  const Vec3 y = unit(north);
  return {isMirrored ? cross(up, y) : cross(y, up), y, up};
}

}  // namespace

Similarity placed(const Placement& placement, const Subject* scene) {
  if (!scene) return standing(placement, Similarity().axes(), placement.anchor);
  const CameraSpace& space = scene->space();
  return standing(placement, upright(space.forward({90, 0}), space.forward({0, 0}), space.isMirrored()),
                  placement.anchor);
}

Similarity placedAsDrawn(const Placement& placement, const Subject* scene, const ViewSettings& settings) {
  if (!scene) return placed(placement, scene);
  const CameraSpace& space = scene->space();
  const Vec3 at = scene->drawn(placement.anchor, settings);
  const auto towards = [&](double azimuth) {
    return scene->drawn(placement.anchor + space.forward({azimuth, 0}), settings) - at;
  };
  const Vec3 east = towards(90), north = towards(0);
  if (!isFinite(at + east + north)) return placed(placement, scene);
  return standing(placement, upright(east, north, space.isMirrored()), at);
}

}  // namespace arete
