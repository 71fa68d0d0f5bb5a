// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/sight/earth.h"

namespace arete {

/// An azimuthal equidistant map ([Snyder1987], chapter 25) of a raster around one observer. A sample that is
/// s metres from the observer in the azimuth a has the map coordinates (x, y) with
///
///     (s sin a, s cos a) = x * steps.x + y * steps.y
///
/// so near the observer map coordinates are differences of the model's plan coordinates, and farther away
/// they deviate from these slowly. Geodesics from the observer are straight in the map. The tracks of sight
/// lines, which are geodesics cut into chords, are straight within planError().
///
/// The map is interpolated: exact geodesics to nodes 32 samples apart, a biquadratic patch over each three by
/// three of them. Exact geodesics between the nodes check the patches. The error bounds of this class are
/// multiples of the worst deviations that were found there. They are *tested*, not proved: nothing is known
/// of the geodesics that were not evaluated.
class AzimuthalMap {
 public:
  /// Maps a raster. Deterministic for any number of threads. O(samples / 700) geodesics.
  /// @param earth has geodesics: geodesicError() has a value.
  /// @param observer plan coordinates.
  /// @param columns,rows size of the raster.
  /// @return the map, or a sentence that says why the raster cannot be mapped: no geodesics, one that cannot
  ///     be computed, a DEM that is too large or too near a pole for the error bounds.
  static tl::expected<AzimuthalMap, std::string> make(const SightEarth& earth, Vec2 observer,
                                                      std::uint32_t columns, std::uint32_t rows,
                                                      const RunContext& context);

  SightEarth::PlaneSteps steps;  ///< metres east and north of one unit of x, of y
  double turn = 0;  ///< radians: bound of the angle between a direction in the map and in the model's plan

  /// @param distance steps from the observer.
  /// @return a bound in steps of how far tracks, and edges of the terrain, are from straight lines in the map
  ///     at that distance.
  double planError(double distance) const {
    const double error = leastPlanError_ + planErrorPerStep_ * distance;
    return error < mostPlanError_ ? error : mostPlanError_;
  }
  /// @param metres distance from the observer.
  /// @return a bound in metres of the error of the drop of the ground (by the Earth's curvature) along a line
  ///     at that distance.
  double heightError(double metres) const {
    const double error = dropErrorPerSquare_ * metres * metres;
    return heightError_ + (error < mostDropError_ ? error : mostDropError_);
  }

  double leastCurvature = 0, mostCurvature = 0;  ///< 1/m: the curvatures of all lines are between these
  /// @return 1/m: a bound of how much the curvatures of lines in one direction differ.
  double curvatureError() const { return dropErrorPerSquare_; }

  /// Maps `count` consecutive samples of a lattice line, which may reach one sample beyond the raster.
  /// @param isColumn the line is a column; else a row.
  /// @param line number of the column or row.
  /// @param from number of the first sample in it.
  /// @param x,y map coordinates, `count` of each.
  /// @param twiceDrop curvature times squared distance, in metres: to first order twice what the ground drops
  ///     below the horizontal of the observer.
  void along(bool isColumn, int line, int from, int count, double* x, double* y, double* twiceDrop) const;

 private:
  class Construction;

  struct Quantities {
    double x = 0, y = 0, twiceDrop = 0;
  };
  Quantities at(double column, double row) const;

  /// Coefficients c[3 j + i] of u^i v^j; u and v are -1 to 1 along the columns and rows of a patch.
  using Biquadratic = std::array<double, 9>;
  struct Patch {
    std::array<Biquadratic, 3> of;  ///< x, y, twiceDrop
  };
  double leastPlanError_ = 0, planErrorPerStep_ = 0, mostPlanError_ = 0;
  double heightError_ = 0, dropErrorPerSquare_ = 0, mostDropError_ = 0;
  int patchesAcross_ = 0;
  std::vector<Patch> patches_;
};

}  // namespace arete
