// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/formats/glb/writer/vertex_values.h"

namespace arete {

/// An attribute of vertices as a packed file has it.
struct PackedValues {
  std::string semantic, name;
  int component = 0;  ///< GltfCode
  const char* type = "SCALAR";
  bool isNormalized = false;
  const char* filter = nullptr;  ///< of EXT_meshopt_compression; none
  std::size_t stride = 0;        ///< of an element in `bytes`, a multiple of four
  std::string bytes;             ///< of all vertices, as the filter wants them
};

/// Rounds directions to 8 bits (octahedral), texture coordinates to steps of 2^-12, coarser where they are
/// beyond 2048, and colors to 8 bits; all else stays to the bit.
///
/// Texture coordinates are floats after the decoder, with one exponent for all: they need no transform of
/// textures, may lie beyond 0 and 1, and 0, 1 and all binary fractions of a picture's side stay to the bit.
///
/// @param lost Gets what is rounded. O(size).
PackedValues packedValues(const GltfValues& values, std::vector<std::string>& lost);

}  // namespace arete
