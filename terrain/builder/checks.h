// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// Whether the extent of a model, in metres, is in the range of its spheres, which are floats. Errors:
/// invalidData.
Status checkSpan(const Vec3& span, const std::string& source);

/// Whether coordinates far from the origin still tell the samples of a raster apart: to a hundredth of a
/// pixel. Errors: invalidData.
Status checkPositions(const RasterHeightfield& heightfield);

/// A sentence for a raster without a single triangle.
std::string whyNoTriangle(const RasterHeightfield& heightfield);

/// A bound of the rounding error of a height that is interpolated between samples in [low, high] with known
/// weights: 8 ulp of the largest magnitude.
double roundingSlack(double low, double high);

/// The same where an edge crosses a raster's lines: the crossing is a fractional column or row, and the
/// larger the number the fewer digits its fraction has. (For planes see raster_error.cpp.)
double crossingSlack(double low, double high, std::uint32_t columns, std::uint32_t rows);

}  // namespace arete
