// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete build DEM -o OUT.amt`: builds the multitriangulation of a DEM. The session keeps the
/// arguments until it runs.
void addBuildCommand(CLI::App& app, Session& session);

}  // namespace arete
