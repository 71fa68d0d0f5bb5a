// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"
#include "surface/diagnosis/diagnosis.h"

namespace arete {

struct RepairOptions {
  /// Edges of more than two triangles become several edges, one for each sheet.
  bool splitsSheets = false;
  /// Borders of at most so many edges are filled; 0: none. Filling adds triangles, no vertices.
  std::uint32_t mostHoleEdges = 0;
  bool splitsAtTJunctions = true;
  /// How far from a border edge a vertex may lie to be inside it, as a part of the diagonal.
  double tJunctionTolerance = 1e-9;
  /// The most by which rounding to the numbers of a file may have moved a vertex, in the unit of the mesh. A
  /// vertex within twice as much of a border edge is inside it too.
  double rounding = 0;
  /// Closed parts are turned outwards, and the walls of cavities inwards. If not, only parts whose triangles
  /// do not agree are turned so.
  bool turnsOutwards = true;
  /// By triangle: the solid or object it belongs to; parts of different ones are no cavities of each other.
  /// Empty: all are one.
  std::span<const std::uint32_t> partOf = {};
};

/// How often each thing was mended.
struct RepairCounts {
  std::uint64_t duplicateTriangles = 0;   ///< left out; the first of each stays
  std::uint64_t degenerateTriangles = 0;  ///< left out
  /// Triangles split at a vertex inside their side, where one without area was beyond it; each is one more.
  std::uint64_t splitTriangles = 0;
  /// With another one at the same position, to close a degenerate triangle, a split edge or a hole.
  std::uint64_t joinedVertices = 0;
  std::uint64_t tJunctions = 0;       ///< edges split at a vertex inside them
  std::uint64_t splitSheetEdges = 0;  ///< edges of more than two triangles that were split
  std::uint64_t turnedTriangles = 0;
  /// Closed parts all of whose triangles were turned: outwards, and as walls of a cavity inwards.
  std::uint64_t turnedSolids = 0, turnedCavities = 0;
  std::uint64_t addedVertices = 0;  ///< copies, one for each further fan of a vertex
  std::uint64_t filledHoles = 0, fillingTriangles = 0;
  std::uint64_t unusedVertices = 0;  ///< left out
  bool operator==(const RepairCounts&) const = default;

  bool isNothing() const { return *this == RepairCounts{}; }
};

/// A mended mesh, and where its parts come from.
struct RepairedMesh {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  TriangleMesh mesh;
  /// By vertex: the vertex of the source that it is, or is a copy of. Its position is the same to the bit.
  std::vector<std::uint32_t> vertexOf;
  /// By triangle: the triangle of the source that it is or is a part of; kNone in a filled hole. A corner
  /// that is no corner of that triangle lies on one of its sides.
  std::vector<std::uint32_t> triangleOf;
  RepairCounts counts;
  /// Borders of at most RepairOptions::mostHoleEdges edges that stay open: each filling would have an edge or
  /// a triangle that exists, lie upon the surface or cross it, or its sides turn against each other.
  std::uint64_t openHoles = 0;
  /// Closed parts that cross each other, so that none is a cavity of the other: they are turned together, as
  /// the largest needs it.
  std::uint64_t crossingParts = 0;
  MeshDiagnosis diagnosis;  ///< of the result, without self-intersections
};

/// Mends a mesh. No vertex moves. In this order: duplicate and degenerate triangles are left out, so that
/// nothing opens that was closed; border edges with a vertex inside them are split there; triangles are
/// turned so that neighbours agree: closed parts outwards, those in an odd number of others inwards, and of
/// parts with a border the fewer triangles; edges of more than two triangles are split if asked for; small
/// holes are filled if asked for; the further fans of a vertex get copies of it. Sheets with two sides, parts
/// that touch and self-intersections stay as they are. Mending twice changes nothing more.
///
/// O(n log n), and O(n^3) for a border of n <= 32 edges that is hard to fill. Errors: as diagnose();
/// invalidData: a part too few or too many.
Result<RepairedMesh> repair(const TriangleMesh& mesh, const RepairOptions& options = {},
                            const RunContext& context = {});

}  // namespace arete
