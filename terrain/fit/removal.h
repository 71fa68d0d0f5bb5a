// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/fit/mesh.h"
#include "terrain/fit/patch.h"

namespace arete {

/// Whether a node can leave the cut, and what must move for it.
struct RemovalTrial {
  NodeId node;
  bool isFeasible = false;
  std::vector<FitMesh::FloorTriangle> floor;  ///< the first floorSize; the rest keep their memory
  std::size_t floorSize = 0;
  std::vector<std::uint32_t> moved;  ///< vertices, and by how much they rise
  std::vector<double> rise;
  std::vector<std::uint32_t> read;  ///< every vertex whose height or star the answer depends on
};

/// Works out patches of a mesh: which vertices may move, which samples they move. Keeps scratch space; one
/// for each thread.
class FitPatches {
 public:
  explicit FitPatches(const FitMesh& mesh) : mesh_(mesh) {}

  /// Tries a leaf against the mesh as it is. The vertices of its link may move; where that does not do, those
  /// of `rings` - 1 rings more. O(samples under the patch * rounds).
  void tryRemoval(NodeId leaf, std::uint32_t rings, RemovalTrial& trial);

  /// Tries to bring the samples of a triangle within their bounds, by moving its corners or the vertices of
  /// up to `rings` rings around them, and no other sample farther beyond its own. On success moved() and
  /// rises() say how.
  bool tryTriangle(std::uint32_t slot, std::uint32_t rings);

  const std::vector<std::uint32_t>& moved() const { return unknowns_; }
  std::span<const double> rises() const { return patch_.values(); }
  /// The triangles that the last patch looked at.
  const std::vector<std::uint32_t>& slots() const { return slots_; }

 private:
  void begin();
  void addUnknown(std::uint32_t vertex);
  /// Adds the vertices around those that were last to come.
  void grow(std::uint32_t without);
  void collectSlots();
  /// False when a sample that nothing moves is beyond its bound. `spares`: a sample that is beyond its bound
  /// must get no worse, and no better.
  template <class Samples>
  bool addRows(const FitMesh::Corners& corners, const Samples& samples, bool spares = false);

  const FitMesh& mesh_;
  FitPatch patch_;
  std::vector<std::uint32_t> unknowns_, slots_;
  std::size_t ringBegin_ = 0;
  // Stamps: what belongs to the patch at hand.
  std::uint32_t now_ = 0;
  std::vector<std::uint32_t> vertexStamp_, unknownOf_, slotStamp_;
};

}  // namespace arete
