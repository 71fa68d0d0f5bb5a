// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "viewer/picture/map_view.h"

namespace arete {

/// A value for each pixel of a view.
struct ViewField {
  std::vector<float> values;    ///< row-major; NaN where coverage is 0
  std::vector<float> coverage;  ///< 0..1: the share of the pixel's surroundings that has data
};

/// Value of a grid sample; NaN = none.
using SampleAt = std::function<double(std::uint32_t column, std::uint32_t row)>;

/// Resamples a grid to the pixels of a view: if samples are denser than pixels, by a tent filter two pixels
/// wide over all samples; if they are sparser, by bilinear interpolation. Samples without data are left out.
///
/// @param sampleAt the value of a sample; NaN = none.
/// O(samples in view + pixels).
ViewField resample(std::uint32_t columns, std::uint32_t rows, const SampleAt& sampleAt, const MapView& view);

}  // namespace arete
