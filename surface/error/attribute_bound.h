// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/error/attribute_field.h"
#include "surface/error/original.h"
#include "surface/error/pieces.h"

namespace arete {

/// A side of a triangle on a line, and the drawn corners that the line's other side has at its ends.
struct AcrossSide {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::array<std::uint32_t, 2> vertices{kNone, kNone}, drawn{kNone, kNone};

  bool isOf(std::uint32_t a, std::uint32_t b) const {
    return (vertices[0] == a && vertices[1] == b) || (vertices[0] == b && vertices[1] == a);
  }
  std::uint32_t drawnAt(std::uint32_t vertex) const { return drawn[vertices[0] == vertex ? 0 : 1]; }
};

/// Bounds how far the attributes of a triangle are from what the pieces have that it stands for.
///
/// Every corner p of a piece gets a point q of the triangle within a distance of it, the triangle's error or
/// more: where in the triangle and that ball the attributes are most alike. A point x of the piece is a
/// mean of its corners, and the same mean y of their points lies in the triangle, for the triangle is convex.
/// Attributes are linear in the face and in the triangle. So |x - y| and the distances of attributes, which
/// are norms, are at most the largest at a corner. Two unit vectors whose means are at least r long and at
/// most d apart are within asin(d / r) of each other.
class AttributeBound {
 public:
  /// @param distances beside the triangles' errors, rising. Precondition: all outlive this.
  AttributeBound(const OriginalSurface& original, const AttributeField& field,
                 std::span<const double> distances = {})
      : original_(original), field_(field), distances_(distances) {}

  struct Triangle {
    SpaceTriangle places;
    std::array<std::uint32_t, 3> vertices{};  ///< of the original
    std::array<std::uint32_t, 3> drawn{};     ///< wedges, or the vertices
    double error = 0;
    std::span<const AcrossSide> across = {};  ///< of pieces that lie across a side; without wedges not needed
  };
  /// The largest distance of each attribute over the pieces: by level, the first within the error and the
  /// others within the larger of that and a distance, by entry of the field; infinite where none is known.
  /// O(corners of the pieces * levels).
  void bound(const Triangle& triangle, const PieceList& pieces, std::span<double> errors);

 private:
  /// @return whether a larger error may lower the distances.
  bool boundWithin(const Triangle& triangle, const PieceList& pieces, std::span<double> errors);
  void addPiece(const Triangle& triangle, const Piece& piece, std::span<double> errors);
  void addAcross(const Triangle& triangle, const Piece& piece, std::span<double> errors);
  /// The shares of the point for a corner of a piece at p.
  std::array<double, 3> partner(const Triangle& triangle, const Vec3& p, double within,
                                std::span<const double> wanted);
  double partnerOnSide(double middle, double room, std::span<const double> first,
                       std::span<const double> second, std::span<const double> wanted);
  void compare(std::size_t corners, std::span<double> errors);

  const OriginalSurface& original_;
  const AttributeField& field_;
  std::span<const double> distances_;
  bool isHeld_ = false;  // whether the error kept a point from where its attributes are most alike
  std::vector<double> ofPiece_, ofTriangle_;  // by corner of the piece, components() each
};

}  // namespace arete
