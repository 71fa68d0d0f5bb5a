// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "cli/session/session.h"

namespace arete {

/// arete viewshed: what can be seen from places.
void addViewshedCommand(CLI::App& app, Session& session);

}  // namespace arete
