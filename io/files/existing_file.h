// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// What happens to a file of the output's name if its format holds layers of other origin (GeoPackage). Files
/// of other formats are always replaced.
enum class ExistingFile {
  keepsOtherLayers,  ///< only the layer that is written is replaced
  isReplaced,
};

}  // namespace arete
