// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/finite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/counted.h"

namespace arete {

std::optional<std::uint32_t> firstUnusable(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
      if (!isFinite(mesh.positions[v])) return v;
    return std::nullopt;
  }
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      if (v < mesh.positions.size() && !isFinite(mesh.positions[v])) return v;
  return std::nullopt;
}

void leaveOutUnusedNumbers(MeshFile& file) {
  SurfaceMesh& mesh = file.mesh;
  const std::size_t count = mesh.positions.size();
  if (mesh.triangles.empty() ||
      std::ranges::all_of(mesh.positions, [](const Vec3& p) { return isFinite(p); }))
    return;
  std::vector<std::uint8_t> isUsed(count, 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) {
      if (v >= count) return;  // is refused elsewhere
      isUsed[v] = 1;
    }
  std::vector<std::uint32_t> kept, numberOf(count, 0);
  for (std::uint32_t v = 0; v < count; ++v)
    if (isUsed[v] != 0 || isFinite(mesh.positions[v])) {
      numberOf[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(v);
    }
  if (kept.size() == count) return;
  for (Attribute& attribute : mesh.vertexAttributes) {
    Attribute fewer = emptyLike(attribute);
    for (const std::uint32_t v : kept) fewer.append(attribute.element(v));
    attribute = std::move(fewer);
  }
  std::vector<std::uint32_t> vertexOf;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    mesh.positions[i] = mesh.positions[kept[i]];
    vertexOf.push_back(file.vertexOf.empty() ? kept[i] : file.vertexOf[kept[i]]);
  }
  mesh.positions.resize(kept.size());
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& v : triangle) v = numberOf[v];
  file.vertexOf = std::move(vertexOf);
  file.warnings.push_back(
      {WarningCode::omitted,
       fmt::format("{} left out",
                   counted(count - kept.size(), "vertex without a face has a coordinate that is not finite:",
                           "vertices without a face have coordinates that are not finite:"))});
}

}  // namespace arete
