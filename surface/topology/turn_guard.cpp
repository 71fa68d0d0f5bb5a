// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/topology/turn_guard.h"

#include <cmath>

#include "surface/topology/edges.h"

namespace arete {
namespace {

constexpr double kLeastTurn = 0.5;  // cosine: a triangle turns by at most 60 degrees
constexpr double kMostFold = -0.5;  // cosine: an edge folds by at most 120 degrees

double cosineOf(const Vec3& a, const Vec3& b) {
  const double sizes = norm(a) * norm(b);
  return sizes > 0 ? dot(a, b) / sizes : 1;
}

}  // namespace

TurnGuard::TurnGuard(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> before)
    : triangles_(triangles), firstNormals_(normalsOf(before)) {
  const MeshEdges edges(triangles, before.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const MeshEdges::Edge edge = edges[e];
    if (edge.sides.size() != 2) continue;
    const std::uint32_t s = triangleOf(edge.sides[0]).index(), t = triangleOf(edge.sides[1]).index();
    if (!(cosineOf(firstNormals_[s], firstNormals_[t]) < kMostFold)) neighbours_.push_back({s, t});
  }
}

std::vector<Vec3> TurnGuard::normalsOf(std::span<const Vec3> positions) const {
  std::vector<Vec3> normals;
  normals.reserve(triangles_.size());
  for (const auto& [i, j, k] : triangles_)
    normals.push_back(cross(positions[j] - positions[i], positions[k] - positions[i]));
  return normals;
}

bool TurnGuard::mark(std::span<const Vec3> after, std::span<std::uint8_t> stays) const {
  const std::vector<Vec3> normals = normalsOf(after);
  bool isNew = false;
  const auto hold = [&](std::uint32_t t) {
    for (const std::uint32_t v : triangles_[t]) {
      isNew = isNew || stays[v] == 0;
      stays[v] = 1;
    }
  };
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    if (norm(firstNormals_[t]) > 0 &&
        (!(norm(normals[t]) > 0) || cosineOf(normals[t], firstNormals_[t]) < kLeastTurn))
      hold(t);
  for (const auto& [s, t] : neighbours_) {
    if (!(cosineOf(normals[s], normals[t]) < kMostFold)) continue;
    hold(s);
    hold(t);
  }
  return isNew;
}

}  // namespace arete
