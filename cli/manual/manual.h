// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "cli/session/session.h"

namespace arete {

/// `arete manual`: manual pages and shell completion.
void addManualCommand(CLI::App& app, Session& session);

}  // namespace arete
