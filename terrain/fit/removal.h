// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/fit/mesh.h"
#include "terrain/fit/patch.h"

namespace arete {

/// Whether a node can be removed from the cut, and by which changes of heights.
struct RemovalTrial {
  NodeId node;
  bool isFeasible = false;
  std::vector<FitMesh::FloorTriangle>
      floor;  ///< the first floorSize are in use; the rest keep their capacity
  std::size_t floorSize = 0;
  std::vector<std::uint32_t> moved;  ///< vertices to be raised, by `rise`
  std::vector<double> rise;
  std::vector<std::uint32_t> read;  ///< every vertex whose height or star the result depends on; apex first
};

/// Builds and solves patches of a mesh: the vertices that may be raised, and the samples that depend on them.
/// Keeps temporary arrays, so each thread needs its own.
class FitPatches {
 public:
  explicit FitPatches(const FitMesh& mesh) : mesh_(mesh) {}

  /// Tries to remove a leaf, without changing the mesh. The vertices of its link may be raised or lowered,
  /// and if that is not enough, those of up to `rings` - 1 more rings. O(samples under the patch * rounds).
  void tryRemoval(NodeId leaf, std::uint32_t rings, RemovalTrial& trial);

  /// Tries to bring the samples of a triangle within their bounds, by raising its corners and the vertices of
  /// up to `rings` rings around them, without increasing the violation of any other sample.
  /// @return whether moved() and rises() give a solution
  bool tryTriangle(std::uint32_t slot, std::uint32_t rings);

  const std::vector<std::uint32_t>& moved() const { return unknowns_; }
  std::span<const double> rises() const { return patch_.values(); }
  /// The triangles of the last patch.
  const std::vector<std::uint32_t>& slots() const { return slots_; }

 private:
  void begin();
  /// Whether a result of FitMesh::indexOf() is a vertex that is in the mesh.
  bool isInMesh(std::uint32_t vertex) const;
  /// Whether corners are in the mesh and counter-clockwise: in a damaged model a floor may be anything.
  bool isTriangle(const FitMesh::Corners& corners) const;
  void addUnknown(std::uint32_t vertex);
  /// Adds the next ring: the neighbours, but for `without`, of the vertices added last.
  void grow(std::uint32_t without);
  void collectSlots();
  /// Adds rows for the samples of a triangle.
  /// @param spares  a sample beyond its bound gets its present violation as the bound
  /// @return false where a sample that does not depend on the unknowns is beyond its bound
  template <class Samples>
  bool addRows(const FitMesh::Corners& corners, const Samples& samples, bool spares = false);

  const FitMesh& mesh_;
  FitPatch patch_;
  std::vector<std::uint32_t> unknowns_, slots_;
  std::size_t ringBegin_ = 0;
  // A vertex or triangle belongs to the current patch where its stamp is now_.
  std::uint32_t now_ = 0;
  std::vector<std::uint32_t> vertexStamp_, unknownOf_, slotStamp_;
};

}  // namespace arete
