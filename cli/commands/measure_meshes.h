// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/session/session.h"

namespace arete {

/// The arguments of `arete measure MESH MESH`.
struct MeasureMeshesArguments {
  std::string first, second;
  std::string expect;             ///< --expect; a share is of the second's diagonal; empty: not stated
  bool measuresBothWays = false;  ///< expects it of the points of both meshes, not of the second's alone
  std::int64_t samples = 0;       ///< 0: the library's default
  std::int64_t seed = 1;
  std::string errorMesh;  ///< empty: none
  bool wantsAttributes = false;
  std::string expectAttribute;  ///< as parseAttributeNumbers() takes it; empty: nothing is expected
};

/// The distance between two meshes, both ways, as text and JSON; with `errorMesh` the first one's vertices
/// with their distances, as a PLY.
Status measureMeshes(const MeasureMeshesArguments& arguments, Session& session);

}  // namespace arete
