// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "surface/model/attribute_error.h"
#include "surface/model/displacement.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// How a surface is built.
struct SurfaceBuildOptions {
  /// Border vertices stay in every cut, so that neighbouring parts meet to the bit.
  bool keepsBorders = false;
  /// Of a vertex that is removed: at most kMaxHoleCorners - 1.
  std::uint32_t maxDegree = 24;
  /// Growth of the threshold from level to level: > 1. Smaller steps make smaller cuts and take longer.
  double thresholdRatio = 1.1;

  /// Attributes of vertices and corners count: they are bounded (SurfaceModel::attributeErrors), and what
  /// changes them least goes first.
  bool boundsAttributes = false;

  /// Edges whose faces are turned by more than this, 0..180 degrees (isCrease()), are lines of every cut, as
  /// seams are; nullopt: a crease counts by its shape alone.
  std::optional<double> creaseAngleDegrees = {};

  bool operator==(const SurfaceBuildOptions&) const = default;
};

/// What a build leaves as it is or changes before it begins; nothing of it moves the surface.
struct SurfaceRepairs {
  std::uint64_t duplicateFaces = 0, degenerateFaces = 0;  ///< left out
  /// How often a face was split at a vertex inside its side, where one without area was beyond it: each time
  /// there is one more. Those that were left out again count as degenerate.
  std::uint64_t splitFaces = 0;
  std::uint64_t joinedVertices = 0;  ///< at one position, where a face without area was between them
  std::uint64_t turnedFaces = 0;
  std::uint64_t addedVertices = 0;   ///< one for each further fan of a vertex
  std::uint64_t unusedVertices = 0;  ///< left out
  /// Normals of corners that differ at most edges are those of flat faces: they are left out.
  bool dropsFlatNormals = false;

  bool operator==(const SurfaceRepairs&) const = default;
};

/// The result of the build of a surface and the content of its .amt file.
///
/// The error of a triangle is the largest distance of the part of the source that it stands for; so the
/// largest one of a cut bounds the distance from any point of the source to the cut, and that to the same
/// part and chart of it (boundsLines). The root mean square of these distances is the column kRms.
struct SurfaceModel {
  MultiTriangulation mt;

  /// What the source says of its parts. Vertex attributes are by vertex of the MT, those of wedges by wedge,
  /// those of triangles by face of the source, as objectOf, groupOf, materialOf and faceOf are. `wedges` is
  /// empty: see wedgesOf.
  MeshAttributes attributes;
  std::vector<std::uint32_t> vertexOf;  ///< by vertex of the MT: the vertex of the source
  std::vector<std::uint32_t> faceOf;    ///< by triangle of the MT: a face of the source that it stands for
  /// A face of the source that the build left out, and a face of the finest front in which it lies.
  struct LeftOutFace {
    std::uint32_t face = 0, in = 0;
    bool operator==(const LeftOutFace&) const = default;
  };
  std::vector<LeftOutFace>
      leftOutFaces;  ///< by rising face; those that touch no other face are not among them
  /// Whether coarse triangles have faces of their own, as where parts or attributes differ from face to face;
  /// otherwise inheritFaces() finds them.
  bool hasFaceAttributes() const {
    return !attributes.triangleAttributes.empty() || !attributes.objectOf.empty() ||
           !attributes.groupOf.empty() || !attributes.materialOf.empty();
  }
  /// Of a part of a model (loadSurfaceAmt()) in which faces have values: by face, as faceOf and all lists by
  /// face count them, its number in the source, rising. Empty: the numbers of the source.
  std::vector<std::uint32_t> partFaces;
  /// Known of a part: the triangles of the whole model's finest front.
  std::optional<std::uint64_t> finestOfWhole;
  /// As many as lists by face have.
  std::uint64_t faceCount() const { return partFaces.empty() ? sourceFaces : partFaces.size(); }
  std::uint64_t finestTriangles() const { return finestOfWhole.value_or(mt.finestTriangleCount()); }

  /// By triangle of the MT: the wedges of its corners. Empty without wedges.
  std::vector<std::array<std::uint32_t, 3>> wedgesOf;

  /// Of attributes of vertices and wedges, where the build has bounded them.
  std::vector<AttributeErrors> attributeErrors;
  /// Of their levels from 1 on: rising, positive.
  std::vector<double> attributeDistances;

  /// Where coarse cuts are drawn; empty: where the source's vertices are.
  SurfaceDisplacement displacement;

  /// Whether errors are distances to the same part and chart (surface/model/parts.h). Not so where there are
  /// no lines, nor in models that earlier versions built, whose errors are distances to anything.
  bool boundsLines = false;

  std::uint64_t sourceVertices = 0, sourceFaces = 0;
  std::uint64_t fileFaces = 0;  ///< as the file counts them, which may have more corners than three
  /// The largest distance by which rounding has moved a vertex of the source; every error includes it twice.
  double positionError = 0;
  double diagonal = 0;  ///< of the box of the vertices that faces use
  SurfaceRepairs mending;
  SurfaceBuildOptions options;
  std::uint32_t levels = 0;
  std::uint64_t creaseEdges = 0;  ///< of the source that are lines: SurfaceBuildOptions::creaseAngleDegrees

  std::string source, sourceChecksum;
  std::string crsWkt, verticalUnit;
  std::string up;  ///< "y", "z", or empty: not known

  bool hasWedges() const { return !wedgesOf.empty(); }
  /// Whether it may have lines: seams, or edges between objects, materials or labels.
  bool mayHaveLines() const;
  /// Checks the sizes of all arrays and every index beside the MT's. Errors: invalidData. O(size).
  Status validate() const;
};

/// The errors that a curve of triangles against error has where none are stated: round shares of the diagonal
/// below the error of the root, rising.
std::vector<double> sharesOfDiagonal(const SurfaceModel& model);

}  // namespace arete
