// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/model/surface_mesh.h"

namespace arete {

/// Vertex attributes become attributes of wedges, one wedge for each vertex; so vertices can be joined
/// without a loss. An attribute of wedges that has the name of one of vertices stays, and that of vertices is
/// left out: corners say more. O(size). Precondition: the mesh is valid.
void moveToWedges(SurfaceMesh& mesh);

/// The other way: equal wedges of a vertex become one, and an attribute that all wedges of each vertex agree
/// about becomes one of vertices, where there is none of its name. Values are compared by their bytes.
/// Vertices that no triangle uses get zeros. O(n log n). Precondition: the mesh is valid.
void moveToVertices(SurfaceMesh& mesh);

/// Equal wedges of a vertex become one; without an attribute of wedges there are none. Values are compared by
/// their bytes. O(n log n). Precondition: the mesh is valid.
void joinEqualWedges(SurfaceMesh& mesh);

/// The same mesh with a vertex for each wedge of a vertex, as formats need it that have no corners:
/// attributes of wedges become attributes of vertices, instead of those of the same name. The first wedge of
/// a vertex keeps its number; further ones follow the vertices of the source, in the order of the triangles.
/// A mesh without wedges is copied. O(n log n). Precondition: the mesh is valid.
struct SplitMesh {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: that of the source
};
SplitMesh splitByWedges(MeshRef mesh);

}  // namespace arete
