// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/mt/hole_limit.h"
#include "engine/simplify/floor_joins.h"
#include "engine/simplify/hole_triangles.h"
#include "surface/error/attribute_field.h"
#include "surface/error/floor_distance.h"
#include "surface/error/joint_distance.h"
#include "surface/error/original.h"
#include "surface/error/pieces.h"

namespace arete {

/// What rounding may add to the distance of a corner of a piece from a triangle.
/// @param cuts of the piece; 0 of a whole face
inline double roundingOf(const OriginalSurface& original, const SpaceTriangle& face, std::uint32_t cuts) {
  double rounding = original.largestCoordinate * 0x1p-49;
  if (cuts > 0)
    rounding += cuts / double(FacePoint::kOne) * (norm(face[1] - face[0]) + norm(face[2] - face[0]));
  return rounding;
}

/// Divides the pieces of a star among the triangles of the floor that replaces it, and bounds how far each
/// triangle is from its pieces. Where a line divides both, each side is divided by itself.
///
/// The distance to a triangle is a convex function, so its maximum over a piece, a convex polygon, is at a
/// corner. A piece that belongs to one triangle as a whole is bounded exactly by its corners. A piece that
/// lies across an edge of the floor is cut there, if keeping it whole would make the bound larger. Flat parts
/// stay exact, but for rounding.
class PieceDivision {
 public:
  explicit PieceDivision(const OriginalSurface& original) : PieceDivision(original, kNoAttributes) {}
  /// @param field attributes that count in what belongs to which triangle, where divide() knows the
  /// triangles'
  PieceDivision(const OriginalSurface& original, const AttributeField& field)
      : original_(original), field_(field), joint_(field) {}

  /// Starts with no pieces.
  void clear();
  /// Adds the pieces of a triangle of the star. Those of one face are joined where they fill their convex
  /// hull, which has no other corners than theirs; where they are very many, in any case.
  void add(const PieceList& pieces);
  /// Adds a whole face.
  void add(std::uint32_t face);
  /// Adds a piece of it.
  void add(std::uint32_t face, std::uint32_t cuts, std::span<const FacePoint> polygon);
  bool isEmpty() const { return parts_.empty(); }

  /// @param corners of the hole, and
  /// @param floor the triangles that fill it.
  void divide(std::span<const Vec3> corners, const HoleTriangulation& floor) {
    divide(corners, floor, (std::uint32_t{1} << floor.size) - 1);
  }
  /// @param members of the floor, a bit for each triangle: those that the pieces may belong to. They fill a
  ///        polygon. Precondition: not empty.
  /// @param drawn by triangle of the floor, the corners as the field has them. Empty: attributes do not
  /// count.
  void divide(std::span<const Vec3> corners, const HoleTriangulation& floor, std::uint32_t members,
              std::span<const std::array<std::uint32_t, 3>> drawn = {});

  /// Gives the pieces to the side between a and b of a triangle of the floor (Piece::across): they are within
  /// its bound of that. After divide() with the triangle as a member.
  void giveAcross(int f, std::uint8_t across, const Vec3& a, const Vec3& b);

  // After divide(), by triangle of the floor, until a later one has the triangle as a member:
  PieceList takePieces(int f) { return lists_[static_cast<std::size_t>(f)].finish(); }
  /// No point of its pieces is farther from the triangle: rounded outwards.
  double bound(int f) const { return bounds_[static_cast<std::size_t>(f)]; }
  /// The root of the mean over its pieces of the squared distance, about.
  double rms(int f) const {
    const Integral& i = integrals_[static_cast<std::size_t>(f)];
    return i.area > 0 ? std::sqrt(i.squared / i.area) : 0;
  }

 private:
  /// The triangle that a piece belongs to as a whole, and its largest squared distance.
  struct Whole {
    int lane = 0;  // in floor_
    double squared = 0;
  };
  struct Part {
    std::uint32_t face, cuts;
    std::uint32_t begin, end;  // in points_
    Whole whole;
  };
  /// A plane through a diagonal; on either side a further one, or -1.
  struct Cut {
    Vec3 point, normal;
    int below, above;
    std::size_t attributes;  ///< where attributes count: in ofPlanes_, a point's and the normal's
  };
  struct Integral {
    double squared = 0, area = 0;
  };
  struct Leaf {
    FacePolygon polygon;
    std::uint32_t cuts;
    Whole whole;
  };

  std::span<const FacePoint> polygonOf(const Part& part) const {
    return std::span(points_).subspan(part.begin, part.end - part.begin);
  }
  void joinParts();
  /// Makes the convex hull of pieces of one face. @return whether they fill it.
  bool join(std::span<const Part> some, Part& into);
  /// @param least receives a bound from below of what any division reaches; may be null.
  Whole bestWhole(std::uint32_t number, const SpaceTriangle& face, std::span<const FacePoint> polygon,
                  double* least);
  /// By lane, of a point of a face: where attributes count, with them.
  void squaresAt(std::uint32_t number, const FacePoint& p, const Vec3& place, FloorDistance::Squares& to);
  /// Of the corners of a polygon over a cut's plane: the least and the greatest of them and 0.
  std::pair<double, double> heightsOver(const Cut& plane, std::span<const FacePoint> polygon,
                                        std::uint32_t number, const SpaceTriangle& face,
                                        std::vector<double>& heights);
  /// The plane through a diagonal that is as far from the triangle above as from the one below, attributes
  /// counted.
  void countAttributes(Cut& cut, const HoleTriangulation& floor, std::span<const Vec3> corners,
                       const FloorJoins::Diagonal& diagonal, bool isForthBelow);
  /// Adds the cuts between some triangles to the tree. @return its root.
  int planCuts(const HoleTriangulation& floor, const FloorJoins& joins, std::span<const Vec3> corners,
               std::uint32_t members);
  void cutAlong(int node, std::size_t depth, std::uint32_t number, const SpaceTriangle& face,
                const FacePolygon& polygon, std::uint32_t cuts);
  void cutFurther(std::size_t at, std::uint32_t number, const SpaceTriangle& face, double enough,
                  std::uint32_t depth);
  void assign(std::uint32_t face, std::uint32_t cuts, std::span<const FacePoint> polygon,
              const SpaceTriangle& place, const Whole& whole);

  static const AttributeField kNoAttributes;
  const OriginalSurface& original_;
  const AttributeField& field_;
  JointDistance joint_;  ///< of the members; empty where attributes do not count
  std::span<const std::array<std::uint32_t, 3>> drawn_;
  std::vector<double> wanted_, ofPlanes_;
  std::vector<Part> parts_;
  FacePolygon points_, hull_;
  FloorDistance floor_;  // of the members
  /// By lane of floor_, the triangle; and by triangle, the lane.
  std::array<std::uint8_t, kMaxHoleCorners> triangleOf_{}, laneOf_{};
  std::vector<Cut> tree_;
  std::vector<Leaf> leaves_;
  std::size_t leafCount_ = 0;
  /// By depth in the tree of cuts, so that no cut allocates.
  struct Halves {
    FacePolygon below, above;
    std::vector<double> heights;
  };
  std::array<Halves, kMaxHoleCorners> halves_;
  std::array<PieceList::Builder, kMaxHoleCorners> lists_;
  std::array<double, kMaxHoleCorners> bounds_{};
  std::array<Integral, kMaxHoleCorners> integrals_{};
};

}  // namespace arete
