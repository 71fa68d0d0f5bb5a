// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// `arete extract FILE.amt -o OUT --max-error E[,E...]`: TINs for tolerances, a budget or a region, with
/// proof.
void addExtractCommand(CLI::App& app, Session& session);

}  // namespace arete
