// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/mt/outward_scale.h"
#include "engine/mt/vertex_arrays.h"

namespace arete::packed {

/// Error codes of triangles of a lattice with whole-numbered heights: such an error is a whole number divided
/// by the doubled area. NodeCoder::triangleError() (io/store/packed/nodes/node_coder.h) encodes and decodes
/// them.

/// Up to this doubled area the error is coded as the whole number error * doubled area / height step.
inline constexpr unsigned kLatticeErrorArea = 64;
/// The symbol of an error that is not such a number below 2^24: its code follows as 16 raw bits.
inline constexpr unsigned kPlainError = 255;

/// The code of the error whole * abs(height step) / doubled area, rounded outwards, at most the largest code.
inline std::uint16_t wholeErrorCode(const OutwardScale& scale, const HeightEncoding& heights,
                                    std::uint64_t whole, double doubledArea) {
  const double magnitude = static_cast<double>(whole) * std::fabs(heights.scale) / doubledArea;
  return scale.encode(std::min(magnitude, static_cast<double>(scale.decode(OutwardScale::kMaxCode))));
}

}  // namespace arete::packed
