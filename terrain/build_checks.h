// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/result.h"
#include "terrain/build_options.h"
#include "terrain/heightfield.h"

namespace arete {

/// Options in range, fixed vertices among the samples.
Status checkOptions(const BuildOptions& options, std::size_t sampleCount);

/// A sentence for a raster without a single triangle.
std::string whyNoTriangle(const RasterHeightfield& heightfield);

/// What the arithmetic of a height between samples in [low, high] can be off by, where the weights of the
/// samples are known: 8 ulp of the largest magnitude.
double roundingSlack(double low, double high);

/// The same where it stands between samples of a raster, which is told by a column and a row of that much:
/// such places have that much less of a fraction. Of planes that are known by their steps see
/// raster_error.cpp.
double roundingSlack(double low, double high, std::uint32_t columns, std::uint32_t rows);

}  // namespace arete
