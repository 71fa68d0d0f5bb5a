// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "terrain/measure/mesh_distance.h"

namespace arete {

/// Distances between two meshes for people, a table. `unit` may be empty.
std::string meshDistanceText(const MeshDistanceReport& report, const std::string& unit);

}  // namespace arete
