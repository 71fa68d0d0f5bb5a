// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete extract FILE.amt -o OUT --max-error E[,E...]`: writes TINs for tolerances, a budget or a
/// region, with a certificate on request.
void addExtractCommand(CLI::App& app, Session& session);

}  // namespace arete
