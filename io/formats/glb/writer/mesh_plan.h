// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// The triangles of an object that have one material, in their order.
struct PrimitivePlan {
  std::uint32_t material = MeshAttributes::kNone;
  std::vector<std::uint32_t> triangles;
};

/// An object, which becomes a node with a mesh.
struct ObjectPlan {
  std::string name;  ///< empty: of triangles without an object
  /// Of its primitives together, in the order of the mesh. Empty: all of the mesh, also those that no
  /// triangle has.
  std::vector<std::uint32_t> vertices;
  std::vector<PrimitivePlan> primitives;  ///< by their first triangle
};

struct MeshPlan {
  std::vector<ObjectPlan> objects;  ///< in the order of the mesh; triangles without an object come first
  std::vector<std::string> lost;    ///< as in MeshWriteReport
};

/// Distributes the triangles of a mesh without wedges. O(size).
MeshPlan planMeshes(const SurfaceMesh& mesh);

}  // namespace arete
