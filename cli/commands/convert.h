// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/session/session.h"

namespace arete {

/// Declares `arete convert`: converts a mesh to another format, or an .amt to its plain or packed form.
void addConvertCommand(CLI::App& app, Session& session);

}  // namespace arete
