// SPDX-License-Identifier: GPL-3.0-or-later
//
// Double vertices: sorted by position, equal ones are side by side.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "surface/diagnosis/parts.h"

namespace arete::diagnosis {

void add(MeshFindings& findings, std::size_t most, std::vector<std::uint32_t> elements, const Vec3& place) {
  if (findings.count++ < most) findings.places.push_back({std::move(elements), place});
}

std::array<Vec3, 2> boxOf(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  Vec3 low = mesh.positions[mesh.triangles[0][0]], high = low;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) {
      const Vec3& p = mesh.positions[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  return {low, high};
}

double diagonalOf(const std::array<Vec3, 2>& box) {
  const Vec3 span = box[1] - box[0];
  return std::hypot(span.x, span.y, span.z);
}

void examineVertices(const TriangleMesh& mesh, const DiagnosisOptions& options, MeshDiagnosis& result) {
  std::vector<std::uint8_t> isUsed(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) isUsed[v] = 1;
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    if (isUsed[v] == 0) {
      add(result.unusedVertices, options.mostPlaces, {v}, p);
      continue;
    }
    used.push_back(v);
  }
  if (used.empty()) return;
  // Adding 0 makes -0 and 0 one key, as they are one position.
  const auto key = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return std::tuple(p.x + 0, p.y + 0, p.z + 0);
  };
  std::ranges::sort(used, [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> doubles;  // the other one, the first one
  for (std::size_t i = 0, first = 0; i < used.size(); ++i) {
    if (key(used[i]) != key(used[first])) first = i;
    if (i != first) doubles.push_back({used[i], used[first]});
  }
  std::ranges::sort(doubles);
  for (const auto& [other, first] : doubles)
    add(result.doubleVertices, options.mostPlaces, {first, other}, mesh.positions[other]);
}

}  // namespace arete::diagnosis
