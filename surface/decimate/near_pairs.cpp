// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices are sorted into cells as wide as the distance, so that near ones are in neighbouring cells.
#include "surface/decimate/near_pairs.h"

#include <algorithm>
#include <map>

#include "engine/base/box3.h"

namespace arete {
namespace {

/// Of the diagonal.
constexpr double kPairDistance = 0.005;

}  // namespace

std::vector<std::array<std::uint32_t, 2>> nearPairs(const ContractionMesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  const auto count = static_cast<std::uint32_t>(mesh.vertexCount());
  Box3 box = Box3::empty();
  for (std::uint32_t v = 0; v < count; ++v) box.include(mesh.position(v));
  const double reach = count > 0 ? kPairDistance * box.diagonal() : 0;
  if (!(reach > 0)) return pairs;
  using Cell = std::array<std::int64_t, 3>;
  const auto cellOf = [&](const Vec3& p) {
    return Cell{static_cast<std::int64_t>((p.x - box.low.x) / reach),
                static_cast<std::int64_t>((p.y - box.low.y) / reach),
                static_cast<std::int64_t>((p.z - box.low.z) / reach)};
  };
  std::map<Cell, std::vector<std::uint32_t>> cells;
  for (std::uint32_t v = 0; v < count; ++v)
    if (!mesh.trianglesOf(v).empty()) cells[cellOf(mesh.position(v))].push_back(v);
  ContractionMesh::Neighbours neighbours;
  for (const auto& [cell, vertices] : cells)
    for (const std::uint32_t v : vertices) {
      mesh.neighboursOf(v, neighbours);
      for (std::int64_t i = 0; i < 27; ++i) {
        const auto found = cells.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
        if (found == cells.end()) continue;
        for (const std::uint32_t w : found->second)
          if (w > v && norm(mesh.position(w) - mesh.position(v)) < reach &&
              !std::ranges::binary_search(neighbours, w))
            pairs.push_back({v, w});
      }
    }
  return pairs;
}

}  // namespace arete
