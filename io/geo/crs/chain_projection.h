// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// How chains of straight edges are brought from one plan into another.
struct ChainProjection {
  using Map = std::function<std::optional<Vec2>(Vec2)>;

  Map forward;      ///< nothing outside its domain
  Map back;         ///< the inverse; needed only where `turn` is not 0
  double turn = 0;  ///< x of the target is known up to multiples of this (turnOf()); 0: it is known
  double pole = 0;  ///< y of the north pole in the target, -y of the south pole; used only with a turn
  /// An edge is split until its quarters are within this part of its length from its image, or within
  /// `deviation`, a length in the unit of the source, whichever is less.
  double bend = 1e-4;
  double deviation = std::numeric_limits<double>::infinity();
};

/// Projects an open chain. With a turn x is continuous along the result, so that it may leave -180..180.
/// O(vertices of the result).
/// @return nothing if a vertex is outside the domain, or an edge is torn apart by a seam of the target.
std::optional<std::vector<Vec2>> projectLine(const std::vector<Vec2>& line,
                                             const ChainProjection& projection);

/// Projects a ring, which its last and first vertex close. A ring around a pole, which does not close in a
/// plan of longitudes, is led over the pole.
std::optional<std::vector<Vec2>> projectRing(const std::vector<Vec2>& ring,
                                             const ChainProjection& projection);

}  // namespace arete
