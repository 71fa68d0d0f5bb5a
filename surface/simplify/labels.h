// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/memory/chunked_array.h"
#include "surface/model/parts.h"

namespace arete {

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
