// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "surface/model/displacement.h"

namespace arete::packed {

/// The chunk PDSP of a packed surface: its displacement (docs/topics/amt-format.md, "Packed surfaces").

/// Precondition: the displacement is of the MT, and not empty.
std::vector<std::byte> packDisplacement(const MultiTriangulation& mt,
                                        const SurfaceDisplacement& displacement);

/// Errors, without a culprit: corrupt.
Result<SurfaceDisplacement> unpackDisplacement(std::span<const std::byte> bytes,
                                               const MultiTriangulation& mt);

}  // namespace arete::packed
