// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete mesh` and its commands info, repair and crop.
void addMeshCommand(CLI::App& app, Session& session);

}  // namespace arete
