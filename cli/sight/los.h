// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "cli/session/session.h"

namespace arete {

/// Declares `arete los`, which tells which places see each other.
void addLosCommand(CLI::App& app, Session& session);

}  // namespace arete
