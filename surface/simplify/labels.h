// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/memory/chunked_array.h"

namespace arete {

/// What a triangle has beside its vertices.
struct TriangleLabels {
  std::uint32_t face = 0;                 ///< of the original, whose part and attributes it has
  std::array<std::uint32_t, 3> wedges{};  ///< of its corners; zeros without wedges
  bool operator==(const TriangleLabels&) const = default;
};

/// The lines of a surface, which all its levels keep: edges between triangles of different parts, and seams,
/// where the wedges at an edge differ.
struct SurfaceParts {
  bool hasWedges = false;
  /// By face of the original: equal numbers for the same object and material. Empty: all are alike.
  std::span<const std::uint32_t> partOf = {};

  bool hasLines() const { return hasWedges || !partOf.empty(); }
  bool areAlike(const TriangleLabels& a, const TriangleLabels& b) const {
    return partOf.empty() || partOf[a.face] == partOf[b.face];
  }
};

/// Labels of many triangles. Without wedges only the faces take memory.
class LabelArray {
 public:
  explicit LabelArray(bool hasWedges) : hasWedges_(hasWedges) {}

  std::size_t size() const { return faces_.size(); }
  /// ChunkedArray::reserve().
  void reserve(std::size_t size) {
    faces_.reserve(size);
    if (hasWedges_) wedges_.reserve(size);
  }
  void resize(std::size_t size) {
    faces_.resize(size);
    if (hasWedges_) wedges_.resize(size);
  }
  TriangleLabels operator[](std::size_t i) const {
    return {faces_[i], hasWedges_ ? wedges_[i] : std::array<std::uint32_t, 3>{}};
  }
  void set(std::size_t i, const TriangleLabels& labels) {
    faces_[i] = labels.face;
    if (hasWedges_) wedges_[i] = labels.wedges;
  }

 private:
  bool hasWedges_;
  ChunkedArray<std::uint32_t> faces_;
  ChunkedArray<std::array<std::uint32_t, 3>> wedges_;
};

}  // namespace arete
