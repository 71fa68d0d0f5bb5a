// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "terrain/model/terrain_model.h"

namespace arete {

/// The highest minus the lowest height, in their unit: what an error in percent is a share of. NaN is NODATA.
/// @return 0 where there is no height
double reliefOf(std::span<const double> heights);

/// The same of all samples of a model, isolated ones too. Precondition: the model is whole, no part of a
/// file. O(samples).
double reliefOf(const TerrainModel& model);

}  // namespace arete
