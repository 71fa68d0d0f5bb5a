// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "io/geo/bent/target.h"
#include "surface/normals/made_normals.h"

namespace arete::python {

/// What an export writes; empty: not that.
struct ExportFiles {
  std::string output, certificate, errorRaster, map;
  PlaceTarget place = {};                        ///< of terrain
  std::string model;                             ///< the .amt, for the certificate
  std::string checkBefore, checkBehind;          ///< the call that checks it, around the promised error
  std::vector<std::string> dropAttributes = {};  ///< of a surface
  bool measuresBothWays = false;                 ///< of a surface
  std::optional<int> packedBits = {};            ///< MeshPacking::positionBits of a packed glTF
  NormalsOptions normals = {};                   ///< of a surface

  /// Empty where there is no call.
  std::string check(double promised) const {
    return checkBefore.empty() ? "" : fmt::format("{}{}{}", checkBefore, promised, checkBehind);
  }
};

}  // namespace arete::python
