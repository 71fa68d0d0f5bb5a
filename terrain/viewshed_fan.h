// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/result.h"
#include "engine/run_context.h"
#include "terrain/sight_earth.h"

namespace arete {

/// The fan of geodesics from one place, as a plan of its own: at the distance s in the azimuth a, the place
/// (x, y) with (s sin a, s cos a) = x * steps.x + y * steps.y (an azimuthal equidistant map). Around the
/// observer its steps are those of the model's plan, farther away all but; geodesics from the observer are
/// straight in it, and tracks within planError of that.
///
/// Geodesics are asked for at places 32 samples apart and in between to check: the map is interpolated, by
/// parabolas in both directions, and four times the worst of the checks is in the errors.
class ViewshedFan {
 public:
  /// The fan over a raster of that size; where there is none, says why not. O(samples / 700) geodesics.
  static tl::expected<ViewshedFan, std::string> make(const SightEarth& earth, Vec2 observer,
                                                     std::uint32_t columns, std::uint32_t rows,
                                                     const RunContext& context);

  SightEarth::PlaneSteps steps;
  double planError = 0;    ///< steps, all in all: how far tracks and edges are from straight lines in the fan
  double heightError = 0;  ///< metres: of what the Earth's curvature does along a line
  double turn = 0;         ///< the most that a direction differs from that in the model's plan, radians

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
  int blocksAcross_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace arete
