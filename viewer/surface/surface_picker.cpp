// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_picker.h"

#include "surface/rays/first_hit.h"

namespace arete {

std::optional<SurfacePick> SurfacePicker::along(const Vec3& eye, const Vec3& direction) const {
  const auto hit = firstHit(model_.mt, upright_.turnedBack(eye), upright_.turnedBack(direction));
  if (!hit) return std::nullopt;
  return SurfacePick{eye + hit->along * direction, hit->along * norm(direction), hit->triangle};
}

std::string SurfacePicker::materialOf(TriangleId triangle) const {
  const MeshAttributes& a = model_.attributes;
  if (a.materialOf.empty() || triangle.index() >= model_.faceOf.size()) return {};
  const std::uint32_t face = model_.faceOf[triangle.index()];
  const std::uint32_t material = face < a.materialOf.size() ? a.materialOf[face] : std::uint32_t(-1);
  return material < a.materials.size() ? a.materials[material].name : std::string();
}

}  // namespace arete
