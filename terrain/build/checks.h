// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/build_options.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// Options in range, fixed vertices among the samples.
Status checkOptions(const BuildOptions& options, std::size_t sampleCount);

/// Whether a model that spans so much in metric space can be told: its spheres are floats. Errors:
/// invalidData.
Status checkSpan(const Vec3& span, const std::string& source);

/// A sentence for a raster without a single triangle.
std::string whyNoTriangle(const RasterHeightfield& heightfield);

/// What the arithmetic of a height between samples in [low, high] can be off by, where the weights of the
/// samples are known: 8 ulp of the largest magnitude.
double roundingSlack(double low, double high);

/// The same where an edge crosses a raster's lines: a place there is a column and a row with a fraction, and
/// the larger the number the fewer digits its fraction has. (Of planes see raster_error.cpp.)
double crossingSlack(double low, double high, std::uint32_t columns, std::uint32_t rows);

}  // namespace arete
