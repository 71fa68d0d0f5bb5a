// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace arete {

/// What the options of a texture in an MTL say of its place: texture coordinates (u, v), v counted from
/// below, are taken at (u, v) * scale + offset.
struct MtlPlacing {
  std::array<double, 2> scale{1, 1}, offset{0, 0};
  bool clamps = false;              ///< the picture is not repeated
  std::optional<double> bump = {};  ///< "-bm"
  std::string others = {};          ///< further options, unless they are what holds without them

  bool isMoved() const { return scale != std::array{1.0, 1.0} || offset != std::array{0.0, 0.0}; }
};

/// Reads options as Material::verbatim keeps them: "-s 2 2 1 -o 0.5 0 0". Numbers that are missing are 1 of a
/// scale and 0 of an offset; the third ones are for pictures in space. O(size).
MtlPlacing mtlPlacingOf(std::string_view options);

/// The options without those of scale and offset.
std::string withoutMtlPlacing(std::string_view options);

}  // namespace arete
