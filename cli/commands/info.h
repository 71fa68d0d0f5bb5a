// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete info FILE.amt`: describes a file, and its curve of triangles against error.
void addInfoCommand(CLI::App& app, Session& session);

}  // namespace arete
