// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/warning.h"

namespace arete {

/// What a PLY has that is left out or guessed when it is read.
struct PlyFindings {
  std::uint64_t linesWithMore = 0;  ///< of a text: than its properties
  std::size_t firstLineWithMore = 0;
  std::uint64_t scalarMisfits = 0;  ///< numbers of a text that their type does not hold
  std::uint64_t smallFaces = 0;     ///< of fewer than three corners
  std::vector<std::pair<std::string, std::uint64_t>> elementsLeftOut;  ///< with their counts
  std::vector<std::string> varyingLists;
  std::size_t surplusProperties = 0;
  bool facesLoseProperties = false;  ///< since there are strips as well
  std::uint64_t badTextureNumbers = 0;

  /// Adds a sentence for each kind.
  void warn(Warnings& warnings) const;
};

}  // namespace arete
