// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// `arete measure TIN DEM`: the independent check of any TIN against any DEM.
void addMeasureCommand(CLI::App& app, Session& session);

}  // namespace arete
