// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// By triangle: equal numbers for the same object, the same material and the same labels (attributes of
/// triangles that are not continuous). Empty: all are alike. A group is no part: it says nothing about looks.
/// O(n log n).
/// @param faceOf by triangle: its number in `attributes`
std::vector<std::uint32_t> partsOf(const MeshAttributes& attributes, std::span<const std::uint32_t> faceOf);
/// The same of all triangles that the attributes are of.
std::vector<std::uint32_t> partsOf(const MeshAttributes& attributes, std::size_t triangles);

/// What a triangle has beside its vertices.
struct TriangleLabels {
  std::uint32_t face = 0;                 ///< of the original, whose part and attributes it has
  std::array<std::uint32_t, 3> wedges{};  ///< of its corners; zeros without wedges
  bool operator==(const TriangleLabels&) const = default;
};

/// What the lines of a surface are between: edges between triangles of different parts, and seams, where the
/// wedges at an edge differ. What lines enclose is a chart.
struct SurfaceParts {
  bool hasWedges = false;
  /// By face of the original (partsOf()). Empty: all are alike.
  std::span<const std::uint32_t> partOf = {};

  bool hasLines() const { return hasWedges || !partOf.empty(); }
  bool areAlike(const TriangleLabels& a, const TriangleLabels& b) const {
    return partOf.empty() || partOf[a.face] == partOf[b.face];
  }
};

/// The line through the middle of a star, which divides its triangles, and those that fill its hole, into two
/// sides.
struct StarLine {
  /// The corners of the link to which it leads, rising; -1: there is none.
  std::array<int, 2> ends{-1, -1};
  /// A line that ends or branches in the middle does not pass, nor does one that meets a border.
  bool passes = true;

  bool isThere() const { return ends[0] >= 0; }
  /// 0 or 1; 0 without a line.
  int sideOfStar(int triangle) const { return triangle >= ends[0] && triangle < ends[1] ? 1 : 0; }
  /// Of a triangle between three corners of the link, which does not lie across the line.
  template <class Corner>
  int sideOf(const std::array<Corner, 3>& corners) const {
    for (const int c : corners)
      if (c != ends[0] && c != ends[1]) return c > ends[0] && c < ends[1] ? 1 : 0;
    return 0;
  }
};

/// @param triangles of the star, in order: triangle i lies between the corners i and i + 1 of the link
/// @param labelsAt  of triangle i, the middle of the star first
template <class LabelsAt>
StarLine lineThrough(const SurfaceParts& parts, int triangles, bool isOpen, const LabelsAt& labelsAt) {
  StarLine line;
  int count = 0;
  const TriangleLabels first = labelsAt(0);
  TriangleLabels before = first;
  const int spokes = isOpen ? triangles - 1 : triangles;
  for (int s = 0; s < spokes; ++s) {
    const bool isLast = s + 1 == triangles;
    const TriangleLabels after = isLast ? first : labelsAt(s + 1);
    if (!parts.areAlike(before, after) || before.wedges[0] != after.wedges[0] ||
        before.wedges[2] != after.wedges[1]) {
      if (count < 2) line.ends[static_cast<std::size_t>(count)] = isLast ? 0 : s + 1;
      ++count;
    }
    before = after;
  }
  if (count == 2 && line.ends[1] < line.ends[0]) std::swap(line.ends[0], line.ends[1]);
  line.passes = count == 0 || (count == 2 && !isOpen);
  if (count != 2) line.ends = {-1, -1};
  return line;
}

}  // namespace arete
