// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "measure/mesh_distance.h"

namespace arete {

/// Formats the distances between two meshes as a table. `unit` may be empty.
std::string meshDistanceText(const MeshDistanceReport& report, const std::string& unit);

}  // namespace arete
