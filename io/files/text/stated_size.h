// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/files/text/length_unit.h"

namespace arete {

/// A size as a user states it: a number ("5", "inf"), or a share in percent ("0.5%") of a whole that the
/// question decides. Of an error the whole is the diagonal of a surface and the relief of terrain
/// (terrain/model/relief.h), of a number of triangles the finest triangulation.
struct StatedSize {
  std::string text;   ///< as it was stated, without spaces
  double number = 0;  ///< what stands before the %; of a length with a unit the number in the data's
  bool isShare = false;
  bool hasUnit = false;  ///< it was stated with a unit: "5m"

  double of(double whole) const { return isShare ? number / 100 * whole : number; }
};

/// Parses a size.
///
/// @param unit of the data, for a length ("5m", which becomes 16.4 where heights are in feet); null: the size
/// is a count, without a unit.
///
/// Errors: usage, with the culprit given: it is no number, NaN, below zero, or an infinite share; as
/// parseLength() and inDataUnit().
Result<StatedSize> parseStatedSize(std::string_view text, const std::string& culprit,
                                   const DataUnit* unit = nullptr);

/// Parses sizes with commas between: "1,5%,20m". Errors: as parseStatedSize().
Result<std::vector<StatedSize>> parseStatedSizes(std::string_view text, const std::string& culprit,
                                                 const DataUnit* unit = nullptr);

}  // namespace arete
