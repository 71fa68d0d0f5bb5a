// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// What a file of a format holds of the attributes of a mesh.
struct MeshHolds {
  using Test = std::function<bool(const Attribute&)>;
  Test vertexAttribute = {}, wedgeAttribute = {}, triangleAttribute = {};  ///< empty: none
  bool objects = false, groups = false, materials = false;
  bool pictures = false;  ///< that materials use
};

/// What a mesh has beyond that, as in MeshWriteReport::lost: one text for each kind of thing, with names.
/// O(1) but for the names.
std::vector<std::string> lossesOf(const MeshAttributes& mesh, const MeshHolds& holds);

}  // namespace arete
