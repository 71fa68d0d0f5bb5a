// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/vertex_arrays.h"

namespace arete {

/// Heights in their smallest exact encoding.
struct EncodedHeights {
  HeightEncoding encoding;
  UninitializedVector<std::byte> bytes;
};

/// Encodes heights[order[i]] as 16-bit integers with a scale and an offset, as floats, or as doubles: the
/// first of these that restores every height to the bit. Precondition: no NaN among them. O(order.size()),
/// parallel.
/// @param order  indices into `heights`, in the order of the result
/// @param rawScale, rawOffset  as the DEM's band declares them, for the integers
EncodedHeights encodeHeights(std::span<const double> heights, std::span<const std::uint32_t> order,
                             double rawScale, double rawOffset);

}  // namespace arete
