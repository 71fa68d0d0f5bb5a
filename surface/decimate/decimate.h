// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/attributes/attribute_weight.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// What makes a mesh smaller, step by step or at once.
enum class DecimateOperator {
  edge,           ///< edges become a vertex, at the least of its quadric [GarlandHeckbert1997]
  halfEdge,       ///< a vertex goes to a neighbour; cost by quadrics
  vertexPair,     ///< edges, and pairs of vertices that are near and have no edge [GarlandHeckbert1997]
  face,           ///< triangles become a vertex
  cluster,        ///< vertices of a cell of an octree become one
  lindstromTurk,  ///< edges, memoryless [LindstromTurk1998]: CGAL's
};

/// How the cost of a step is kept while its surroundings change [Cohen1998].
enum class DecimateQueue {
  greedy,    ///< computed anew at once
  lazy,      ///< computed anew when it is the least one
  estimate,  ///< an estimate, the spread of the vertices, lazily; the quadric is solved in the step alone
};

struct DecimateOptions {
  DecimateOperator method = DecimateOperator::edge;
  DecimateQueue queue = DecimateQueue::lazy;
  std::uint32_t maxTriangles = 0;
  /// Of the planes of a quadric: by the areas of their triangles, or equal.
  bool weighsByArea = true;
  /// Places a cluster at its best input vertex instead of its quadric's minimum.
  bool keepsClusterVertices = false;
  bool keepsBorders = false;
  /// Steps that would make the surface cross itself are refused. Of the operators that contract edges or
  /// triangles.
  bool forbidsCrossings = false;
  /// Of continuous attributes; one that is not here does not count. Attributes are solved together with the
  /// places, side by side of a seam, whatever they count. Of all methods but Lindstrom-Turk.
  std::vector<AttributeWeight> attributeWeights = {};
};

struct DecimatedMesh {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: one of the vertices of the source that it stands for
  std::vector<std::uint32_t> faceOf;    ///< by triangle: that of the source
  /// By face of the source: the triangle that stands for it; MeshAttributes::kNone: nothing near it is left.
  std::vector<std::uint32_t> triangleFor;
  /// Normals of corners were those of flat faces, and are left out (surface/edit/normals.h).
  bool dropsFlatNormals = false;
  std::uint64_t evaluations = 0;  ///< costs computed, estimates not among them
  std::uint64_t steps = 0;
  /// What could not be carried along: "texture coordinates" and so on.
  std::vector<std::string> lost;
};

/// Makes a mesh smaller until it has at most maxTriangles, or no step is left that keeps it a surface: what
/// is left then is the result (the caller compares the counts). Steps keep manifoldness, components and
/// genus, but for vertex pairs and clusters; no triangle turns by more than 90 degrees, but for clusters.
/// Borders are simplified along with the rest, held by planes across them. Vertices at seams and at edges
/// between objects or materials only move along them. Triangles without area are left out first, as a build
/// leaves them out (surface/repair/repair.h), and no step makes one. All is computed around a vertex of the
/// mesh: the same mesh elsewhere gives the same triangles, and the same mesh the same bytes. Errors:
/// invalidData: mesh.validate(), maxTriangles of 0, a diagonal of the box that is not between 1e-30 and 1e30,
/// a result without triangles (of clusters), and of Lindstrom-Turk edges of more than two triangles or a
/// vertex of more than 512 triangles whose neighbours cannot be joined; interrupted. O(n log n).
Result<DecimatedMesh> decimate(const SurfaceMesh& mesh, const DecimateOptions& options,
                               const RunContext& context = {});

}  // namespace arete
