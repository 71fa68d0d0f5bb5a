// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// What the first word of an OFF says that vertices have behind their coordinates: in Geomview's order a
/// normal, a color and texture coordinates, whatever the order of the letters.
struct OffKeyword {
  bool hasNormals = false, hasColors = false, hasTexcoords = false;
  /// "NC": Geomview's own order of letters is "CN"; MeshLab, which writes colors before normals, has this.
  bool namesNormalsFirst = false;
  std::string_view behind = {};  ///< what follows "OFF" in the word: the first count

  std::size_t values() const {
    return (hasNormals ? 3u : 0u) + (hasColors ? 4u : 0u) + (hasTexcoords ? 2u : 0u);
  }
};

/// Reads "OFF", in either case, with ST, C and N before it. The view points into `word`.
///
/// Errors, without culprit: corrupt: another word. unsupported: vertices of another number of coordinates
/// (4OFF, nOFF).
Result<OffKeyword> offKeywordOf(std::string_view word);

/// The comment of a file whose colors of vertices had no alpha, which the format wants.
inline constexpr std::string_view kOffWithoutAlpha = "colors without alpha";

}  // namespace arete
