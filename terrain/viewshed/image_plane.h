// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "terrain/viewshed/azimuthal_map.h"
#include "terrain/viewshed/methods.h"

namespace arete {

/// One of four quarters of the plan. Its axis x points away from the observer, its axis y sideways. Both
/// axes run with the lattice numbers or both against them, so the diagonals of cells run from (x, y) to
/// (x + 1, y + 1) in every sector.
struct ViewshedSector {
  bool isAlongRows;  ///< x counts columns; else rows
  int sign;          ///< 1: with the lattice numbers; -1: against them

  /// @return the lattice number of an x or a y.
  int line(int x) const { return sign * x; }
  /// Converts a point or vector of the plan to (x, y). Applied again, it converts back.
  Vec2 turned(Vec2 p) const {
    return isAlongRows ? Vec2{sign * p.x, sign * p.y} : Vec2{sign * p.y, sign * p.x};
  }
};

/// Samples of one lattice line (of constant x) in the image plane. Arrays have one entry per sample.
struct ImageLine {
  int from = 0, count = 0;  ///< y of the first sample; number of samples
  double x = 0;             ///< steps from the observer to the line
  bool hasGaps = false;     ///< some height is NaN
  std::vector<double> z;    ///< heights; NaN = NODATA
  std::vector<double> u;    ///< horizontal image coordinate, which gives the direction
  std::vector<double> v;    ///< vertical image coordinate of the terrain, drawn as high as it may be
  std::vector<int> bin;     ///< ViewshedHorizon::bin(u)
  // Filled only if the plan is mapped (see ImagePlane); else empty.
  std::vector<double> uncertainty;            ///< metres by which the terrain may be lower than drawn
  std::vector<char> isBesideGap;              ///< one of the eight neighbours is missing
  std::vector<double> mapX, mapY, twiceDrop;  ///< AzimuthalMap::along()
  std::vector<double> away;                   ///< distance from the observer along the sector's x, in the map

  bool has(int y) const { return y >= from && y < from + count; }
  std::size_t at(int y) const { return static_cast<std::size_t>(y - from); }
};

/// The perspective image plane of one observer. Terrain at (x, y) from the observer, in the axes of a sector,
/// and h above the observer has the image coordinates
///
///     u = y / x,  v = h / x
///
/// so all points on a line of sight share one image point, and nearer terrain hides farther terrain of lower
/// v. Straight edges of the terrain are straight in the image.
///
/// On a plane Earth, h is in the DEM's unit and (x, y) is the plan. Over an ellipsoid the plan is *mapped*:
/// (x, y) are the coordinates of an AzimuthalMap, and h, in metres, is the height that would be seen at the
/// same elevation angle if the Earth did not curve.
///
/// Terrain is drawn too high rather than too low: by its rounding error and, if the plan is mapped, by how
/// much the terrain may rise within the map's errors.
class ImagePlane {
 public:
  /// @param map of this observer; null if the Earth is a plane.
  /// @param steepness viewshedSteepness() of the grid; used with a map only.
  ImagePlane(const ViewshedTask& task, const AzimuthalMap* map, const std::vector<float>* steepness);

  bool isMapped() const { return map_ != nullptr; }
  const ViewshedTask& task() const { return task_; }
  Vec2 observer(const ViewshedSector& sector) const { return sector.turned(task_.observer.plan); }

  /// Draws the samples `low` to `high` of lattice line x: sets all fields of `line` except `bin`.
  /// Precondition: the samples exist.
  /// @param shear 0 or 1: y is measured from shear * x, so u is less by `shear`; 0 for a mapped plan.
  void draw(const ViewshedSector& sector, int x, int low, int high, int shear, ImageLine& line) const;

  /// One sample that may be beside or behind the observer.
  struct Sample {
    Vec2 place;                  ///< steps from the observer
    double height, uncertainty;  ///< height above the observer as drawn; how much lower the terrain may be
    bool isBesideGap;
  };
  Sample sample(const ViewshedSector& sector, int x, int y) const;
  /// @return u of a lattice point that may be one sample outside of the raster.
  double direction(const ViewshedSector& sector, int x, int y, int shear) const;

  /// @return v of a target at the height `above` over the sample, without the margin added to terrain.
  double target(const ImageLine& line, std::size_t i, double above) const;
  /// @return how much lower in v the terrain on an edge may be than it is drawn: twice the tolerance of a
  ///     sight line, and the uncertainty. `x` is the least distance of the edge.
  double slack(double x, double uncertainty) const { return (slack_ + uncertainty) / x; }
  /// @return metres east and north of the observer.
  Vec2 ground(const ViewshedSector& sector, const ImageLine& line, std::size_t i) const;
  /// @return the length of one unit of h, in metres.
  double unit() const { return map_ != nullptr ? 1 : unit_; }

  /// @return a bound of how far u is from its value in the model's plan. Where |u| <= 1, turning a direction
  ///     by w changes u by at most (1 + u^2) w <= 2 w, to first order; kTurnOrder covers the rest.
  double turn() const {
    constexpr double kTurnOrder = 1.1;
    return map_ != nullptr ? 2 * kTurnOrder * map_->turn : 0;
  }
  /// @return the uncertainty in u of the shadow of a gap's corner at the distance x, from rounding and from
  ///     the errors of the map. A place (x, y) with |y| <= x is at most 1.5 x steps away; an error of e steps
  ///     changes u by at most sqrt(2) e / x.
  double corner(double x) const {
    constexpr double kRounding = 1e-8, kFarthest = 1.5, kPerStep = 2;
    return kRounding / std::min(x, 1.0) +
           (map_ != nullptr ? kPerStep * map_->planError(kFarthest * x) / x : 0);
  }
  /// @return AzimuthalMap::planError(); 0 for a plane.
  double planError(double distance) const { return map_ != nullptr ? map_->planError(distance) : 0; }
  /// @return a bound, in radians, of how far lines within two steps of the observer turn from straight ones.
  ///     An error of e steps at the distance s is e / s radians; the factor covers s >= 1 / 10. Tests, not a
  ///     proof, show that errors nearer than that do not matter.
  double directionError() const {
    constexpr double kNear = 2, kPerNearestStep = 10;
    return map_ != nullptr ? kPerNearestStep * map_->planError(kNear) : 0;
  }
  /// @return metres east and north of a step of x, of y.
  Vec2 xStep(const ViewshedSector& sector) const;
  Vec2 yStep(const ViewshedSector& sector) const;

 private:
  /// What the curvature of the Earth does to heights at one place.
  struct Curved {
    double scale, drop, curvature, distance;
  };
  Curved curved(double x, double y, double twiceDrop) const;
  double elevated(const Curved& curved, double z) const {
    const double h = z * unit_;
    return curved.scale * ((h - h0_ * unit_) / (1 + curved.curvature * h)) - curved.drop;
  }
  double uncertainty(double x, double y, const Curved& curved, double z, float steepness) const;
  std::size_t index(const ViewshedSector& sector, int x, int y) const;

  const ViewshedTask& task_;
  const AzimuthalMap* map_;
  const std::vector<float>* steepness_;
  SightEarth::PlaneSteps steps_;
  double unit_, h0_;  ///< metres per vertical unit of the DEM; the observer's height in that unit
  double lift_ = 0;   ///< by how much all terrain is drawn higher, against rounding
  double slack_ = 0;  ///< two tolerances of the longest line and all rounding
};

/// @return for each sample, in the DEM's unit, the most that the surface rises in one step within the 4 x 4
///     cells around it. The sign bit is set if one of the eight neighbours is missing or the sample is at the
///     border. O(samples), parallel.
std::vector<float> viewshedSteepness(const SightGrid& grid, const RunContext& context);

}  // namespace arete
