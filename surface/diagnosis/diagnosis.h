// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// One place where something is found.
struct MeshFinding {
  /// Vertices, edges as two vertices, or triangles, as MeshFindings says; numbers of the mesh.
  std::vector<std::uint32_t> elements;
  Vec3 place;
  bool operator==(const MeshFinding&) const = default;
};

/// What is found of one kind: how often, and the first places, in the order of their elements.
struct MeshFindings {
  std::uint64_t count = 0;
  std::vector<MeshFinding> places;
};

/// A border: edges with one triangle that follow each other around a hole or an outline.
struct MeshBorder {
  std::uint32_t component = 0;
  std::uint32_t edgeCount = 0;
  double length = 0;
  std::uint32_t firstVertex = 0;
  /// False where it ends at edges of more than two triangles.
  bool isClosed = true;
};

/// Triangles that are joined across edges.
struct ComponentDiagnosis {
  std::uint32_t firstTriangle = 0;
  std::uint64_t triangles = 0, edges = 0, vertices = 0;
  std::uint32_t borders = 0;
  std::uint64_t nonManifoldEdges = 0;     ///< of more than two triangles
  std::uint64_t nonManifoldVertices = 0;  ///< whose triangles here form several fans
  std::uint64_t turnedEdges = 0;          ///< whose two triangles turn against each other
  bool isOrientable = true;
  /// vertices - edges + triangles.
  std::int64_t eulerNumber = 0;
  /// The number of handles; missing unless the component is manifold and orientable.
  std::optional<std::int64_t> genus;

  bool isManifold() const { return nonManifoldEdges == 0 && nonManifoldVertices == 0; }
  bool isClosed() const { return borders == 0; }
};

/// What is the matter with a mesh. Topology is that of the triangles with three different vertices.
struct MeshDiagnosis {
  std::uint64_t vertices = 0, triangles = 0;
  Vec3 boxLow, boxHigh;  ///< of the vertices that triangles use
  double diagonal = 0;   ///< of that box

  MeshFindings unusedVertices;       ///< one vertex: no triangle has it
  MeshFindings doubleVertices;       ///< two vertices at one position: the first one there, and another
  MeshFindings degenerateTriangles;  ///< one triangle: a vertex twice, or three on one line, exactly
  MeshFindings duplicateTriangles;  ///< two triangles with the same vertices and turn: the first, and another
  /// Two triangles with the same vertices that turn against each other: a sheet with two sides, which is no
  /// fault.
  MeshFindings doubleSided;
  MeshFindings nonManifoldEdges;     ///< two vertices: more than two triangles have the edge
  MeshFindings nonManifoldVertices;  ///< one vertex: several fans, and no edge of more than two triangles
  MeshFindings turnedEdges;          ///< two vertices: the edge's two triangles turn against each other
  MeshFindings nonOrientable;        ///< two vertices: an edge of a part that no turns make coherent
  MeshFindings tJunctions;           ///< a vertex, and the two of the border edge inside which it lies
  /// Two vertices: a border edge that is another one but for the rounding of the file.
  MeshFindings nearBorders;
  double farthestNear = 0;        ///< how far apart the ends of such edges are, at most
  double shortestBorderEdge = 0;  ///< that has a length; 0: there is none
  /// Two triangles that meet elsewhere than in the vertices and the edge they share. Missing unless asked
  /// for.
  std::optional<MeshFindings> selfIntersections;

  std::vector<MeshBorder> borders;
  std::vector<ComponentDiagnosis> components;
  /// By triangle; the number of components where a vertex occurs twice in the triangle.
  std::vector<std::uint32_t> componentOf;
};

struct DiagnosisOptions {
  /// Places of self-intersections, whose number may be the square of that of the triangles.
  static constexpr std::size_t kMostCrossings = 100'000;

  std::size_t mostPlaces = 10;  ///< of a kind
  bool selfIntersections = true;
  /// How far from a border edge a vertex may lie to be inside it, as a part of the diagonal.
  double tJunctionTolerance = 1e-9;
  /// The most by which rounding to the numbers of a file may have moved a vertex, in the unit of the mesh. A
  /// vertex within twice as much of a border edge is inside it too; border edges whose ends are within twice
  /// as much of those of others, and within a tenth of their lengths, are near borders.
  double rounding = 0;
};

/// Examines a mesh. All but distances in T-junctions and near borders is exact: equal positions are equal
/// doubles, and whether points are on one line and triangles meet is decided by exact predicates.
///
/// O(n log n) for n triangles, and for self-intersections that of the pairs whose boxes meet
/// [ZomorodianEdelsbrunner2000], of which those in one place or at one vertex are not examined one by one.
/// The result does not depend on the number of threads. Errors: invalidData (an index without a position, a
/// coordinate that is not finite; TriangleMesh::validate()), unsupported (too many triangles for 32-bit
/// corners), interrupted, outOfMemory.
Result<MeshDiagnosis> diagnose(const TriangleMesh& mesh, const DiagnosisOptions& options = {},
                               const RunContext& context = {});

}  // namespace arete
