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

/// The fan of geodesics from one place, as a plan of its own: at the distance s in the azimuth a, the place
/// (x, y) with (s sin a, s cos a) = x * steps.x + y * steps.y (an azimuthal equidistant map). Around the
/// observer its steps are those of the model's plan, farther away all but; geodesics from the observer are
/// straight in it, and tracks all but.
///
/// Geodesics are asked for at places 32 samples apart and in between to check: the map is interpolated, by
/// parabolas in both directions, and four times the worst of the checks is in the errors.
class AzimuthalMap {
 public:
  /// The fan over a raster of that size; where there is none, says why not. O(samples / 700) geodesics.
  static tl::expected<AzimuthalMap, std::string> make(const SightEarth& earth, Vec2 observer,
                                                      std::uint32_t columns, std::uint32_t rows,
                                                      const RunContext& context);

  SightEarth::PlaneSteps steps;
  double turn = 0;  ///< the most that a direction differs from that in the model's plan, radians

  /// Steps: how far tracks and edges may be from straight lines in the fan, so many steps from the observer.
  double planError(double distance) const {
    const double error = leastPlanError_ + planErrorPerStep_ * distance;
    return error < mostPlanError_ ? error : mostPlanError_;
  }
  /// Metres: of what the Earth's curvature does along a line, so many metres from the observer.
  double heightError(double metres) const {
    const double bent = bentPerSquare_ * metres * metres;
    return heightError_ + (bent < mostBent_ ? bent : mostBent_);
  }

  /// 1/m: the curvatures of all lines are between these, those over one another this near to each other.
  double leastCurvature = 0, mostCurvature = 0;
  double curvatureError() const { return bentPerSquare_; }

  /// At samples of a column (isColumn) or a row, from the one numbered `from` on: their places in the fan, as
  /// steps from the observer, and the curvature times the squared distance, in metres. May reach one sample
  /// beyond the raster.
  void along(bool isColumn, int line, int from, int count, double* x, double* y, double* bend) const;

 private:
  struct Quantities {
    double x = 0, y = 0, bend = 0;
  };
  Quantities at(double column, double row) const;

  using Parabolas = std::array<double, 9>;  ///< of the powers of v, then of u, from -1 to 1 over a block
  struct Block {
    std::array<Parabolas, 3> of;  ///< x, y, bend
  };
  double leastPlanError_ = 0, planErrorPerStep_ = 0, mostPlanError_ = 0;
  double heightError_ = 0, bentPerSquare_ = 0, mostBent_ = 0;
  int blocksAcross_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace arete
