// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete mesh repair FILE -o OUT`: mends a mesh.
void addMeshRepairCommand(CLI::App& mesh, Session& session);

}  // namespace arete
