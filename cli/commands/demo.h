// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// `arete demo DEM -o DIR`: all of it on one DEM, with pictures.
void addDemoCommand(CLI::App& app, Session& session);

}  // namespace arete
