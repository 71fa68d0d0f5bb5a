// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "surface/model/surface_model.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What shares of a model are of: an error of "1%", a budget of "10%".
struct Wholes {
  double length = 0;            ///< the relief of terrain, the diagonal of a surface; in the unit of errors
  std::uint64_t triangles = 0;  ///< of the finest triangulation
};

/// O(samples). Precondition: the model is whole.
Wholes wholesOf(const TerrainModel& model);
/// O(1).
Wholes wholesOf(const SurfaceModel& model);

}  // namespace arete
