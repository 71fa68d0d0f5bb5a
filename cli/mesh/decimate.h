// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete mesh decimate`: makes a mesh smaller, once.
void addMeshDecimateCommand(CLI::App& mesh, Session& session);

}  // namespace arete
