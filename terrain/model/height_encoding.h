// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/vertex_arrays.h"

namespace arete {

/// Heights in their smallest exact form, in an order of the caller's.
struct EncodedHeights {
  HeightEncoding encoding;
  UninitializedVector<std::byte> bytes;
};

/// Encodes heights[order[i]]: as 16-bit integers under the band's own scale and offset, as floats, or as
/// doubles, whichever is the first that gives every height back to the bit. Precondition: no NaN among them.
/// O(order.size()), parallel.
EncodedHeights encodeHeights(std::span<const double> heights, std::span<const std::uint32_t> order,
                             double rawScale, double rawOffset);

}  // namespace arete
