// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "surface/topology/edges.h"

namespace arete {

/// The components of a mesh: triangles that are joined across edges, of any number of sides. Numbered from 0
/// in the order of their first triangles.
struct MeshComponents {
  UninitializedVector<std::uint32_t> componentOf;  ///< by triangle
  std::uint32_t count = 0;

  /// O(triangles), nearly.
  explicit MeshComponents(const MeshEdges& edges);
};

/// How the triangles of a mesh turn. A patch is what is joined across edges of exactly two sides: the largest
/// part whose turns determine each other.
struct MeshOrientation {
  std::vector<std::uint32_t> patchOf;  ///< by triangle
  /// By triangle: whether it turns against the first triangle of its patch.
  std::vector<std::uint8_t> isTurned;
  /// By patch: an edge at which no choice of turns agrees; MeshEdges::size() if the patch is orientable.
  std::vector<std::size_t> contradiction;

  /// O(triangles).
  explicit MeshOrientation(const MeshEdges& edges);
  bool isOrientable(std::uint32_t patch, const MeshEdges& edges) const {
    return contradiction[patch] == edges.size();
  }
};

}  // namespace arete
