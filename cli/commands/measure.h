// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete measure TIN DEM`: the independent check of a TIN against a DEM, or of a mesh against a
/// mesh.
void addMeasureCommand(CLI::App& app, Session& session);

}  // namespace arete
