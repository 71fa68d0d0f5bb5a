// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete {

/// A point of a triangle or of an edge: its corners and their shares, which sum to 1. Of an edge the third
/// share is 0.
struct FrontPoint {
  std::uint32_t element = 0;  ///< the triangle, or the edge
  std::array<double, 3> shares{};
};

/// Answers for points which point of a set of triangles or of edges is nearest. Thread-safe: it is only read.
class NearestOnFront {
 public:
  /// Of triangles, those without area left out. O(n log n)
  NearestOnFront(std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles);
  /// Of edges, those without length left out.
  NearestOnFront(std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 2>> edges);
  ~NearestOnFront();
  NearestOnFront(const NearestOnFront&) = delete;
  NearestOnFront& operator=(const NearestOnFront&) = delete;

  bool isEmpty() const;
  /// Precondition: not empty. O(log n)
  FrontPoint nearest(const Vec3& p) const;

 private:
  struct Triangles;
  struct Edges;
  std::unique_ptr<Triangles> triangles_;
  std::unique_ptr<Edges> edges_;
};

}  // namespace arete
