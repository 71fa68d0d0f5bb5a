// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/builder/left_out_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_bvh.h"

namespace arete {
namespace {

/// A position and a triangle with a corner there.
using CornerAt = std::pair<std::array<double, 3>, std::uint32_t>;
/// Of distances, beside the largest coordinate.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

std::array<double, 3> keyOf(const Vec3& p) {
  return {p.x + 0.0, p.y + 0.0, p.z + 0.0};  // one zero
}

SpaceTriangle placeOf(const TriangleMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

/// Whether a triangle has the same corners as another one, in the same turn.
bool turnsAlike(const SpaceTriangle& s, const SpaceTriangle& t) {
  for (std::size_t first = 0; first < 3; ++first)
    if (s[0] == t[first] && s[1] == t[(first + 1) % 3] && s[2] == t[(first + 2) % 3]) return true;
  return false;
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
  if (places.empty() || mended.triangles.empty()) return found;
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<CornerAt> corners;
  for (std::uint32_t t = 0; t < mended.triangles.size(); ++t)
    for (const Vec3& p : placeOf(mended, t))
      if (const auto key = keyOf(p); std::ranges::binary_search(places, key)) corners.emplace_back(key, t);
  std::ranges::sort(corners);
  const TriangleBvh all(mended.positions, mended.triangles);
  double largest = 0;
  for (const Vec3& p : mended.positions)
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  const double rounding = kRounding * largest;
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
    if (touching.empty()) continue;
    std::ranges::sort(touching);
    const Vec3 middle = face[0] / 3 + face[1] / 3 + face[2] / 3;
    const TriangleBvh::Answer nearest = all.nearest(middle);
    // Of those in which the middle lies but for rounding; the first of the best.
    const double within = std::sqrt(nearest.squaredDistance) + rounding;
    std::pair best{0, faceOf[nearest.triangle]};  // corners in common, less is more; face
    for (std::size_t i = 0, end; i < touching.size(); i = end) {
      for (end = i; end < touching.size() && touching[end] == touching[i]; ++end) continue;
      const SpaceTriangle place = placeOf(mended, touching[i]);
      if (distanceToTriangle(middle, place) > within) continue;
      const int same = turnsAlike(face, place) ? 4 : int(end - i);
      best = std::min(best, {-same, faceOf[touching[i]]});
    }
    found.push_back({f, best.second});
  }
  return found;
}

}  // namespace arete
