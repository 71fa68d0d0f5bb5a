// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/base/box3.h"
#include "surface/decimate/contraction_mesh.h"
#include "surface/topology/crossing.h"

namespace arete {

/// Finds whether a contraction would make the surface cross itself. Triangles are kept in grids, each in the
/// one whose cells are about as large as its box.
class CrossingGuard {
 public:
  explicit CrossingGuard(const ContractionMesh& mesh);

  /// Whether no triangle that a contraction moves would cross or touch another one that it did not before.
  bool keepsApart(std::span<const std::uint32_t> vertices, const Vec3& place) const;
  /// After the contraction: the triangles at a vertex lie elsewhere.
  void moved(std::uint32_t vertex);

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& c) const;
  };
  struct Grid {
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
    std::size_t entries = 0;
  };

  PlacedTriangle placed(std::uint32_t t) const;
  Box3 boxOf(std::uint32_t t) const;
  static int levelOf(const Box3& box);
  static Cell cellOf(const Vec3& p, int level);
  void add(std::uint32_t t);
  /// Calls visit(triangle) for those whose cells meet a box, some of them more than once. Visiting ends when
  /// it returns false.
  template <class Visit>
  bool forNear(const Box3& box, const Visit& visit) const;

  const ContractionMesh& mesh_;
  std::unordered_map<int, Grid> grids_;  ///< by level: cells are 2^level wide
};

}  // namespace arete
