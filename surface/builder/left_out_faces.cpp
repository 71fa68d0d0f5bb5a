// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/builder/left_out_faces.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/base/nearest_on_triangle.h"

namespace arete {
namespace {

/// A position and a triangle with a corner there.
using CornerAt = std::pair<std::array<double, 3>, std::uint32_t>;

std::array<double, 3> keyOf(const Vec3& p) {
  return {p.x + 0.0, p.y + 0.0, p.z + 0.0};  // one zero
}

SpaceTriangle placeOf(const TriangleMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

}  // namespace

std::vector<SurfaceModel::LeftOutFace> leftOutFacesOf(const TriangleMesh& source, const TriangleMesh& mended,
                                                      std::span<const std::uint32_t> faceOf) {
  std::vector<std::uint8_t> stays(source.triangles.size(), 0);
  for (const std::uint32_t f : faceOf) stays[f] = 1;
  std::vector<std::array<double, 3>> places;  // of corners of faces that are left out
  for (std::uint32_t f = 0; f < stays.size(); ++f)
    if (stays[f] == 0)
      for (const Vec3& p : placeOf(source, f)) places.push_back(keyOf(p));
  std::vector<SurfaceModel::LeftOutFace> found;
  if (places.empty()) return found;
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<CornerAt> corners;
  for (std::uint32_t t = 0; t < mended.triangles.size(); ++t)
    for (const Vec3& p : placeOf(mended, t))
      if (const auto key = keyOf(p); std::ranges::binary_search(places, key)) corners.emplace_back(key, t);
  std::ranges::sort(corners);
  for (std::uint32_t f = 0; f < stays.size(); ++f) {
    if (stays[f] != 0) continue;
    const SpaceTriangle face = placeOf(source, f);
    std::array keys{keyOf(face[0]), keyOf(face[1]), keyOf(face[2])};
    std::ranges::sort(keys);
    std::vector<std::uint32_t> touching;  // once for each corner in common
    for (std::size_t i = 0; i < 3; ++i) {
      if (i > 0 && keys[i] == keys[i - 1]) continue;
      auto at = std::ranges::lower_bound(corners, CornerAt{keys[i], 0});
      for (; at != corners.end() && at->first == keys[i]; ++at) touching.push_back(at->second);
    }
    std::ranges::sort(touching);
    const Vec3 middle = face[0] / 3 + face[1] / 3 + face[2] / 3;
    std::tuple best{std::numeric_limits<double>::infinity(), 0, 0u};  // distance; corners, less is more; face
    for (std::size_t i = 0, end; i < touching.size(); i = end) {
      for (end = i; end < touching.size() && touching[end] == touching[i]; ++end) continue;
      best = std::min(best, {distanceToTriangle(middle, placeOf(mended, touching[i])), -int(end - i),
                             faceOf[touching[i]]});
    }
    if (!touching.empty()) found.push_back({f, std::get<2>(best)});
  }
  return found;
}

}  // namespace arete
