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

/// One of four quarters of the plan. Its axis x leads away from the observer, its axis y across; both are
/// counted with the lattice numbers or both against them, so that the diagonals of cells lead from (x, y) to
/// (x + 1, y + 1) in every sector.
struct ViewshedSector {
  bool isAlongRows;  ///< x counts columns; else rows
  int sign;          ///< 1: with the lattice numbers; -1: against them

  /// @return the lattice number of an x or a y.
  int line(int x) const { return sign * x; }
  /// Turns a point or vector of the plan into (x, y), and back.
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
  std::vector<double> u;    ///< image coordinate across: direction
  std::vector<double> v;    ///< image coordinate up, of the terrain drawn as high as it can be
  std::vector<int> bin;     ///< ViewshedHorizon::bin(u)
  // Of a mapped plan only; else empty.
  std::vector<double> uncertainty;            ///< metres by which the terrain may be lower than drawn
  std::vector<char> isBesideGap;              ///< one of the eight samples around is missing
  std::vector<double> mapX, mapY, twiceDrop;  ///< AzimuthalMap::along()
  std::vector<double> away;                   ///< map distance in x

  bool has(int y) const { return y >= from && y < from + count; }
  std::size_t at(int y) const { return static_cast<std::size_t>(y - from); }
};

/// The perspective image plane of one observer. In the axes of a sector, terrain at (x, y) that is h above
/// the observer has the image coordinates
///
///     u = y / x,  v = h / x
///
/// so points on one line of sight have one image point, and what is nearer hides what is farther and lower in
/// v. Straight edges of the terrain are straight in the image.
///
/// On a plane Earth, h is in the DEM's unit and (x, y) is the plan. Over an ellipsoid the plan is *mapped*:
/// (x, y) are the coordinates of an AzimuthalMap, h is in metres, and it is the height that without any
/// curvature has the same elevation angle.
///
/// Terrain is drawn too high rather than too low: by its rounding error and, mapped, by what the terrain
/// rises within the errors of the map.
class ImagePlane {
 public:
  /// @param map the observer's; null where the Earth is a plane.
  /// @param steepness viewshedSteepness() of the grid; used with a map only.
  ImagePlane(const ViewshedTask& task, const AzimuthalMap* map, const std::vector<float>* steepness);

  bool isMapped() const { return map_ != nullptr; }
  const ViewshedTask& task() const { return task_; }
  Vec2 observer(const ViewshedSector& sector) const { return sector.turned(task_.observer.plan); }

  /// Draws the samples `low` to `high` of lattice line x: sets everything of `line` but the bins.
  /// Precondition: the samples exist.
  /// @param shear u is measured from shear * x: 0 or 1; 0 for a mapped plan.
  void draw(const ViewshedSector& sector, int x, int low, int high, int shear, ImageLine& line) const;

  /// One sample that may be beside or behind the observer.
  struct Sample {
    Vec2 place;                  ///< steps from the observer
    double height, uncertainty;  ///< drawn height above the observer; by how much the terrain may be lower
    bool isBesideGap;
  };
  Sample sample(const ViewshedSector& sector, int x, int y) const;
  /// @return u of a lattice point that may be one sample outside of the raster.
  double direction(const ViewshedSector& sector, int x, int y, int shear) const;

  /// @return v of a target `above` the sample, not drawn too high.
  double target(const ImageLine& line, std::size_t i, double above) const;
  /// @return how much lower in v the terrain on an edge may be than drawn: by both tolerances of a sight line
  ///     and the uncertainty. `x` is the least distance of the edge.
  double slack(double x, double uncertainty) const { return (slack_ + uncertainty) / x; }
  /// @return metres east and north of the observer.
  Vec2 ground(const ViewshedSector& sector, const ImageLine& line, std::size_t i) const;
  /// @return metres in a unit of h.
  double unit() const { return map_ != nullptr ? 1 : unit_; }

  /// @return a bound of the difference of u from that in the model's plan. Where |u| <= 1 a turn of the
  ///     direction by w changes u by at most (1 + u^2) w = 2 w, to first order; kTurnOrder covers the rest.
  double turn() const {
    constexpr double kTurnOrder = 1.1;
    return map_ != nullptr ? 2 * kTurnOrder * map_->turn : 0;
  }
  /// @return by how much in u the shadow of a gap's corner, at the distance x, is uncertain: rounding, and
  ///     errors of the map. A place (x, y) with |y| <= x is at most 1.5 x steps away; an error of e steps
  ///     changes u by at most sqrt(2) e / x.
  double corner(double x) const {
    constexpr double kRounding = 1e-8, kFarthest = 1.5, kPerStep = 2;
    return kRounding / std::min(x, 1.0) +
           (map_ != nullptr ? kPerStep * map_->planError(kFarthest * x) / x : 0);
  }
  /// @return AzimuthalMap::planError(); 0 for a plane.
  double planError(double distance) const { return map_ != nullptr ? map_->planError(distance) : 0; }
  /// @return radians: a bound of the angle between lines and straight ones within two steps of the observer.
  ///     An error of e steps at the distance s is e / s radians; the factor covers s >= 1 / 10. That what is
  ///     nearer does not matter is tested, not proved.
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
  double unit_, h0_;  ///< metres in the DEM's unit; the observer's height in it
  double lift_ = 0;   ///< by how much all terrain is drawn higher, against rounding
  double slack_ = 0;  ///< two tolerances of the longest line and all rounding
};

/// @return for each sample the most that the surface rises in a step, in any cell of the 4 x 4 around it, in
/// the
///     DEM's unit; the sign bit is set where one of the eight samples around is missing, or the sample is at
///     the border. O(samples), parallel.
std::vector<float> viewshedSteepness(const SightGrid& grid, const RunContext& context);

}  // namespace arete
