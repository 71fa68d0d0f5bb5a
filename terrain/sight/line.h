// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"

namespace arete {

/// Lengths in plan below this are rounding: neither a gap nor a crossing.
inline constexpr double kShortestInPlan = 1e-9;

/// A place on the way of a sight line.
struct SightPoint {
  Vec2 plan;            ///< plan coordinates of the model: column, row of a raster
  double distance = 0;  ///< metres along the ground from the first
};

/// What a sight line passes over: a chain of pieces that are straight in plan, distances linear along each,
/// and how the Earth curves below it. Made by a SightEarth (terrain/sight/earth.h).
struct SightTrack {
  std::vector<SightPoint>
      points;            ///< at least two; distances rise, from 0, or are all 0 (both ends in one place)
  double curvature = 0;  ///< 1/m: (1 - K) / R, of the effective Earth; 0 = flat, negative bends away
  double groundCurvature = 0;  ///< 1/m: 1 / R of the Earth itself; 0 = flat
  double azimuthDegrees = 0;   ///< at the first point, clockwise from north (from the map's +y when flat)
};

/// The straight line, on an Earth of the effective radius, between two heights over a track: the sight line
/// of radio engineers, who straighten refracted rays by a larger Earth (ITU-R P.310).
///
///     height(s) = [ h0 (sn S - sn s) + h1 (sn S - sn(S - s)) + k h0 h1 sn S - 4 k sn(S/2) sn(s/2)
///     sn((S-s)/2) ]
///                 / [ (1 + k h0) sn s + (1 + k h1) sn(S - s) ],      sn(x) = sin(k x) / k
///
/// with everything in metres, k the curvature and S the length; for k = 0 the straight line. It is kept as
/// Taylor polynomials, of a high line those of height / (1 + k height), which are within 1e-7 m of it, and
/// within 1e-14 of where it is higher than the Earth's radius, whatever the heights of the ends. Where k >= 0
/// it is convex in s.
class SightLine {
 public:
  /// Heights in the DEM's vertical unit, of heightUnitMetres metres. Preconditions: finite; the length is
  /// below half a turn of the effective Earth; heights far above its centre. O(points + length / 60 km).
  SightLine(SightTrack track, double fromHeight, double toHeight, double heightUnitMetres = 1);

  const SightTrack& track() const { return track_; }
  std::span<const SightPoint> points() const { return track_.points; }
  double length() const { return length_; }  ///< metres along the ground
  /// In the DEM's vertical unit. Precondition: 0 <= s <= length().
  double height(double s) const {
    const double at = pieceAt(s).at(s);
    return isHigh_ ? at / (1 - bend_ * at) : at;
  }
  /// d height / ds.
  double slope(double s) const;
  /// An upper bound of the second derivative, 0 where the line is straight or concave.
  double sag() const { return sag_; }

  /// The least of height(s) - z(s) over [s0, s1], z running straight from z0 to z1, and where it is.
  struct Least {
    double clearance = 0, distance = 0;
  };
  Least least(double s0, double z0, double s1, double z1) const;
  /// At most that of least(), within sag() * (s1 - s0)^2 / 8 of it; without a search.
  double leastBound(double s0, double z0, double s1, double z1) const {
    if (isSteep_) return tangentBound(s0, z0, s1, z1);
    const double c0 = height(s0) - z0, c1 = height(s1) - z1, d = s1 - s0;
    return (c0 < c1 ? c0 : c1) - sag_ * d * d / 8;
  }

  /// What counts as touching: 1e-6 m and 1e-12 of the length, in the DEM's vertical unit.
  double tolerance() const { return tolerance_; }
  double heightUnitMetres() const { return unit_; }
  double fromHeight() const { return from_; }
  double toHeight() const { return to_; }

  /// The plan position at a distance. O(log points).
  Vec2 planAt(double s) const;

 private:
  /// Of the height; of a high line of w = height / (1 + bend height).
  struct Piece {
    double middle = 0;
    std::array<double, 6> c = {};  // of the powers of s - middle
    double at(double s) const {
      const double x = s - middle;
      return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
    }
    double slope(double s) const {
      const double x = s - middle;
      return c[1] + x * (2 * c[2] + x * (3 * c[3] + x * (4 * c[4] + x * 5 * c[5])));
    }
  };

  const Piece& pieceAt(double s) const {
    if (pieces_.size() == 1) return pieces_[0];
    const auto i = static_cast<std::size_t>(s * piecesPerMetre_);
    return pieces_[i < pieces_.size() ? i : pieces_.size() - 1];
  }
  /// leastBound() by the tangents at both ends: the sag of a steep line is that of its upper end, and says
  /// nothing of the rest.
  double tangentBound(double s0, double z0, double s1, double z1) const;

  SightTrack track_;
  double length_, unit_, from_, to_, tolerance_;
  double sag_ = 0, piecesPerMetre_ = 0;
  double bend_ = 0;  ///< the curvature, per unit of height
  bool isHigh_ = false, isSteep_ = false;
  std::vector<Piece> pieces_;
};

/// Whether there is a line between these heights, in the DEM's vertical unit, over that track. Errors:
/// invalidData for one that is not finite, halfway to the centre of the effective Earth or, where that bends
/// away from the ground, as high.
Status checkSightHeights(const SightTrack& track, double fromHeight, double toHeight,
                         double heightUnitMetres = 1);

/// The tangent of the elevation angle at which a place is seen from `height0` metres above the first point of
/// a track of that curvature: `height` metres above the ground `distance` metres away. It grows with height,
/// so of two things in one direction the one with the larger tangent is seen above the other. Precondition:
/// distance > 0.
double sightTangent(double curvature, double height0, double distance, double height);

/// The inverse of sightTangent(), in the height; infinite where the tangent never reaches that distance.
double sightHeight(double curvature, double height0, double distance, double tangent);

}  // namespace arete
