// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// A picture, decoded.
struct PicturePixels {
  std::uint32_t width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> rgba = {};  ///< row by row from the top; alpha not multiplied in
};

/// Decodes a picture of a mesh: PNG, JPEG, WebP or what else GDAL reads of grey or three colours with 8 or 16
/// bits, with alpha or without, or with a colour table.
///
/// @param mostSide a larger picture is read at a coarser resolution, no side longer than this.
/// Errors: unsupported: not such a picture; corrupt: it cannot be decoded.
Result<PicturePixels> decodePicture(std::span<const std::byte> bytes, std::uint32_t mostSide);

/// Width and height of such a picture, of which only the head is read. Errors: unsupported: not such a
/// picture.
Result<std::array<std::uint32_t, 2>> pictureSize(std::span<const std::byte> bytes);

}  // namespace arete
