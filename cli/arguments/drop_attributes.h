// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cli/arguments/arguments.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The option --drop-attributes NAME[,NAME].
CLI::Option* addDropAttributesTo(CLI::App& command, std::vector<std::string>& names);

/// dropAttributes(), whose errors name the option and the name.
Status dropNamed(SurfaceMesh& mesh, const std::vector<std::string>& names);

/// What keeps vertices where attributes or parts differ from face to face, and the option that leaves it out,
/// as the end of a sentence: "; "normal" differs at 480 edges: --drop-attributes normal leaves it out".
/// Empty: nothing does.
std::string seamsOf(const SurfaceMesh& mesh);

}  // namespace arete
