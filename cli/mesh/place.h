// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "cli/session/session.h"

namespace arete {

void addMeshPlaceCommand(CLI::App& mesh, Session& session);

}  // namespace arete
