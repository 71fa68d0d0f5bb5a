// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete height FILE.amt --at X,Y` or `--points FILE`: the height of the terrain at places, at full
/// resolution or within a tolerance.
void addHeightCommand(CLI::App& app, Session& session);

}  // namespace arete
