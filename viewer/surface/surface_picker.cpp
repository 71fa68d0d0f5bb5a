// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_picker.h"

#include <fmt/format.h>

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

std::string SurfacePicker::partsOf(TriangleId triangle) const {
  const MeshAttributes& a = model_.attributes;
  if (triangle.index() >= model_.faceOf.size()) return {};
  const std::uint32_t face = model_.faceOf[triangle.index()];
  std::string parts;
  const auto add = [&](const std::string& name, const std::string& value) {
    parts += (parts.empty() ? "" : ", ") + name + " " + value;
  };
  const auto addNamed = [&](const char* what, const std::vector<std::uint32_t>& of,
                            const std::vector<std::string>& names) {
    if (face < of.size() && of[face] < names.size()) add(what, names[of[face]]);
  };
  addNamed("object", a.objectOf, a.objects);
  addNamed("group", a.groupOf, a.groups);
  for (const Attribute& each : a.triangleAttributes) {
    if (face >= each.elementCount()) continue;
    std::string numbers;
    for (const double number : each.numbers(face))
      numbers += fmt::format("{}{:.9g}", numbers.empty() ? "" : " ", number);
    add(each.name, numbers);
  }
  return parts;
}

}  // namespace arete
