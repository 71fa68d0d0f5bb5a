// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete mesh info FILE`: says what is in a mesh file and what is the matter with it.
void addMeshInfoCommand(CLI::App& mesh, Session& session);

}  // namespace arete
