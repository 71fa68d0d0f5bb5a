// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/repair/draft.h"

#include <numeric>
#include <utility>

namespace arete::repair_passes {

Draft::Draft(const TriangleMesh& source)
    : mesh(source),
      vertexOf(source.positions.size()),
      triangleOf(source.triangles.size()),
      isTurned(source.triangles.size(), 0) {
  std::iota(vertexOf.begin(), vertexOf.end(), 0u);
  std::iota(triangleOf.begin(), triangleOf.end(), 0u);
}

std::uint32_t Draft::copyVertex(std::uint32_t vertex) {
  const Vec3 position = mesh.positions[vertex];
  const std::uint32_t source = vertexOf[vertex];
  mesh.positions.push_back(position);
  vertexOf.push_back(source);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void Draft::addTriangle(const Triangle& corners, std::uint32_t like) {
  mesh.triangles.push_back(corners);
  // A part names the source of the whole, so that parts of parts name it too.
  triangleOf.push_back(like == RepairedMesh::kNone ? like : triangleOf[like]);
  isTurned.push_back(like == RepairedMesh::kNone ? std::uint8_t{0} : isTurned[like]);
}

void Draft::turn(std::uint32_t triangle) {
  std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
  isTurned[triangle] ^= 1;
  ++turns;
}

void Draft::removeTriangles(const std::vector<std::uint8_t>& isGone) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (isGone[t] != 0) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    triangleOf[kept] = triangleOf[t];
    isTurned[kept] = isTurned[t];
    ++kept;
  }
  mesh.triangles.resize(kept);
  triangleOf.resize(kept);
  isTurned.resize(kept);
}

void Draft::removeUnusedVertices() {
  std::vector<std::uint32_t> number(mesh.positions.size(), RepairedMesh::kNone);
  // A number of 0 marks a used vertex until it has its own.
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) number[v] = 0;
  std::uint32_t kept = 0;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == RepairedMesh::kNone) continue;
    number[v] = kept;
    mesh.positions[kept] = mesh.positions[v];
    vertexOf[kept] = vertexOf[v];
    ++kept;
  }
  counts.unusedVertices += mesh.positions.size() - kept;
  mesh.positions.resize(kept);
  vertexOf.resize(kept);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = number[v];
}

}  // namespace arete::repair_passes
