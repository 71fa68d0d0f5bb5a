// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge of sight lines: it knows samples, triangles and plane geometry, and no line of terrain/sight_*
// but the track it is given. Everything is computed in long double, triangle by triangle, with no bounds and
// nothing passed over that could matter.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/cut/cut.h"
#include "terrain/model/heightfield.h"
#include "terrain/sight/line.h"

namespace arete::test {

/// A straight line in the plane through the centre of an Earth of radius 1 / |curvature| and both its ends:
/// two position vectors and the chord between them. Metres. A negative curvature puts the ground on the inner
/// side of the sphere.
class OracleLine {
 public:
  OracleLine(long double curvature, long double length, long double height0, long double height1);

  long double height(long double s) const { return at(s).height; }
  struct HeightAndSlope {
    long double height, slope;
  };
  HeightAndSlope at(long double s) const;
  /// Where the slope is this; possibly beyond the ends. Precondition: curvature != 0.
  long double whereSlopeIs(long double slope) const;
  bool isStraight() const { return radius_ == 0; }
  /// The line's height is a convex function of the distance.
  bool isConvex() const { return sign_ > 0; }
  /// The tangent of the elevation angle at the first end, of the second end.
  long double tangentAtFirst() const;

 private:
  long double radius_ = 0, sign_ = 1, length_, height0_, height1_;
  long double r0_ = 0, r1_ = 0;  ///< from the centre to the ends
  long double chord_[2] = {}, along_[2] = {}, normal_[2] = {};
  long double fromCentre_ = 0, footAngle_ = 0;
};

/// What is true of a sight line.
struct OracleAnswer {
  /// The least clearance, in the DEM's unit, and where; none where the track passes no terrain.
  std::optional<long double> clearance;
  long double at = 0;
  /// The places where the line goes under the terrain by more than half of the tolerance and by more than one
  /// and a half: between `ceased`, where it is last above the terrain before the first, and `deep`, the first
  /// obstruction has to be.
  std::optional<long double> ceased, deep;
  /// No terrain below: parts longer than the shortest that counts.
  long double gapMetres = 0, longestGapInPlan = 0;
  std::optional<long double> firstGap;
};

class SightOracle {
 public:
  /// The triangles of a raster, by the rule of docs/topics/visibility.md: of four samples the upper left and
  /// the lower right are joined, of three there is one triangle.
  explicit SightOracle(const RasterHeightfield& raster);
  SightOracle(std::uint32_t columns, std::uint32_t rows, std::vector<double> heights);
  /// Those of a front, whatever it is of.
  SightOracle(const MultiTriangulation& mt, const Cut& front);

  struct Options {
    /// How far (in plan) beyond its border a triangle is taken to be: by default just enough for rounding to
    /// tear no holes. Asking again with more tells whether an answer hangs on it.
    long double reach = 1e-18L;
    /// Terrain that the track meets in nothing but a place, between its ends, counts.
    bool countsTouches = true;
    /// As reach, at both ends of the track.
    long double endReach = 0;
  };
  OracleAnswer ask(const SightTrack& track, double height0, double height1, double unitMetres,
                   const Options& options) const;
  OracleAnswer ask(const SightTrack& track, double height0, double height1, double unitMetres = 1) const {
    return ask(track, height0, height1, unitMetres, Options());
  }
  /// The surface at a place.
  std::optional<long double> heightAt(Vec2 plan, long double reach = 1e-18L) const;

 private:
  struct Corner {
    double x, y, z;
  };
  using Triangle = std::array<Corner, 3>;
  /// Terrain below a part of a piece.
  struct Stretch {
    long double s0, s1, z0, z1;
    long double u0, u1;  ///< plan units along the track
  };

  void cellTriangles(std::int64_t column, std::int64_t row, std::vector<Triangle>& to) const;
  /// Triangles that can be below the part of a piece from a to b.
  void candidates(Vec2 a, Vec2 b, std::vector<Triangle>& to) const;
  static std::optional<std::array<long double, 2>> clip(const Triangle& triangle, Vec2 a, Vec2 b,
                                                        long double reach);
  static void dropTouches(std::vector<Stretch>& stretches, long double length);
  static long double planeAt(const Triangle& triangle, long double x, long double y);

  std::uint32_t columns_ = 0, rows_ = 0;
  std::vector<double> heights_;
  std::vector<Triangle> triangles_;
};

}  // namespace arete::test
