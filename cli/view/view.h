// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// arete view: the window; with --headless pictures and films without one.
void addViewCommand(CLI::App& app, Session& session);

}  // namespace arete
