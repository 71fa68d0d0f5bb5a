// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"

namespace arete {

/// Lengths in plan below this are rounding: neither gaps nor crossings.
inline constexpr double kShortestInPlan = 1e-9;

/// A point of a track.
struct SightPoint {
  Vec2 plan;            ///< plan coordinates of the model: column, row of a raster
  double distance = 0;  ///< metres along the ground from the first point
};

/// What a sight line passes over: a chain of legs that are straight in plan, with distances linear along
/// each, and how the Earth curves below it. Made by a SightEarth (terrain/sight/earth.h).
struct SightTrack {
  /// At least two. Distances rise from 0, or are all 0 if both ends are in one place. They do not rise along
  /// a leg that only leads to the other side of the plan, at the seam of longitudes.
  std::vector<SightPoint> points;
  double curvature = 0;        ///< 1/m, of the effective Earth: (1 - K) / R; 0 = flat, negative = concave
  double groundCurvature = 0;  ///< 1/m, of the Earth itself: 1 / R; 0 = flat
  double azimuthDegrees = 0;   ///< at the first point, clockwise from north (from the map's +y when flat)
};

/// The straight line between two heights over a track, on an Earth of the effective radius. Radio engineers
/// use a larger Earth to straighten refracted rays [ItuTerms2019].
///
///     height(s) = [ h0 (sn S - sn s) + h1 (sn S - sn(S - s)) + k h0 h1 sn S
///                   - 4 k sn(S/2) sn(s/2) sn((S-s)/2) ]
///                 / [ (1 + k h0) sn s + (1 + k h1) sn(S - s) ],      sn(x) = sin(k x) / k
///
/// with everything in metres, k the curvature and S the length; for k = 0 it is the straight line. It is
/// stored as Taylor polynomials: of the height, or of height / (1 + k height) for a high line. They are
/// within 1e-7 m of it, and within 1e-14 of the height where that exceeds the Earth's radius. Where k >= 0
/// the height is convex in s.
class SightLine {
 public:
  /// Preconditions: checkSightHeights(); the length is below half a turn of the effective Earth.
  /// O(points + length / 60 km).
  /// @param fromHeight,toHeight of the ends, in the DEM's vertical unit.
  /// @param heightUnitMetres metres in that unit.
  SightLine(SightTrack track, double fromHeight, double toHeight, double heightUnitMetres = 1);

  const SightTrack& track() const { return track_; }
  std::span<const SightPoint> points() const { return track_.points; }
  double length() const { return length_; }  ///< metres along the ground
  /// @return the height in the DEM's vertical unit, s metres along. Precondition: 0 <= s <= length().
  double height(double s) const {
    const double at = polynomialAt(s).at(s);
    return isHigh_ ? at / (1 - bend_ * at) : at;
  }
  /// @return d height / ds.
  double slope(double s) const;
  /// @return an upper bound of the second derivative; 0 if the line is straight or concave.
  double sag() const { return sag_; }

  struct Least {
    double clearance = 0, distance = 0;
  };
  /// @return the least of height(s) - z(s) over [s0, s1], where z is linear from z0 to z1, and where it is.
  Least least(double s0, double z0, double s1, double z1) const;
  /// @return a lower bound of least().clearance, within sag() * (s1 - s0)^2 / 8 of it. O(1).
  double leastBound(double s0, double z0, double s1, double z1) const {
    if (isSteep_) return tangentBound(s0, z0, s1, z1);
    const double c0 = height(s0) - z0, c1 = height(s1) - z1, d = s1 - s0;
    return (c0 < c1 ? c0 : c1) - sag_ * d * d / 8;
  }

  /// @return clearances within this of 0 count as touching: 1e-6 m + 1e-12 of the length, in the DEM's
  ///     vertical unit.
  double tolerance() const { return tolerance_; }
  double heightUnitMetres() const { return unit_; }
  double fromHeight() const { return from_; }
  double toHeight() const { return to_; }

  /// @return the plan position at a distance. O(log points).
  Vec2 planAt(double s) const;

 private:
  /// Of the height; of a high line, of w = height / (1 + bend_ height).
  struct Polynomial {
    double middle = 0;
    std::array<double, 6> c = {};  ///< coefficients of the powers of s - middle
    double at(double s) const {
      const double x = s - middle;
      return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
    }
    double slope(double s) const {
      const double x = s - middle;
      return c[1] + x * (2 * c[2] + x * (3 * c[3] + x * (4 * c[4] + x * 5 * c[5])));
    }
  };

  const Polynomial& polynomialAt(double s) const {
    if (polynomials_.size() == 1) return polynomials_[0];
    const auto i = static_cast<std::size_t>(s * polynomialsPerMetre_);
    return polynomials_[i < polynomials_.size() ? i : polynomials_.size() - 1];
  }
  /// leastBound() by the tangents at both ends. The sag of a steep line is that of its upper end, and useless
  /// for the rest of it.
  double tangentBound(double s0, double z0, double s1, double z1) const;

  SightTrack track_;
  double length_, unit_, from_, to_, tolerance_;
  double sag_ = 0, polynomialsPerMetre_ = 0;
  double bend_ = 0;  ///< curvature per unit of height
  bool isHigh_ = false, isSteep_ = false;
  std::vector<Polynomial> polynomials_;
};

/// Checks the heights of a line's ends, in the DEM's vertical unit.
/// @return Errors: invalidData: a height is not finite or is more than half of the effective Earth's radius
///     deep, below the ground or, on a concave Earth, above it.
Status checkSightHeights(const SightTrack& track, double fromHeight, double toHeight,
                         double heightUnitMetres = 1);

/// @param height0 metres of the observer, above the first point of a track of that curvature.
/// @param distance metres along the ground, more than 0.
/// @param height metres of what is seen, above the ground there.
/// @return the tangent of the elevation angle. It rises with height: of two things in one direction, the one
///     of the larger tangent is seen above the other.
double sightTangent(double curvature, double height0, double distance, double height);

/// The inverse of sightTangent() in the height.
/// @return metres; infinite if a ray of that tangent never reaches that distance.
double sightHeight(double curvature, double height0, double distance, double tangent);

}  // namespace arete
