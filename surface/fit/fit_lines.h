// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/vec.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The lines of a cut (surface/model/parts.h), each edge with the way of the source that it stands for.
struct FitLines {
  struct Edge {
    std::array<std::uint32_t, 2> ends{};  ///< vertices of the cut
    /// The edges that go on at the ends; MeshAttributes::kNone: the end stays.
    std::array<std::uint32_t, 2> next{MeshAttributes::kNone, MeshAttributes::kNone};
    std::vector<Vec3> way = {};  ///< of the source, from the first end to the second
  };
  /// Edges with an end that may move.
  std::vector<Edge> edges;
  /// By vertex of the cut: it is in the middle of one line, whose ways are known. Empty: no vertex is.
  std::vector<std::uint8_t> mayMove;

  bool isEmpty() const { return edges.empty(); }
};

/// Finds the lines along which vertices of a cut may be moved. Where a line ends, branches or meets a border,
/// and where a place of the source has several vertices at lines, vertices stay.
/// @param cut  its vertices are at places of vertices of the source
/// O(n log n).
FitLines fitLines(const SurfaceMesh& cut, const SurfaceMesh& source);

}  // namespace arete
