// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete demo DEM -o DIR`: builds, extracts, measures and draws one DEM.
void addDemoCommand(CLI::App& app, Session& session);

}  // namespace arete
