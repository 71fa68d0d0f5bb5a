// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// `arete build DEM -o OUT.amt`: a DEM in, its multitriangulation out. The session keeps the arguments until
/// it runs.
void addBuildCommand(CLI::App& app, Session& session);

}  // namespace arete
