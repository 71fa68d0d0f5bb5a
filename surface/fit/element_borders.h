// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// What attributes of vertices, or of wedges, belong to: by triangle, the elements at its corners.
std::vector<std::array<std::uint32_t, 3>> elementsOf(const SurfaceMesh& mesh, bool areWedges);

/// By element: its vertex; MeshAttributes::kNone: no triangle uses it. O(size).
std::vector<std::uint32_t> verticesOfElements(const SurfaceMesh& mesh,
                                              std::span<const std::array<std::uint32_t, 3>> elements,
                                              std::size_t count);

/// The lines on which the elements of a mesh end: borders, and one side of each seam.
class ElementBorders {
 public:
  /// O(n log n). @param positions by vertex; it and vertexOf must outlive it
  ElementBorders(std::span<const std::array<std::uint32_t, 3>> elements,
                 const std::vector<std::uint32_t>& vertexOf, const std::vector<Vec3>& positions);

  bool isOnBorder(std::uint32_t element) const { return neighbours_[element][0] != kNone; }
  /// Where a line passes, which it does not where it ends or branches.
  bool passes(std::uint32_t element) const { return isOnBorder(element) && degree_[element] == 2; }

  /// A place between two elements that follow each other on a line.
  struct Place {
    std::uint32_t first = 0, second = 0;
    double share = 0;  ///< of the second
  };
  /// The place of the line through an element that is nearest to p, not farther along the line than four
  /// times the distance from the element to p. The two sides of a seam have the same place. Precondition:
  /// passes().
  Place nearest(std::uint32_t element, const Vec3& p) const;

 private:
  static constexpr std::uint32_t kNone = MeshAttributes::kNone;
  const Vec3& at(std::uint32_t element) const { return positions_[vertexOf_[element]]; }

  const std::vector<std::uint32_t>& vertexOf_;
  const std::vector<Vec3>& positions_;
  std::vector<std::array<std::uint32_t, 2>> neighbours_;  ///< by element: on the border
  std::vector<std::uint32_t> degree_;
};

}  // namespace arete
