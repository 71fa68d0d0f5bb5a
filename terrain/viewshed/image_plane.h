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

/// One of four quarters of the plan, in which one of its axes, x, leads away from the observer, and the
/// other, y, across; both with their lattice numbers or both against, so that the diagonals of cells lead
/// from (x, y) to (x + 1, y + 1).
struct ViewshedSector {
  bool isAlongRows;  ///< x are columns; else rows
  int sign;          ///< 1: with the numbers; -1: against them

  int line(int x) const { return sign * x; }
  /// A place, or the way to one, of the plan as (x, y), and back.
  Vec2 turned(Vec2 p) const {
    return isAlongRows ? Vec2{sign * p.x, sign * p.y} : Vec2{sign * p.y, sign * p.x};
  }
};

/// Samples of a lattice line of x as an observer sees them.
struct PictureLine {
  int from = 0, count = 0;  ///< y of the first sample, and how many
  double x = 0;             ///< steps from the observer to the line
  bool hasGaps = false;
  std::vector<double> z;          ///< heights; NaN: none
  std::vector<double> u;          ///< directions
  std::vector<double> v;          ///< how high the terrain is, or could be, in the picture
  std::vector<double> doubt;      ///< of the fan: metres that the terrain may be lower; else empty
  std::vector<char> isBesideGap;  ///< of the fan: some of the eight samples around is none
  std::vector<double> fanX, fanY, bend, away;  ///< of the fan: AzimuthalMap::along(), and the distance in x
  std::vector<int> bin;

  bool has(int y) const { return y >= from && y < from + count; }
  std::size_t at(int y) const { return static_cast<std::size_t>(y - from); }
};

/// The picture plane of one observer. A thing in the direction u = y / x, from a sector's axes, stands in it
/// at v: its height above the observer over x, so that what is farther away on a line of sight has the same
/// v. On a plane Earth heights are in the DEM's unit. Over an ellipsoid they are metres, the place is that in
/// the fan of geodesics, and the height the one that, without any curvature, has the same elevation.
///
/// The terrain is drawn too high rather than too low: by what rounding may do, and on an ellipsoid by what it
/// rises within the error of the fan.
class ImagePlane {
 public:
  /// Preconditions: the fan, where there is one, is that of the observer; `steepness` goes with it.
  ImagePlane(const ViewshedTask& task, const AzimuthalMap* fan, const std::vector<float>* steepness);

  bool isFan() const { return fan_ != nullptr; }
  const ViewshedTask& task() const { return task_; }
  Vec2 observer(const ViewshedSector& sector) const { return sector.turned(task_.observer.plan); }

  /// Sets all of the line's samples from `low` to `high` but the bins. `shear`: u is less by this (never for
  /// a fan). Preconditions: the samples exist.
  void take(const ViewshedSector& sector, int x, int low, int high, int shear, PictureLine& line) const;
  /// One sample, which may be beside or behind the observer: its place in steps, its drawn height, its doubt.
  struct Sample {
    Vec2 place;
    double height, doubt;
    bool isBesideGap;
  };
  Sample sample(const ViewshedSector& sector, int x, int y) const;
  /// The direction of a place that may be one sample beside the raster.
  double direction(const ViewshedSector& sector, int x, int y, int shear) const;

  /// Where a target above a sample stands: not drawn too high.
  double target(const PictureLine& line, std::size_t i, double above) const;
  /// How much less high in the picture the terrain on an edge may be for the two tolerances and all doubt.
  double slack(double x, double doubt) const { return (slack_ + doubt) / x; }
  /// Metres east and north of the observer.
  Vec2 ground(const ViewshedSector& sector, const PictureLine& line, std::size_t i) const;
  /// Metres in a unit of height in the picture.
  double unit() const { return fan_ != nullptr ? 1 : unit_; }
  /// The most by which u differs from that in the plan, and how far from a gap's corner its shadow is sure,
  /// at a distance in x.
  double turn() const { return fan_ != nullptr ? 2.2 * fan_->turn : 0; }
  double corner(double x) const {
    return 1e-8 / std::min(x, 1.0) + (fan_ != nullptr ? 2 * fan_->planError(1.5 * x) / x : 0);
  }
  /// Steps: how far lines may be from straight ones, so many steps from the observer.
  double planError(double distance) const { return fan_ != nullptr ? fan_->planError(distance) : 0; }
  /// By what angle lines leave the observer in other directions of the plan, as far as two steps.
  double directionError() const { return fan_ != nullptr ? 10 * fan_->planError(2) : 0; }
  /// Metres that make a step of x, of y.
  Vec2 xStep(const ViewshedSector& sector) const;
  Vec2 yStep(const ViewshedSector& sector) const;

 private:
  struct Bent {
    double scale, drop, curvature, distance;
  };
  Bent bent(double x, double y, double bend) const;
  double elevated(const Bent& bent, double z) const {
    const double h = z * unit_;
    return bent.scale * ((h - h0_ * unit_) / (1 + bent.curvature * h)) - bent.drop;
  }
  double doubt(double x, double y, const Bent& bent, double z, float steepness) const;
  std::size_t index(const ViewshedSector& sector, int x, int y) const;

  const ViewshedTask& task_;
  const AzimuthalMap* fan_;
  const std::vector<float>* steepness_;
  SightEarth::PlaneSteps steps_;
  double unit_, h0_, lift_ = 0, slack_ = 0;
};

/// For each sample the most that the surface rises in a step, in any cell of the 4 x 4 around it, in the
/// DEM's unit. O(samples), parallel.
std::vector<float> viewshedSteepness(const SightGrid& grid, const RunContext& context);

}  // namespace arete
