// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "io/store/amt/container.h"

namespace arete {

/// The bytes of an array or a text.
std::span<const std::byte> bytesOf(const auto& elements) {
  return std::as_bytes(std::span(elements));
}

/// A chunk and its bytes.
using AmtChunkBytes = std::pair<AmtTag, std::span<const std::byte>>;

/// The arrays that every multitriangulation has, of terrain or of a surface: mtShapes() but for what belongs
/// to one of them.
std::vector<AmtChunkBytes> mtChunks(const MtArrays& a);
/// The same arrays where they lie in a file. Precondition: AmtContainer::checkShapes() found them.
MtArrays placeMtChunks(const AmtContainer& file);

}  // namespace arete
