// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// A size as a user states it: a number ("5", "inf"), or a share in percent ("0.5%") of a whole that the
/// question decides. Of an error the whole is the diagonal of a surface and the relief of terrain
/// (terrain/model/relief.h), of a number of triangles the finest triangulation.
struct StatedSize {
  std::string text;   ///< as it was stated, without spaces
  double number = 0;  ///< what stands before the %
  bool isShare = false;

  double of(double whole) const { return isShare ? number / 100 * whole : number; }
};

/// Parses a size. Errors: usage, with the culprit given: it is no number, NaN, below zero, or an infinite
/// share.
Result<StatedSize> parseStatedSize(std::string_view text, const std::string& culprit);

/// Parses sizes with commas between: "1,5%,20". Errors: as parseStatedSize().
Result<std::vector<StatedSize>> parseStatedSizes(std::string_view text, const std::string& culprit);

}  // namespace arete
