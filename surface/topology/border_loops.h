// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/topology/edges.h"
#include "surface/topology/fans.h"

namespace arete {

/// Border sides that follow each other, each at the fan that it shares with the next one.
struct BorderLoop {
  std::vector<CornerId> sides;
  /// False for a chain that ends at edges of more than two sides.
  bool isClosed = true;
};

/// All borders of a mesh, ordered by their lowest sides, with which a closed one begins. A loop passes a
/// vertex more than once where it touches itself in several fans. O(corners).
std::vector<BorderLoop> findBorderLoops(const MeshEdges& edges, const MeshFans& fans);

}  // namespace arete
