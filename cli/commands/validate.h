// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// `arete validate FILE.amt`: every law of a multitriangulation, checked.
void addValidateCommand(CLI::App& app, Session& session);

}  // namespace arete
