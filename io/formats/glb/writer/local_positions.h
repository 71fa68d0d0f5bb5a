// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/formats/glb/writer/framed.h"

namespace arete {

/// Positions as 32-bit floats, and what is added to them.
struct LocalPositions {
  std::vector<Float3> positions;
  Vec3 translation;
  Vec3 rounding;  ///< per axis, the most by which a sum of the two differs from what it was
};

/// @param origin The translation, if floats alone do not hold the positions; by default, on the axes where
/// the positions are further from 0 than they are from each other, that of io/geo/crs/local_origin.h.
///
/// Errors: invalidData: a position beyond 32-bit floats. O(n).
Result<LocalPositions> localPositions(std::span<const Vec3> positions, const std::optional<Vec3>& origin);

}  // namespace arete
