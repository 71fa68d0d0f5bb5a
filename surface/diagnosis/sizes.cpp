// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/diagnosis/sizes.h"

#include "surface/diagnosis/parts.h"

namespace arete {

double areaOf(const TriangleMesh& mesh) {
  double twice = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& p = mesh.positions[a];
    twice += norm(cross(mesh.positions[b] - p, mesh.positions[c] - p));
  }
  return twice / 2;
}

double volumeOf(const TriangleMesh& mesh) {
  const auto [low, high] = diagnosis::boxOf(mesh);
  const Vec3 middle = low / 2 + high / 2;
  double sixfold = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sixfold += dot(mesh.positions[a] - middle, cross(mesh.positions[b] - middle, mesh.positions[c] - middle));
  return sixfold / 6;
}

}  // namespace arete
