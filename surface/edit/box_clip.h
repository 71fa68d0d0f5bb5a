// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "surface/edit/crop.h"

namespace arete {

/// Cuts triangles at the faces of a box.
class BoxClip {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// A vertex that a cut made: a weighted mean of vertices of the mesh, of those of an edge or of a triangle.
  struct Cut {
    Vec3 position;
    std::array<std::uint32_t, 3> vertices;
    std::array<double, 3> weights;
    bool isOnEdge;  ///< of the first two vertices
  };

  /// @param positions and @param box must outlive this.
  BoxClip(const std::vector<Vec3>& positions, const Box3& box) : positions_(positions), box_(box) {}

  /// The outline of the part of a triangle in the box, in the turn of the triangle: vertices of the mesh, and
  /// behind their numbers those of cuts(). Empty: it is outside or touches the box in a point or along a
  /// line.
  /// @param touches receives whether any point of the triangle is in the box.
  /// The result is valid until the next call.
  const std::vector<std::uint32_t>& clip(const Triangle& triangle, bool& touches);

  const std::vector<Cut>& cuts() const { return cuts_; }
  const Vec3& positionOf(std::uint32_t vertex) const {
    return vertex < positions_.size() ? positions_[vertex] : cuts_[vertex - positions_.size()].position;
  }

 private:
  /// A corner of the outline and the edge that begins there: one of the triangle's, 0 to 2, or 3 and the
  /// number of the face of the box in which it lies.
  struct Corner {
    std::uint32_t vertex;
    unsigned edge;
  };
  /// A point of a triangle and its weights.
  struct Place {
    Vec3 position;
    std::array<double, 3> weights;
  };

  bool isInside(std::uint32_t vertex, unsigned face) const;
  void clipAt(unsigned face, const Triangle& triangle);
  std::uint32_t cutAt(unsigned edge, unsigned face, const Triangle& triangle);
  std::uint32_t cutEdge(std::uint32_t a, std::uint32_t b, unsigned face);
  std::uint32_t cutWithin(const Triangle& triangle, unsigned first, unsigned second);
  Place placeOnEdge(const Triangle& triangle, unsigned edge, unsigned face) const;
  Vec3 heldInBox(Vec3 position, unsigned axes) const;
  std::uint32_t add(Cut cut);

  const std::vector<Vec3>& positions_;
  Box3 box_;
  std::vector<Cut> cuts_;
  std::unordered_map<std::uint64_t, std::array<std::uint32_t, 6>> cutsOfEdge_;  // by face
  std::vector<Corner> outline_, next_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace arete
