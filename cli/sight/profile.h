// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "cli/session/session.h"

namespace arete {

/// arete profile: the terrain along a line.
void addProfileCommand(CLI::App& app, Session& session);

}  // namespace arete
