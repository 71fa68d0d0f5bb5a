// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "engine/result.h"
#include "terrain/build_options.h"
#include "terrain/heightfield.h"

namespace arete {

/// Options in range, fixed vertices among the samples.
Status checkOptions(const BuildOptions& options, std::size_t sampleCount);

/// A sentence for a raster without a single triangle.
std::string whyNoTriangle(const RasterHeightfield& heightfield);

/// What the arithmetic of a plane over heights in [low, high] can be off by: 8 ulp of the largest magnitude.
double roundingSlack(double low, double high);

}  // namespace arete
