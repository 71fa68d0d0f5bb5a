// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete validate FILE.amt`: checks all laws of a multitriangulation.
void addValidateCommand(CLI::App& app, Session& session);

}  // namespace arete
